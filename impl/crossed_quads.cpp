#include "crossed_quads.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "first_culprit.hpp"
#include "lies_on.hpp"
#include "predicates.hpp"

namespace tetlod {

namespace {

class CrossedQuads {
 public:
  CrossedQuads(const MeshView &mesh, const TriangleCorners &corners, Span<const std::int32_t> tet_of, Job &job)
      : mesh_(mesh),
        triangles_(corners.triangles()),
        tet_of_(tet_of),
        job_(job),
        corners_(corners),
        taken_(triangles_.size(), 0, &job.memory),
        found_(&job.memory) {}

  Array<CrossedQuad> find_crossed(Array<std::uint8_t> &at_gap) {
    for_each_edge([&](std::int32_t x, const Corner &left, const Corner &right) {
      const CrossedQuad quad = quad_at(x, left, right);
      if (quad.other[0] >= 0 && !is_taken(quad) && is_crossed(quad)) take(quad);
    });
    leave_cavities(at_gap);
    return std::move(found_);
  }

  bool any_crossed() {
    FirstCulprit gap, cavity;
    job_.parallel.for_blocks(mesh_.points.size(), block, [&](std::size_t begin, std::size_t end) {
      if (gap.any()) return;
      for_each_edge(begin, end, [&](std::int32_t x, const Corner &left, const Corner &right) {
        const CrossedQuad quad = quad_at(x, left, right);
        if (quad.other[0] >= 0 && is_crossed(quad)) (may_be_cavity(quad) ? cavity : gap).report(std::size_t(x));
      });
    });
    if (gap.any() || !cavity.any()) return gap.any();
    Array<std::uint8_t> at_gap(mesh_.points.size(), 0, &job_.memory);
    return !find_crossed(at_gap).empty();
  }

  Array<CrossedQuad> find_slanted() {
    for_each_edge([&](std::int32_t x, const Corner &left, const Corner &right) {
      const CrossedQuad quad{{left.triangle, right.triangle}, {-1, -1}, {x, left.next, left.last, right.next}};
      if (!is_taken(quad) && may_turn(quad) && is_slanted(quad.tet) && is_between_sides(left.triangle) &&
          is_between_sides(right.triangle))
        take(quad);
    });
    return std::move(found_);
  }

 private:
  static constexpr std::size_t block = 1024;
  /// Of the volume of the tets beside a quad, what its own has at most.
  static constexpr double next_to_nothing = 0.5, flat = 0.01, no_volume = 1e-4;

