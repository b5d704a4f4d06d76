// The quadric of a vertex in (x, y, z, w scalar), kept about the vertex itself, where nothing cancels. A tet stands for
// the squared difference between a value and its own linear function, continued to the place; a boundary triangle for
// the squared distance from its plane [Garland and Zhou 2005, with the scalar's error upright].
#pragma once
#include "geometry.hpp"
#include "solver4.hpp"

namespace tetlod {

inline Vec4 minus(const Vec4 &a, const Vec4 &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}; }
/// a + t d.
inline Vec4 along(const Vec4 &a, double t, const Vec4 &d) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2], a[3] + t * d[3]};
}

/// d^T a d + 2 g . d + e at the distance d from where it is kept. Of a the lower triangle, row by row.
struct LocalQuadric {
  std::array<double, 10> a{};
  Vec4 g{};
  double e = 0;

  Vec4 times(const Vec4 &d) const {
    return {
        a[0] * d[0] + a[1] * d[1] + a[3] * d[2] + a[6] * d[3], a[1] * d[0] + a[2] * d[1] + a[4] * d[2] + a[7] * d[3],
        a[3] * d[0] + a[4] * d[1] + a[5] * d[2] + a[8] * d[3], a[6] * d[0] + a[7] * d[1] + a[8] * d[2] + a[9] * d[3]};
  }
  /// weight times (normal . d)^2.
  void add_square(const Vec4 &normal, double weight) {
    std::size_t entry = 0;
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = 0; j <= i; j++) a[entry++] += weight * normal[i] * normal[j];
  }
  /// The same function, kept at the distance d.
  LocalQuadric moved(const Vec4 &d) const {
    LocalQuadric q = *this;
    const Vec4 image = times(d);
    q.e = e + 2 * dot4(g, d) + dot4(d, image);
    for (std::size_t k = 0; k < 4; k++) q.g[k] = g[k] + image[k];
    return q;
  }
  void add(const LocalQuadric &o) {
    for (std::size_t i = 0; i < 10; i++) a[i] += o.a[i];
    for (std::size_t i = 0; i < 4; i++) g[i] += o.g[i];
    e += o.e;
  }
};

/// Where the sum of two quadrics is least along the edge between their vertices.
struct BestOfEdge {
  double t = 0;     ///< from the first vertex, 0, to the second, 1
  double cost = 0;  ///< by how much the sum is more there than at the vertices
};

/// d: from the first vertex to the second. first_stays: t is 0.
inline BestOfEdge best_of_edge(const LocalQuadric &first, const LocalQuadric &second, const Vec4 &d, bool first_stays) {
  const double x = d[0], y = d[1], z = d[2], s = d[3];
  const double products[10] = {x * x, 2 * x * y, y * y,     2 * x * z, 2 * y * z,
                               z * z, 2 * x * s, 2 * y * s, 2 * z * s, s * s};
  double first_bend = 0, second_bend = 0;
  for (std::size_t i = 0; i < 10; i++) {
    first_bend += products[i] * first.a[i];
    second_bend += products[i] * second.a[i];
  }
  const double at_first = second_bend - 2 * dot4(second.g, d);
  if (first_stays) return {0, at_first};
  const double at_second = first_bend + 2 * dot4(first.g, d);
  const double bend = first_bend + second_bend, slope = at_second - at_first - bend;
  const double t = bend > 0 ? std::clamp(-0.5 * slope / bend, 0.0, 1.0) : 0.5;
  return {t, at_first + t * (slope + t * bend)};
}

/// A step with normal . step = offset, in space; without a normal, any.
struct StepConstraint {
  Vec3 normal{0};
  double offset = 0;
};

/// The step from where q is kept to its least, with a small pull back where it says nothing. False: rounding leaves no
/// answer.
inline bool step_to_least(const LocalQuadric &q, const StepConstraint &constraint, Vec4 &step) {
  constexpr double pull = 1e-3;
  std::array<double, 10> a = q.a;
  const double of_place = pull * (a[0] + a[2] + a[5]) / 3;
  for (std::size_t i : {0, 2, 5}) a[i] += of_place + 1e-9 * a[9];
  a[9] *= 1 + pull;
  const Solver4 solver(a, 0);
  if (!solver.regular()) return false;
  step = solver.solve({-q.g[0], -q.g[1], -q.g[2], -q.g[3]});
  if (constraint.normal != Vec3(0)) {
    const Vec4 normal{constraint.normal.x, constraint.normal.y, constraint.normal.z, 0};
    const Vec4 across = solver.solve(normal);
    step = along(step, (constraint.offset - dot4(normal, step)) / dot4(normal, across), across);
  }
  return std::isfinite(step[0] + step[1] + step[2] + step[3]);
}

}  // namespace tetlod
