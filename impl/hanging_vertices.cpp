#include "hanging_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "geometry.hpp"
#include "predicates.hpp"

namespace tetlod {

namespace {

/// Coordinates may be of single precision.
double rounding_of(const MeshView &mesh, Span<const Triangle> triangles) {
  double largest = 0;
  for (const Triangle &t : triangles)
    for (const std::int32_t v : t)
      for (int k = 0; k < 3; k++) largest = std::max(largest, std::abs(mesh.points[std::size_t(v)][k]));
  return 1e-7 * largest;
}

/// Whether the tip of the shorter of two ways lies on the longer.
bool lies_on(const Vec3 &shorter, const Vec3 &longer, double rounding) {
  constexpr double most = 1e-3;  // of the shorter one
  const double off2 = length2(glm::cross(shorter, longer)), length2_of_longer = length2(longer);
  return off2 <= rounding * rounding * length2_of_longer &&
         off2 <= most * most * length2(shorter) * length2_of_longer && glm::dot(shorter, longer) > 0;
}

class HangingVertices {
 public:
  HangingVertices(const MeshView &mesh, const TriangleCorners &corners, Job &job)
      : mesh_(mesh), corners_(corners), job_(job), rounding_(rounding_of(mesh, corners.triangles())) {}

  /// Those with an edge to an end of theirs.
  Array<HangingVertex> find() const {
    Array<HangingVertex> found(&job_.memory);
    for (std::size_t v = 0; v < mesh_.points.size(); v++) {
      job_.poll_at(v, 0.9);
      const Span<const Corner> at = corners_.of(std::int32_t(v));
      for (std::size_t i = 1; i < at.size(); i++)
        for (std::size_t j = 0; j < i; j++) look_at(std::int32_t(v), at[i], at[j], found);
    }
    return found;
  }

  /// Those with edges to the vertices opposite the edge that they lie on.
  Array<HangingVertex> find_on_diagonals() const {
    Array<HangingVertex> found(&job_.memory);
    for (std::size_t v = 0; v < mesh_.points.size(); v++) {
      job_.poll_at(v, 0.9);
      const Span<const Corner> at = corners_.of(std::int32_t(v));
      for (const Corner &left : at)
        for (const Corner &right : at)
          if (std::int32_t(v) < left.next && right.last == left.next)
            look_at_diagonal(std::int32_t(v), left, right, found);
    }
    return found;
  }

 private:
  Vec3 way(std::int32_t from, std::int32_t to) const {
    return mesh_.points[std::size_t(to)] - mesh_.points[std::size_t(from)];
  }

  /// At two edges of vertex v.
  void look_at(std::int32_t v, const Corner &one, const Corner &other, Array<HangingVertex> &found) const {
    std::int32_t near = one.next, far = other.next;
    if (near == far || near == other.last || far == one.last) return;  // of one triangle
    if (length2(way(v, near)) > length2(way(v, far))) std::swap(near, far);
    const HangingVertex hanging{near, v, far};
    if (lies_on(way(v, near), way(v, far), rounding_) &&
        (lie_on_one_another(hanging, false) || lie_on_one_another(hanging, true)))
      found.push_back(hanging);
  }

  /// From vertex v to left.next, which the two triangles have in common.
  void look_at_diagonal(std::int32_t v, const Corner &left, const Corner &right, Array<HangingVertex> &found) const {
    for (const Corner &corner : corners_.of(left.last)) {
      const std::int32_t on = corner.next;
      if (on == v || on == left.next || length2(way(v, on)) >= length2(way(v, left.next))) continue;
      if (!lies_on(way(v, on), way(v, left.next), rounding_)) continue;
      if (!are_back_to_back(normal(left.triangle), normal(corner.triangle))) continue;
      const Span<const Corner> beyond = corners_.of(right.next);
      if (std::any_of(beyond.begin(), beyond.end(), [&](const Corner &c) { return c.next == on || c.last == on; }))
        found.push_back({on, v, left.next});
    }
  }

  /// Whether triangles do on one side of the edges: what is outside of the one solid is inside of the other.
  bool lie_on_one_another(const HangingVertex &h, bool side) const {
    const Span<const Corner> corners = corners_.of(h.from);
    for (const Corner &coarse : corners)
      for (const Corner &fine : corners)
        if ((side ? coarse.last : coarse.next) == h.to && (side ? fine.next : fine.last) == h.vertex &&
            are_back_to_back(normal(coarse.triangle), normal(fine.triangle)))
          return true;
    return false;
  }

