#include "solid_rules.hpp"

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// Whether tet t, with its corner v at another place, would turn over, or be flat and keep less of its shape.
bool is_flattened(const SolidComplex &mesh, const Tet &t, std::int32_t v, const Vec3 &place, const KeptOfFlat &kept) {
  const auto &face = tet_face[(v == t[1]) + 2 * (v == t[2]) + 3 * (v == t[3])];
  const auto corner = [&](int i) { return mesh.point(t[std::size_t(face[i])]); };
  const Vec3 a = corner(0), b = corner(1), c = corner(2);
  const double volume = det(place, a, b, c);
  if (!(volume > 0)) return true;
  // No edge is longer than twice the longest one at a corner: of most tets that says enough.
  const double most = 4 * std::max({length2(a - place), length2(b - place), length2(c - place)});
  const double limit2 = mesh.measures.least_shape2;
  if (volume * volume > limit2 * most * most * most) return false;
  const double shape = shape2(place, a, b, c);
  if (shape >= limit2) return false;
  const double part = shape < kept.flattest * kept.flattest ? 1 : kept.part;
  return shape < part * part * shape2(mesh.point(v), a, b, c);
}

template <class Tets>
bool flattens_some(const SolidComplex &mesh, const Tets &tets, std::int32_t v, const Vec3 &place,
                   const KeptOfFlat &kept) {
  return std::any_of(tets.begin(), tets.end(),
                     [&](std::int32_t t) { return is_flattened(mesh, mesh.tets[std::size_t(t)], v, place, kept); });
}

/// The triangle with the half-edge from -> to; -1 if there is none. A hub's are too many to look at.
std::int32_t triangle_at(const SolidComplex &mesh, std::int32_t from, std::int32_t to) {
  const bool is_hub = mesh.triangles_of.of(from).size() > longest_ring;
  for (std::int32_t t : mesh.triangles_of.of(is_hub ? to : from)) {
    if (!mesh.has_triangle(t)) continue;
    const Triangle &f = mesh.triangles[std::size_t(t)];
    for (std::size_t k = 0; k < 3; k++)
      if (f[k] == from && f[(k + 1) % 3] == to) return t;
  }
  return -1;
}

/// The side of a triangle that is opposite an end of the edge.
struct Side {
  std::int32_t from, to, triangle;
};
using Sides = Few<Side, longest_ring>;

/// Of the triangles that an end has alone; those at the edge go to `at_edge`. False when there are too many.
bool find_sides(const SolidComplex &mesh, std::int32_t end, std::int32_t other, Sides &sides,
                Array<std::int32_t> &at_edge) {
  for (std::int32_t t : mesh.triangles_of.of(end)) {
    if (!mesh.has_triangle(t)) continue;
    const Triangle &f = mesh.triangles[std::size_t(t)];
    if (has(f, other)) {
      if (std::find(at_edge.begin(), at_edge.end(), t) == at_edge.end()) at_edge.push_back(t);
      continue;
    }
    const auto k = std::size_t(std::find(f.begin(), f.end(), end) - f.begin());
    if (!sides.push({f[(k + 1) % 3], f[(k + 2) % 3], t})) return false;
  }
  return true;
}

bool add_spoke(const SolidComplex &mesh, const Side &side, Star &star) {
  const std::int32_t beyond = triangle_at(mesh, side.to, side.from);
  if (beyond < 0) return false;
  const Triangle &f = mesh.triangles[std::size_t(side.triangle)];
  star.ring_id.push_back(side.from);
  star.ring.push_back(mesh.point(side.from));
  star.old_normal.push_back(mesh.normal(side.triangle));
  star.outer_normal.push_back(mesh.normal(beyond));
  star.old_faces.push_back(side.triangle);
  star.old_quality = std::min(star.old_quality, triangle_quality(mesh.point(f[0]), mesh.point(f[1]), mesh.point(f[2])));
  return true;
}

/// Of the triangles around the other end of an edge, as nearly as coordinates of single precision leave them.
bool is_on_planes(const SolidComplex &mesh, std::int32_t end, std::int32_t other) {
  constexpr double rounding = 1e-5;  // of the edge
  const Vec3 edge = mesh.point(end) - mesh.point(other);
  const double off2 = rounding * rounding * length2(edge);
  const Span<const std::int32_t> around = mesh.triangles_of.of(other);
  return std::all_of(around.begin(), around.end(), [&](std::int32_t t) {
    if (!mesh.has_triangle(t)) return true;
    const Vec3 normal = mesh.normal(t);
    const double off = glm::dot(normal, edge);
    return off * off <= off2 * length2(normal);
  });
}

}  // namespace