  const Vec3 &at(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  Vec3 normal(std::int32_t a, std::int32_t b, std::int32_t c) const { return area_vector(at(a), at(b), at(c)); }
  Vec3 normal(std::int32_t triangle) const {
    const Triangle &t = triangles_[std::size_t(triangle)];
    return normal(t[0], t[1], t[2]);
  }

  /// visit(x, left, right): the triangles of these corners of x have the edge from x to left.next in common.
  template <class Visit>
  void for_each_edge(std::size_t begin, std::size_t end, const Visit &visit) const {
    for (std::size_t v = begin; v < end; v++) {
      if (v % 256 == 0) job_.poll(0.9);  // at some there is much to look at
      const auto x = std::int32_t(v);
      const Span<const Corner> at = corners_.of(x);
      for (const Corner &left : at)
        for (const Corner &right : at)
          if (x < left.next && right.last == left.next && right.next != left.last) visit(x, left, right);
    }
  }

  template <class Visit>
  void for_each_edge(const Visit &visit) const {
    for_each_edge(0, mesh_.points.size(), visit);
  }

  /// other: -1, -1 where no triangle lies back to back there.
  CrossedQuad quad_at(std::int32_t x, const Corner &left, const Corner &right) const {
    const std::int32_t y = left.next, u = left.last, v = right.next;
    std::int32_t beside = -1, with_x = -1, with_y = -1;
    for (const Corner &corner : corners_.of(u)) {
      if (corner.next != v && corner.last != v) continue;
      if (corner.triangle == left.triangle || corner.triangle == right.triangle) continue;
      const std::int32_t third = corner.next == v ? corner.last : corner.next;
      if (third == x) with_x = corner.triangle;
      if (third == y) with_y = corner.triangle;
      if (are_back_to_back(normal(left.triangle), normal(corner.triangle))) beside = corner.triangle;
    }
    CrossedQuad quad{{left.triangle, right.triangle}, {with_x, with_y}, {x, y, u, v}};
    if (with_x < 0 || with_y < 0) quad.other = {beside, -1};
    return quad;
  }

  bool is_crossed(const CrossedQuad &quad) const {
    return quad.is_closed() ? bounds_next_to_nothing(quad) : may_turn(quad);
  }

  bool is_taken(const CrossedQuad &quad) const {
    const auto taken = [&](std::int32_t t) { return t >= 0 && taken_[std::size_t(t)] != 0; };
    return taken(quad.one[0]) || taken(quad.one[1]) || taken(quad.other[0]) || taken(quad.other[1]);
  }

  void take(const CrossedQuad &quad) {
    for (const std::int32_t t : {quad.one[0], quad.one[1], quad.other[0], quad.other[1]})
      if (t >= 0) taken_[std::size_t(t)] = 1;
    found_.push_back(quad);
  }

  /// Of the tets at the triangles, what the largest has: so that a mesh may be squeezed, or stretched.
  bool is_small_beside(const CrossedQuad &quad, double most) const {
    double largest = 0;
    for (const std::int32_t t : {quad.one[0], quad.one[1], quad.other[0], quad.other[1]})
      if (t >= 0) largest = std::max(largest, volume6(mesh_.tets[std::size_t(tet_of_[std::size_t(t)])]));
    return volume6(quad.tet) <= most * largest;
  }

  double volume6(const Tet &t) const { return std::abs(six_volume(mesh_.points, t)); }
  bool is_flat(const CrossedQuad &quad) const { return is_small_beside(quad, flat); }

  /// Four triangles may bound a cavity as well, of the shape of a tet.
  bool may_be_cavity(const CrossedQuad &quad) const {
    return quad.is_closed() && side_of(quad.tet) > 0 && !is_small_beside(quad, no_volume);
  }

  using Edge = std::pair<std::int32_t, std::int32_t>;
  static std::array<Edge, 6> edges_of(const Tet &t) {
    return {std::minmax(t[0], t[1]), std::minmax(t[0], t[2]), std::minmax(t[0], t[3]),
            std::minmax(t[1], t[2]), std::minmax(t[1], t[3]), std::minmax(t[2], t[3])};
  }

  Array<Edge> sorted_edges(Span<const CrossedQuad> quads) const {
    Array<Edge> edges(&job_.memory);
    for (const CrossedQuad &quad : quads)
      for (const Edge &edge : edges_of(quad.tet)) edges.push_back(edge);
    std::sort(edges.begin(), edges.end(), PollingLess(job_, 0.9, std::less<Edge>()));
    return edges;
  }

  /// Where hexahedra were split, the tets of others beside it overlap, have no volume, or have two triangles; or it is
  /// one of a sheet, with others at its four sides.
  void leave_cavities(Array<std::uint8_t> &at_gap) {
    const auto put_at_gap = [&](const CrossedQuad &quad) {
      for (const std::int32_t v : quad.tet) at_gap[std::size_t(v)] = 1;
    };
    Array<CrossedQuad> found(&job_.memory), doubtful(&job_.memory);
    for (const CrossedQuad &quad : found_) (may_be_cavity(quad) ? doubtful : found).push_back(quad);
    std::for_each(found.begin(), found.end(), put_at_gap);
    const Array<Edge> edges = sorted_edges(doubtful);
    const auto is_shared = [&](const Edge &edge) {
      const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edge);
      return last - first > 1;
    };
    for (const CrossedQuad &quad : doubtful) {
      const std::array<Edge, 6> of_quad = edges_of(quad.tet);
      if (std::count_if(of_quad.begin(), of_quad.end(), is_shared) > 3) put_at_gap(quad);
    }
    const auto is_cavity = [&](const CrossedQuad &quad) {
      return std::none_of(quad.tet.begin(), quad.tet.end(),
                          [&](std::int32_t v) { return at_gap[std::size_t(v)] != 0; });
    };
    doubtful.erase(std::remove_if(doubtful.begin(), doubtful.end(), is_cavity), doubtful.end());
    std::for_each(doubtful.begin(), doubtful.end(), put_at_gap);
    found.insert(found.end(), doubtful.begin(), doubtful.end());
    found_ = std::move(found);
  }