  Vec3 normal(std::int32_t triangle) const {
    const Triangle &t = corners_.triangles()[std::size_t(triangle)];
    return glm::cross(way(t[0], t[1]), way(t[0], t[2]));
  }

  const MeshView &mesh_;
  const TriangleCorners &corners_;
  Job &job_;
  double rounding_;
};

/// Tets that are divided one by one.
class Division {
 public:
  Division(NumberedTets &solid, Span<const HangingVertex> hanging, Job &job)
      : points_(solid.points),
        job_(job),
        tets_(solid.tets),
        number_(solid.number),
        list_of_(points_.size(), -1, &job.memory),
        lists_(&job.memory) {
    for (const HangingVertex &h : hanging)
      if (std::int32_t &list = list_of_[std::size_t(h.from)]; list < 0) {
        list = std::int32_t(lists_.size());
        lists_.emplace_back();
      }
    for (std::size_t t = 0; t < tets_.size(); t++) {
      job_.poll_at(t, 0.9);
      enter(t);
    }
  }

  /// Whether there are such tets, and none turns over.
  bool divide(const HangingVertex &h) {
    job_.poll(0.9);
    Array<std::int32_t> at_edge(&job_.memory);
    for (const std::int32_t t : lists_[std::size_t(list_of_[std::size_t(h.from)])])
      if (has(t, h.from) && has(t, h.to)) at_edge.push_back(t);
    if (at_edge.empty() ||
        !std::all_of(at_edge.begin(), at_edge.end(), [&](std::int32_t t) { return may_divide(t, h); }))
      return false;
    for (const std::int32_t t : at_edge) {
      tets_.push_back(with(t, h.from, h.vertex));
      number_.push_back(number_[std::size_t(t)]);
      tets_[std::size_t(t)] = with(t, h.to, h.vertex);
      enter(tets_.size() - 1);
      add(h.vertex, t);
    }
    return true;
  }

 private:
  bool has(std::int32_t t, std::int32_t v) const {
    const Tet &tet = tets_[std::size_t(t)];
    return std::find(tet.begin(), tet.end(), v) != tet.end();
  }

  void enter(std::size_t t) {
    for (const std::int32_t v : tets_[t]) add(v, std::int32_t(t));
  }

  /// To the list of vertex v, if it has one.
  void add(std::int32_t v, std::int32_t t) {
    if (const std::int32_t list = list_of_[std::size_t(v)]; list >= 0) lists_[std::size_t(list)].push_back(t);
  }

  Tet with(std::int32_t t, std::int32_t gone, std::int32_t instead) const {
    Tet tet = tets_[std::size_t(t)];
    std::replace(tet.begin(), tet.end(), gone, instead);
    return tet;
  }

  bool may_divide(std::int32_t t, const HangingVertex &h) const {
    const int side = side_of(tets_[std::size_t(t)]);
    return !has(t, h.vertex) && side_of(with(t, h.from, h.vertex)) == side && side_of(with(t, h.to, h.vertex)) == side;
  }

  int side_of(const Tet &t) const {
    const auto at = [&](std::size_t k) { return points_[std::size_t(t[k])]; };
    return orientation(at(0), at(1), at(2), at(3));
  }

  Span<const Vec3> points_;
  Job &job_;
  Array<Tet> &tets_;
  Array<std::int32_t> &number_;       // of each, among the submitted ones
  Array<std::int32_t> list_of_;       // of each vertex; -1: it needs none
  Array<Array<std::int32_t>> lists_;  // of tets that have, or had, the vertex
};

}  // namespace

Array<HangingVertex> find_hanging_vertices(const MeshView &mesh, const TriangleCorners &corners, Job &job) {
  return HangingVertices(mesh, corners, job).find();
}

bool divide_at_hanging_vertices(Job &job, NumberedTets &tets) {
  const MeshView mesh = tets.view();
  const TriangleCorners corners(mesh.points.size(), tets.boundary.triangles, job);
  const HangingVertices vertices(mesh, corners, job);
  Array<HangingVertex> hanging = vertices.find();
  if (hanging.empty()) hanging = vertices.find_on_diagonals();
  if (hanging.empty()) return false;
  Division division(tets, hanging, job);
  bool any = false;
  for (const HangingVertex &h : hanging) any = division.divide(h) || any;
  return any;
}

}  // namespace tetlod