bool look_around(const SolidComplex &mesh, std::int32_t stays, std::int32_t gone, SolidEdge &edge) {
  edge.begin(stays, gone);
  for (std::int32_t t : mesh.tets_of.of(stays)) {
    if (!mesh.has_tet(t)) continue;
    const bool at_edge = has(mesh.tets[std::size_t(t)], gone);
    if (!(at_edge ? edge.edge_tets.push(t) : edge.stays_tets.push(t))) return false;
  }
  for (std::int32_t t : mesh.tets_of.of(gone))
    if (mesh.has_tet(t) && !has(mesh.tets[std::size_t(t)], stays) && !edge.gone_tets.push(t)) return false;
  return !edge.edge_tets.empty() && !(edge.stays_tets.empty() && edge.gone_tets.empty());
}

bool look_around_removal(const SolidComplex &mesh, std::int32_t stays, std::int32_t gone, const KeptOfFlat &kept,
                         SolidEdge &edge) {
  edge.begin(stays, gone);
  const Vec3 place = mesh.point(stays);
  for (std::int32_t t : mesh.tets_of.of(gone)) {
    if (!mesh.has_tet(t)) continue;
    const Tet &tet = mesh.tets[std::size_t(t)];
    if (has(tet, stays) ? !edge.edge_tets.push(t)
                        : is_flattened(mesh, tet, gone, place, kept) || !edge.gone_tets.push(t))
      return false;
  }
  return true;
}

bool flattens(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &place, const KeptOfFlat &kept) {
  return (place != mesh.point(edge.stays) && flattens_some(mesh, edge.stays_tets, edge.stays, place, kept)) ||
         flattens_some(mesh, edge.gone_tets, edge.gone, place, kept);
}

bool look_around_on_boundary(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &place, Star &star) {
  star.clear();
  star.centre = place;
  star.centre_id = edge.stays;
  Sides sides;
  if (!find_sides(mesh, edge.stays, edge.gone, sides, star.old_faces) ||
      !find_sides(mesh, edge.gone, edge.stays, sides, star.old_faces))
    return false;
  if (star.old_faces.size() != 2 || sides.size() < 3) return false;
  // In order around the edge, every vertex once.
  std::int32_t at = sides[0].from;
  for (std::size_t i = 0; i < sides.size(); i++) {
    const auto next = std::find_if(sides.begin(), sides.end(), [&](const Side &s) { return s.from == at; });
    const bool again = std::find(star.ring_id.begin(), star.ring_id.end(), at) != star.ring_id.end();
    if (next == sides.end() || again || !add_spoke(mesh, *next, star)) return false;
    at = next->to;
  }
  star.find_spokes();
  return at == sides[0].from;
}

EndsOnPlanes ends_on_planes(const SolidComplex &mesh, const SolidEdge &edge) {
  return {is_on_planes(mesh, edge.stays, edge.gone), is_on_planes(mesh, edge.gone, edge.stays)};
}

StepConstraint keeping_volume(const SolidComplex &mesh, const SolidEdge &edge, const Vec3 &from) {
  constexpr double crumpled = 0.01, flat = 1 - 1e-8;  // of the area
  StepConstraint constraint;
  double area = 0;
  for (std::int32_t end : {edge.stays, edge.gone})
    for (std::int32_t t : mesh.triangles_of.of(end)) {
      if (!mesh.has_triangle(t)) continue;
      const Triangle &f = mesh.triangles[std::size_t(t)];
      if (end == edge.gone && has(f, edge.stays)) continue;  // it was among the other's
      const Vec3 normal = mesh.normal(t);
      constraint.normal += normal;
      constraint.offset -= glm::dot(normal, from - mesh.point(f[0]));
      area += glm::length(normal);
    }
  constraint.holds = glm::length(constraint.normal) > crumpled * area;
  constraint.is_flat = glm::length(constraint.normal) > flat * area;
  return constraint;
}

}  // namespace tetlod
