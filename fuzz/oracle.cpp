#include "oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "demand.hpp"
#include "find_crossing.hpp"
#include "geometry.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "surface_distance.hpp"
#include "surface_topology.hpp"

namespace fuzz {

namespace {

int exponent_of(const std::vector<Point> &points) {
  double most = 0;
  for (const Point &p : points)
    for (const double x : p) most = std::max(most, std::abs(x));
  return most > 0 ? std::ilogb(most) : 0;
}

std::vector<tetlod::Vec3> near_one(const std::vector<Point> &points) {
  const int exponent = -exponent_of(points);
  std::vector<tetlod::Vec3> scaled;
  for (const Point &p : points)
    scaled.push_back({std::ldexp(p[0], exponent), std::ldexp(p[1], exponent), std::ldexp(p[2], exponent)});
  return scaled;
}

/// The library's own struct, to ask the library's own questions. Its points are numbered by first use.
void make_surface(const std::vector<Point> &points, const std::vector<Face> &faces, tetlod::Surface &surface) {
  std::vector<Point> own = points;  // those that the surface has not are of no account
  std::vector<bool> used(points.size(), false);
  for (const Face &face : faces)
    for (const std::int64_t v : face) used[std::size_t(v)] = true;
  for (std::size_t v = 0; v < own.size(); v++)
    if (!used[v]) own[v] = {};
  const auto scaled = near_one(own);
  std::map<std::int64_t, std::int32_t> number;
  for (const Face &face : faces) {
    tetlod::Triangle triangle{};
    for (std::size_t k = 0; k < 3; k++) {
      const auto [place, fresh] = number.emplace(face[k], std::int32_t(number.size()));
      triangle[k] = place->second;
      if (!fresh) continue;
      surface.points.push_back(scaled[std::size_t(face[k])]);
      surface.scalars.push_back(0);
      surface.origin.push_back(std::int32_t(face[k]));
    }
    surface.triangles.push_back(triangle);
  }
}

/// Of the surface that is cut apart where it touches itself.
struct CutTopology {
  std::int64_t euler, components, nonmanifold_edges, nonmanifold_points;
};

/// A surface, cut apart where it touches itself, as the library has it.
struct CutSurface {
  CutSurface(const std::vector<Point> &points, const std::vector<Face> &faces) {
    make_surface(points, faces, surface);
    tetlod::find_topology(surface.points, surface.triangles, job, topology);
  }

