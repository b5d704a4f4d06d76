#include "divide_tets.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "hanging_vertices.hpp"
#include "predicates.hpp"
#include "vertices_on_triangles.hpp"

namespace tetlod {

namespace {

Tet with(Tet tet, std::int32_t gone, std::int32_t instead) {
  std::replace(tet.begin(), tet.end(), gone, instead);
  return tet;
}

/// Of edges, one by one.
class EdgeDivision {
 public:
  EdgeDivision(NumberedTets &solid, Span<const HangingVertex> hanging, Job &job)
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

  /// Whether there are such tets, the vertex is next to their edge, and none turns over.
  bool divide(const HangingVertex &h) {
    job_.poll(0.9);
    Array<std::int32_t> at_edge(&job_.memory);
    for (const std::int32_t t : lists_[std::size_t(list_of_[std::size_t(h.from)])])
      if (has(tets_[std::size_t(t)], h.from) && has(tets_[std::size_t(t)], h.to)) at_edge.push_back(t);
    // One that has lost the vertex and got it again is there twice.
    std::sort(at_edge.begin(), at_edge.end());
    at_edge.erase(std::unique(at_edge.begin(), at_edge.end()), at_edge.end());
    const auto is_next_to_edge = [&](std::int32_t t) { return is_next_to_edge_of(tets_[std::size_t(t)], h); };
    if (std::none_of(at_edge.begin(), at_edge.end(), is_next_to_edge) ||
        !std::all_of(at_edge.begin(), at_edge.end(), [&](std::int32_t t) { return may_divide(t, h); }))
      return false;
    for (const std::int32_t t : at_edge) {
      const Tet whole = tets_[std::size_t(t)];
      tets_.push_back(with(whole, h.from, h.vertex));
      number_.push_back(number_[std::size_t(t)]);
      tets_[std::size_t(t)] = with(whole, h.to, h.vertex);
      enter(tets_.size() - 1);
      add(h.vertex, t);
    }
    return true;
  }

 private:
  void enter(std::size_t t) {
    for (const std::int32_t v : tets_[t]) add(v, std::int32_t(t));
  }

  /// To the list of vertex v, if it has one.
  void add(std::int32_t v, std::int32_t t) {
    if (const std::int32_t list = list_of_[std::size_t(v)]; list >= 0) lists_[std::size_t(list)].push_back(t);
  }

  /// By the tet's own measure, as all is next to all in a mesh that is flat.
  bool is_next_to_edge_of(const Tet &tet, const HangingVertex &h) const {
    constexpr double most = 0.1;  // of the weight of a corner that is not on the edge
    const double whole = std::abs(six_volume(points_, tet));
    return std::all_of(tet.begin(), tet.end(), [&](std::int32_t v) {
      return v == h.from || v == h.to || std::abs(six_volume(points_, with(tet, v, h.vertex))) <= most * whole;
    });
  }

  bool may_divide(std::int32_t t, const HangingVertex &h) const {
    const Tet &tet = tets_[std::size_t(t)];
    const int side = orientation(points_, tet);
    return !has(tet, h.vertex) && orientation(points_, with(tet, h.from, h.vertex)) == side &&
           orientation(points_, with(tet, h.to, h.vertex)) == side;
  }

  Span<const Vec3> points_;
  Job &job_;
  Array<Tet> &tets_;
  Array<std::int32_t> &number_;       // of each, among the submitted ones
  Array<std::int32_t> list_of_;       // of each vertex; -1: it needs none
  Array<Array<std::int32_t>> lists_;  // of tets that have, or had, the vertex
};

bool divide_edges(Span<const HangingVertex> hanging, Job &job, NumberedTets &tets) {
  if (hanging.empty()) return false;
  EdgeDivision division(tets, hanging, job);
  bool any = false;
  for (const HangingVertex &h : hanging) any = division.divide(h) || any;
  return any;
}

/// In three: a tet each of which has the vertex instead of another of the face's. False: one would turn over.
bool divide_face(const Triangle &face, std::int32_t vertex, std::int32_t t, NumberedTets &tets) {
  const Tet whole = tets.tets[std::size_t(t)];
  for (const std::int32_t corner : face)
    if (orientation(tets.points, with(whole, corner, vertex)) != orientation(tets.points, whole)) return false;
  tets.tets[std::size_t(t)] = with(whole, face[0], vertex);
  for (const std::int32_t corner : {face[1], face[2]}) {
    tets.tets.push_back(with(whole, corner, vertex));
    tets.number.push_back(tets.number[std::size_t(t)]);
  }
  return true;
}

/// Of each tet one.
bool divide_faces(Span<const VertexOnTriangle> inside, Job &job, NumberedTets &tets) {
  Array<std::uint8_t> is_divided(tets.tets.size(), 0, &job.memory);
  bool any = false;
  for (const VertexOnTriangle &on : inside) {
    job.poll(0.9);
    const std::int32_t t = tets.boundary.tet_of[std::size_t(on.triangle)];
    if (is_divided[std::size_t(t)]) continue;
    is_divided[std::size_t(t)] = divide_face(tets.boundary.triangles[std::size_t(on.triangle)], on.vertex, t, tets);
    any = any || is_divided[std::size_t(t)];
  }
  return any;
}

}  // namespace

bool divide_at_hanging_vertices(Job &job, NumberedTets &tets) {
  const TriangleCorners corners(tets.points.size(), tets.boundary.triangles, job);
  return divide_edges(find_hanging_vertices(tets.view(), corners, job), job, tets);
}

bool divide_at_vertices_on_triangles(Job &job, NumberedTets &tets, bool inside_too) {
  Array<HangingVertex> on_edges(&job.memory);
  Array<VertexOnTriangle> inside(&job.memory);
  for (const VertexOnTriangle &on : find_vertices_on_triangles(tets.points, tets.boundary.triangles, job)) {
    const Triangle &t = tets.boundary.triangles[std::size_t(on.triangle)];
    if (on.opposite < 0)
      inside.push_back(on);
    else
      on_edges.push_back({on.vertex, t[std::size_t(on.opposite + 1) % 3], t[std::size_t(on.opposite + 2) % 3]});
  }
  return divide_edges(on_edges, job, tets) || (inside_too && divide_faces(inside, job, tets));
}

}  // namespace tetlod
