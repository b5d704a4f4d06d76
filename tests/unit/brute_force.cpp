#include "brute_force.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kd_tree.hpp"
#include "predicates.hpp"

namespace tetlod::test {

namespace {

using Real = long double;
using Point = std::array<Real, 3>;

Point to_point(const Vec3 &p) { return {Real(p.x), Real(p.y), Real(p.z)}; }
Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Real dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point along(const Point &a, const Point &b, Real t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

Real volume6(const Point *p) { return dot(minus(p[3], p[0]), cross(minus(p[1], p[0]), minus(p[2], p[0]))); }

std::array<Point, 3> corners(Span<const Vec3> points, const Triangle &t) {
  return {to_point(points[std::size_t(t[0])]), to_point(points[std::size_t(t[1])]),
          to_point(points[std::size_t(t[2])])};
}

Point nearest_on_segment(const Point &p, const Point &a, const Point &b) {
  const Point ab = minus(b, a);
  const Real whole = dot(ab, ab);
  const Real t = whole > 0 ? std::clamp(dot(minus(p, a), ab) / whole, Real(0), Real(1)) : 0;
  return along(a, b, t);
}

Point nearest_on_triangle(const Point &p, const std::array<Point, 3> &t) {
  const Point n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const Real whole = dot(n, n);
  bool above = whole > 0;
  for (std::size_t k = 0; k < 3 && above; k++) above = dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) >= 0;
  if (above) {
    const Real height = dot(minus(p, t[0]), n) / whole;
    return {p[0] - height * n[0], p[1] - height * n[1], p[2] - height * n[2]};
  }
  Point best = nearest_on_segment(p, t[0], t[1]);
  for (std::size_t k = 1; k < 3; k++) {
    const Point other = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    if (dot(minus(p, other), minus(p, other)) < dot(minus(p, best), minus(p, best))) best = other;
  }
  return best;
}

Real solid_angle(const Point &p, const std::array<Point, 3> &t) {
  const Point a = minus(t[0], p), b = minus(t[1], p), c = minus(t[2], p);
  const Real la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

}  // namespace

SurfaceFacts facts_of(Span<const Triangle> triangles) {
  std::map<std::int32_t, std::int32_t> parent;
  const auto root = [&](std::int32_t v) {
    while (parent.at(v) != v) v = parent.at(v);
    return v;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<int, int>> edges;  // upward, downward
  SurfaceFacts facts;
  for (const Triangle &t : triangles) {
    for (std::int32_t v : t) parent.emplace(v, v);
    for (std::size_t k = 0; k < 3; k++) {
      const std::int32_t a = t[k], b = t[(k + 1) % 3];
      auto &uses = edges[{std::min(a, b), std::max(a, b)}];
      (a < b ? uses.first : uses.second)++;
      parent[root(a)] = root(b);
    }
  }
  for (const auto &[edge, uses] : edges) {
    facts.closed = facts.closed && uses.first == uses.second && edge.first != edge.second;
    facts.nonmanifold_edges += uses.first + uses.second > 2;
  }
  for (const auto &[v, up] : parent) facts.components += v == up;
  facts.vertices = std::int64_t(parent.size());
  facts.edges = std::int64_t(edges.size());
  facts.triangles = std::int64_t(triangles.size());
  facts.euler = facts.vertices - facts.edges + facts.triangles;
  return facts;
}

double volume_inside(Span<const Vec3> points, Span<const Triangle> triangles) {
  if (triangles.empty()) return 0;
  const Point origin = to_point(points[std::size_t(triangles[0][0])]);
  Real sum = 0;
  for (const Triangle &t : triangles) {
    const auto c = corners(points, t);
    sum += dot(minus(c[0], origin), cross(minus(c[1], origin), minus(c[2], origin)));
  }
  return double(sum / 6);
}

Triangle lowest_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::multiset<Triangle> oriented_triangles(Span<const Triangle> triangles) {
  std::multiset<Triangle> all;
  for (const Triangle &t : triangles) all.insert(lowest_first(t));
  return all;
}

std::multiset<Triangle> brute_boundary(const Mesh &mesh) {
  std::map<std::set<std::int32_t>, std::vector<Triangle>> faces;
  for (const Tet &t : mesh.tets)
    for (std::size_t k = 0; k < 4; k++) {
      Triangle face{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      const auto c = corners({mesh.points.data(), mesh.points.size()}, face);
      const Point inner = to_point(mesh.points[std::size_t(t[k])]);
      if (dot(cross(minus(c[1], c[0]), minus(c[2], c[0])), minus(inner, c[0])) > 0) std::swap(face[0], face[1]);
      faces[{face.begin(), face.end()}].push_back(face);
    }
  std::multiset<Triangle> once;
  for (const auto &[key, users] : faces)
    if (users.size() == 1) once.insert(lowest_first(users[0]));
  return once;
}

std::vector<std::pair<std::int32_t, std::int32_t>> crossings(const Surface &surface, Memory &memory) {
  Array<Box> boxes(surface.triangles.size(), &memory);
  const auto points_of = [&](std::size_t t) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; k++) p[k] = surface.points[std::size_t(surface.triangles[t][k])];
    return p;
  };
  for (std::size_t t = 0; t < boxes.size(); t++)
    for (const Vec3 &p : points_of(t)) boxes[t].add(p);
  const std::vector<Box> box_of(boxes.begin(), boxes.end());
  const Parallel parallel;
  Job job(memory, parallel);
  KdTree tree(memory);
  tree.build(std::move(boxes), 8, job);
  std::vector<std::pair<std::int32_t, std::int32_t>> found;
  for (std::size_t t = 0; t < box_of.size(); t++)
    tree.any_overlap(box_of[t], [&](std::int32_t other) {
      if (std::size_t(other) <= t) return false;
      const auto p = points_of(t), q = points_of(std::size_t(other));
      if (!triangles_apart(p.data(), surface.triangles[t], q.data(), surface.triangles[std::size_t(other)]))
        found.emplace_back(std::int32_t(t), other);
      return false;
    });
  return found;
}

double winding_number(Span<const Vec3> points, Span<const Triangle> triangles, const Vec3 &p) {
  Real sum = 0;
  for (const Triangle &t : triangles) sum += solid_angle(to_point(p), corners(points, t));
  return double(sum / (4 * std::acos(Real(-1))));
}

BruteNearest brute_nearest(Span<const Vec3> points, Span<const Triangle> triangles, const Vec3 &p) {
  BruteNearest best;
  Real least = -1;
  for (std::size_t t = 0; t < triangles.size(); t++) {
    const Point at = nearest_on_triangle(to_point(p), corners(points, triangles[t]));
    const Real distance2 = dot(minus(to_point(p), at), minus(to_point(p), at));
    if (least >= 0 && distance2 >= least) continue;
    least = distance2;
    best.triangle = std::int32_t(t);
    best.point = {double(at[0]), double(at[1]), double(at[2])};
  }
  best.distance = double(std::sqrt(std::max(least, Real(0))));
  return best;
}

double brute_largest_error(const Mesh &original, const TetMesh &mesh) {
  constexpr double near = 1e-6;
  std::vector<double> least(original.points.size(), -near), error(original.points.size(), 0);
  for (const Tet &t : mesh.tets) {
    Point corner[4];
    for (std::size_t k = 0; k < 4; k++) corner[k] = to_point(mesh.points[std::size_t(t[k])]);
    const Real whole = volume6(corner);
    for (std::size_t v = 0; v < least.size(); v++) {
      Real lowest = 1, value = 0;
      for (std::size_t k = 0; k < 4; k++) {
        Point moved[4] = {corner[0], corner[1], corner[2], corner[3]};
        moved[k] = to_point(original.points[v]);
        const Real weight = volume6(moved) / whole;
        lowest = std::min(lowest, weight);
        value += weight * Real(mesh.scalars[std::size_t(t[k])]);
      }
      if (!(lowest > Real(least[v]))) continue;
      least[v] = double(lowest);
      error[v] = std::abs(double(value) - original.scalars[v]);
    }
  }
  const auto [low, high] = std::minmax_element(original.scalars.begin(), original.scalars.end());
  return *std::max_element(error.begin(), error.end()) / (*high - *low);
}

}  // namespace tetlod::test