  tetlod::Memory memory;
  tetlod::Parallel alone{1};
  tetlod::Job job{memory, alone};
  tetlod::Surface surface{memory};
  tetlod::SurfaceTopology topology{memory};
};

CutTopology cut_topology(const std::vector<Point> &points, const std::vector<Face> &faces) {
  const CutSurface cut(points, faces);
  const auto triangles = std::int64_t(faces.size());
  return {std::int64_t(cut.topology.vertex_of.size()) - triangles / 2, cut.topology.components,
          cut.topology.nonmanifold_edges, cut.topology.nonmanifold_points};
}

/// Two triangles that cross, or -1, -1.
std::pair<std::int32_t, std::int32_t> crossing_of(const std::vector<Point> &points, const std::vector<Face> &faces) {
  tetlod::Memory memory;
  const tetlod::Parallel alone(1);
  tetlod::Job job(memory, alone);
  tetlod::Surface surface(memory);
  make_surface(points, faces, surface);
  tetlod::TreeOnDemand tree(surface);
  return tetlod::find_crossing(surface, tree, job);
}

/// The faces of each component of the surface, cut apart where it touches itself.
std::vector<std::vector<Face>> components_of(const std::vector<Point> &points, const std::vector<Face> &faces) {
  const CutSurface cut(points, faces);
  std::vector<std::vector<Face>> components(std::size_t(cut.topology.components));
  for (std::size_t t = 0; t < faces.size(); t++) components[std::size_t(cut.topology.component[t])].push_back(faces[t]);
  return components;
}

bool has_contacts(const std::vector<Point> &points, const std::vector<Face> &faces) {
  CutSurface cut(points, faces);
  tetlod::TreeOnDemand tree(cut.surface);
  return !tetlod::find_contacts(cut.surface, cut.topology, tree, true, cut.job).empty();
}

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double distance_to_segment(const Point &p, const Point &a, const Point &b) {
  const Point way = minus(b, a), to = minus(p, a);
  const double length2 = dot(way, way), t = length2 > 0 ? std::clamp(dot(to, way) / length2, 0.0, 1.0) : 0;
  const Point rest = {to[0] - t * way[0], to[1] - t * way[1], to[2] - t * way[2]};
  return std::sqrt(dot(rest, rest));
}

/// To the plane where p lies above the triangle, else to one of its edges.
double distance_to_triangle(const Point &p, const Point &a, const Point &b, const Point &c) {
  const double to_edges =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Point normal = cross(minus(b, a), minus(c, a));
  const auto left_of = [&](const Point &from, const Point &to) {
    return dot(cross(minus(to, from), minus(p, from)), normal) >= 0;
  };
  const double length2 = dot(normal, normal);
  if (!(length2 > 0) || !left_of(a, b) || !left_of(b, c) || !left_of(c, a)) return to_edges;
  return std::min(to_edges, std::abs(dot(minus(p, a), normal)) / std::sqrt(length2));
}

std::set<std::int64_t> vertices_of(const std::vector<Face> &faces) {
  std::set<std::int64_t> used;
  for (const Face &face : faces) used.insert(face.begin(), face.end());
  return used;
}

/// Of a surface's vertices from another surface.
double farthest(const std::vector<Point> &from, const std::vector<Face> &faces, const std::vector<Point> &to,
                const std::vector<Face> &others) {
  double most = 0;
  for (const std::int64_t v : vertices_of(faces)) {
    double least = std::numeric_limits<double>::infinity();
    for (const Face &f : others)
      least = std::min(least, distance_to_triangle(from[std::size_t(v)], to[std::size_t(f[0])], to[std::size_t(f[1])],
                                                   to[std::size_t(f[2])]));
    most = std::max(most, least);
  }
  return most;
}

double diagonal_of(const std::vector<Point> &points, const std::vector<Face> &faces) {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const std::int64_t v : vertices_of(faces))
    for (std::size_t k = 0; k < 3; k++) {
      low[k] = std::min(low[k], points[std::size_t(v)][k]);
      high[k] = std::max(high[k], points[std::size_t(v)][k]);
    }
  return std::sqrt(dot(minus(high, low), minus(high, low)));
}

constexpr std::size_t face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// Turned so that the lowest corner comes first: the same for the same side of the same face.
Face one_side(Face face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}
Face other_side(const Face &face) { return {face[0], face[2], face[1]}; }

}  // namespace

bool are_side_by_side(const std::vector<Point> &points, const std::vector<Corners> &tets) {
  std::set<std::pair<Face, int>> sides;
  for (const Corners &tet : tets)
    for (std::size_t k = 0; k < 4; k++) {
      Face face = {tet[face_corners[k][0]], tet[face_corners[k][1]], tet[face_corners[k][2]]};
      std::sort(face.begin(), face.end());
      const auto at = [&](std::int64_t v) { return points[std::size_t(v)]; };
      const int is_on = side(at(face[0]), at(face[1]), at(face[2]), at(tet[k]));
      if (is_on != 0 && !sides.emplace(face, is_on).second) return false;
    }
  return true;
}

void check_corners(const std::vector<Corners> &tets, std::size_t points) {
  std::set<std::int64_t> used;
  for (const Corners &tet : tets) used.insert(tet.begin(), tet.end());
  DEMAND(used.size() == points, "every point of a result is used: %zu of %zu are", used.size(), points);
  DEMAND(used.empty() || (*used.begin() == 0 && *used.rbegin() == std::int64_t(points) - 1), "corners are points");
}

void check_positive(const std::vector<Point> &points, const std::vector<Corners> &tets) {
  const auto p = near_one(points);
  for (std::size_t t = 0; t < tets.size(); t++) {
    const auto at = [&](std::size_t k) { return p[std::size_t(tets[t][k])]; };
    const double volume = tetlod::det(at(0), at(1), at(2), at(3));
    DEMAND(volume > 0, "every tet is positive: tet %zu of %zu has %g", t, tets.size(), volume);
  }
}

void check_conforming(const std::vector<Corners> &tets, const std::vector<Face> &boundary) {
  std::set<Face> sides;
  for (const Corners &tet : tets)
    for (const auto &corners : face_corners) {
      const Face face = one_side({tet[corners[0]], tet[corners[1]], tet[corners[2]]});
      DEMAND(sides.insert(face).second, "a side of a face belongs to one tet");
    }
  std::set<Face> open;
  for (const Face &face : sides)
    if (!sides.count(other_side(face))) open.insert(face);
  std::set<Face> given;
  for (const Face &face : boundary) DEMAND(given.insert(one_side(face)).second, "a boundary triangle is there once");
  DEMAND(given == open, "the boundary (%zu triangles) is the faces used once (%zu)", given.size(), open.size());
}