  bool bounds_next_to_nothing(const CrossedQuad &quad) const {
    if (!is_small_beside(quad, next_to_nothing)) return false;
    const auto is_of_a_solid = [&](std::int32_t t) {
      return is_inside(quad.tet, mesh_.tets[std::size_t(tet_of_[std::size_t(t)])]);
    };
    return !is_of_a_solid(quad.one[0]) && !is_of_a_solid(quad.one[1]) && !is_of_a_solid(quad.other[0]) &&
           !is_of_a_solid(quad.other[1]);
  }

  /// Then the four triangles bound a thin solid. The tet has three of its corners.
  bool is_inside(const Tet &corners, const Tet &tet) const {
    const auto is_another = [&](std::int32_t v) { return !has(corners, v); };
    const auto apex = std::find_if(tet.begin(), tet.end(), is_another);
    if (apex == tet.end()) return true;  // it is that tet
    const int side = side_of(corners);
    for (std::size_t k = 0; k < 4; k++) {
      Tet replaced = corners;
      replaced[k] = *apex;
      if (side == 0 || side_of(replaced) != side) return false;
    }
    return true;
  }

  int side_of(const Tet &t) const { return orientation(mesh_.points, t); }

  /// The diagonal of the first two: the quad is plane, and convex.
  bool may_turn(const CrossedQuad &quad) const {
    constexpr double least = 0.01;
    const auto [x, y, u, v] = quad.tet;
    const Vec3 n = normal(x, y, u);
    return is_flat(quad) && glm::dot(n, normal(v, y, u)) > least * length2(n) &&
           glm::dot(n, normal(u, x, v)) > least * length2(n);
  }

  /// A vertex of the one triangle lies in the circle of the other: opposite angles are more than two right ones.
  bool is_slanted(const Tet &quad) const {
    constexpr double rounding = 1e-6;
    const auto [x, y, u, v] = quad;
    const auto angle = [&, x = x, y = y](std::int32_t at_corner) {
      const Vec3 a = at(x) - at(at_corner), b = at(y) - at(at_corner);
      const double scale = std::sqrt(length2(a) * length2(b));
      return std::pair(glm::dot(a, b) / scale, std::sqrt(length2(glm::cross(a, b))) / scale);
    };
    const auto [cos_u, sin_u] = angle(u);
    const auto [cos_v, sin_v] = angle(v);
    const double sine = sin_u * cos_v + cos_u * sin_v;
    return sine < -rounding;
  }

  bool is_between_sides(std::int32_t triangle) const {
    const Triangle &t = triangles_[std::size_t(triangle)];
    for (std::size_t k = 0; k < 3; k++)
      for (const Corner &corner : corners_.of(t[k]))
        if (are_back_to_back(normal(triangle), normal(corner.triangle))) return true;
    return false;
  }

  const MeshView &mesh_;
  Span<const Triangle> triangles_;
  Span<const std::int32_t> tet_of_;
  Job &job_;
  const TriangleCorners &corners_;
  Array<std::uint8_t> taken_;  // of each triangle, whether a quad has it
  Array<CrossedQuad> found_;
};

}  // namespace

Array<CrossedQuad> find_crossed_quads(const MeshView &mesh, const TriangleCorners &corners,
                                      Span<const std::int32_t> tet_of, Array<std::uint8_t> &at_gap, Job &job) {
  return CrossedQuads(mesh, corners, tet_of, job).find_crossed(at_gap);
}

bool any_crossed_quads(const MeshView &mesh, const TriangleCorners &corners, Span<const std::int32_t> tet_of,
                       Job &job) {
  return CrossedQuads(mesh, corners, tet_of, job).any_crossed();
}

Array<CrossedQuad> find_slanted_quads(const MeshView &mesh, const TriangleCorners &corners,
                                      Span<const std::int32_t> tet_of, Job &job) {
  return CrossedQuads(mesh, corners, tet_of, job).find_slanted();
}

}  // namespace tetlod