void check_surface(const std::vector<Point> &points, const std::vector<Face> &boundary) {
  DEMAND(topology_of(boundary).closed, "the boundary is closed");
  const auto [a, b] = crossing_of(points, boundary);
  DEMAND(a < 0, "the boundary does not cross itself: triangles %d and %d do", a, b);
}

void check_components(const std::vector<Point> &points, const std::vector<Face> &boundary) {
  DEMAND(topology_of(boundary).closed, "the boundary is closed");
  for (const std::vector<Face> &component : components_of(points, boundary)) {
    const auto [a, b] = crossing_of(points, component);
    DEMAND(a < 0, "no component of the boundary crosses itself: its triangles %d and %d do", a, b);
  }
}

void check_same_topology(const std::vector<Face> &original, const std::vector<Face> &boundary) {
  const Topology was = topology_of(original), is = topology_of(boundary);
  DEMAND(was.components == is.components, "the surface's components stay: %ld, now %ld", long(was.components),
         long(is.components));
  DEMAND(was.euler() == is.euler(), "the Euler characteristic stays: %ld, now %ld", long(was.euler()),
         long(is.euler()));
}

void check_same_cut_topology(const std::vector<Point> &before, const std::vector<Face> &original,
                             const std::vector<Point> &after, const std::vector<Face> &boundary) {
  const CutTopology cut = cut_topology(before, original), now = cut_topology(after, boundary);
  DEMAND(cut.components == now.components, "components of the cut surface stay: %ld, now %ld", long(cut.components),
         long(now.components));
  DEMAND(cut.euler == now.euler, "the Euler characteristic of the cut surface stays: %ld, now %ld", long(cut.euler),
         long(now.euler));
  DEMAND(cut.nonmanifold_edges == now.nonmanifold_edges, "edges where it touches itself stay: %ld, now %ld",
         long(cut.nonmanifold_edges), long(now.nonmanifold_edges));
  DEMAND(cut.nonmanifold_points == now.nonmanifold_points, "points where it touches itself stay: %ld, now %ld",
         long(cut.nonmanifold_points), long(now.nonmanifold_points));
}

void check_deviation(const std::vector<Point> &before, const std::vector<Face> &original,
                     const std::vector<Point> &after, const std::vector<Face> &boundary, double bound) {
  const double diagonal = diagonal_of(before, original);
  if (!(diagonal > 1e-60 && diagonal < 1e60)) return;  // products of four lengths leave the range of doubles
  const double moved = farthest(before, original, after, boundary), made = farthest(after, boundary, before, original);
  DEMAND(std::max(moved, made) <= (bound + 1e-9) * diagonal, "max-deviation %.17g of %g: %g, %g are measured", bound,
         diagonal, moved, made);
}

void check_values(const std::vector<double> &values, double low, double high) {
  for (std::size_t i = 0; i < values.size(); i++)
    DEMAND(values[i] >= low && values[i] <= high, "value %zu, %.17g, is in [%.17g, %.17g]", i, values[i], low, high);
}

void check_result(const Mesh &mesh, const Facts &facts, const Fetched &result, bool takes_contacts) {
  DEMAND(!result.tets.empty() && !result.points.empty(), "a result is not empty");
  DEMAND(result.values.size() == result.points.size(), "there is a value a point");
  check_corners(result.tets, result.points.size());
  check_positive(result.points, result.tets);
  check_conforming(result.tets, result.boundary);
  const bool is_tangled = !topology_of(facts.boundary).closed;  // then points may have been moved
  if (takes_contacts && (is_tangled || has_contacts(mesh.points, facts.boundary)))
    check_components(result.points, result.boundary);
  else
    check_surface(result.points, result.boundary);
  check_values(result.values, facts.values.low, facts.values.high);
  check_same_topology(facts.boundary, result.boundary);
  if (!is_tangled && crossing_of(mesh.points, facts.boundary).first < 0)
    check_same_cut_topology(mesh.points, facts.boundary, result.points, result.boundary);
}

}  // namespace fuzz
