// 3.2, past the paper: a boundary that sees the field. Cost and placement of an edge collapse by quadrics in
// (x, y, z, w scalar), after Garland and Zhou, "Quadric-based simplification in any dimension" (2005): the squared
// distance, in four dimensions, to the planes of the triangles that a vertex stands for, weighted by their areas.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "lindstrom_turk.hpp"
#include "solver4.hpp"

namespace tetlod {

/// x^T a x + 2 b . x + c, of which the lower triangle of a is kept, row by row.
struct FieldQuadric {
  std::array<double, 10> a{};
  Vec4 b{};
  double c = 0;

  void add(const FieldQuadric &o) {
    for (std::size_t i = 0; i < 10; i++) a[i] += o.a[i];
    for (std::size_t i = 0; i < 4; i++) b[i] += o.b[i];
    c += o.c;
  }
  Vec4 times(const Vec4 &x) const {
    return {
        a[0] * x[0] + a[1] * x[1] + a[3] * x[2] + a[6] * x[3], a[1] * x[0] + a[2] * x[1] + a[4] * x[2] + a[7] * x[3],
        a[3] * x[0] + a[4] * x[1] + a[5] * x[2] + a[8] * x[3], a[6] * x[0] + a[7] * x[1] + a[8] * x[2] + a[9] * x[3]};
  }
  double operator()(const Vec4 &x) const { return dot4(x, times(x)) + 2 * dot4(b, x) + c; }
};

/// Area times the squared distance to the plane through p, q, r; nothing for a triangle without area.
inline FieldQuadric quadric_of(const Vec4 &p, const Vec4 &q, const Vec4 &r) {
  Vec4 e, f;
  for (std::size_t k = 0; k < 4; k++) {
    e[k] = q[k] - p[k];
    f[k] = r[k] - p[k];
  }
  FieldQuadric quadric;
  const double e2 = dot4(e, e);
  if (!(e2 > 0)) return quadric;
  for (double &x : e) x /= std::sqrt(e2);
  const double along = dot4(e, f);
  for (std::size_t k = 0; k < 4; k++) f[k] -= along * e[k];
  const double f2 = dot4(f, f);
  if (!(f2 > 0)) return quadric;
  for (double &x : f) x /= std::sqrt(f2);
  const double area = 0.5 * std::sqrt(e2 * f2);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 4; i++)
    for (std::size_t j = 0; j <= i; j++) quadric.a[entry++] = area * ((i == j) - e[i] * e[j] - f[i] * f[j]);
  const Vec4 image = quadric.times(p);
  for (std::size_t k = 0; k < 4; k++) quadric.b[k] = -image[k];
  quadric.c = dot4(p, image);
  return quadric;
}

/// Where the quadric and a small pull to the edge's middle have their least, on the plane that keeps the volume
/// [Lindstrom and Turk] where there is one. x is the edge's middle before. False when
/// rounding leaves no answer.
inline bool place_by_quadric(const FieldQuadric &quadric, const VolumeSums &volume, Vec4 &x) {
  constexpr double pull = 1e-3;
  std::array<double, 10> a = quadric.a;
  const double weight = pull * (a[0] + a[2] + a[5] + a[9]) / 4;
  for (std::size_t i : {0, 2, 5, 9}) a[i] += weight;
  const Solver4 solver(a, 1e-12 * (a[0] + a[2] + a[5] + a[9]));
  if (!solver.regular()) return false;
  const Vec4 middle = x;
  // From the middle on: what cancels there costs no digits.
  const Vec4 image = quadric.times(middle);
  Vec4 down;
  for (std::size_t k = 0; k < 4; k++) down[k] = -quadric.b[k] - image[k];
  Vec4 step = solver.solve(down);
  if (volume_is_constrained(volume)) {
    const Vec4 normal{volume.normal.x, volume.normal.y, volume.normal.z, 0};
    const Vec4 across = solver.solve(normal);
    const double lack = volume.offset - dot4(normal, middle) - dot4(normal, step);
    for (std::size_t k = 0; k < 4; k++) step[k] += across[k] * (lack / dot4(normal, across));
  }
  for (std::size_t k = 0; k < 4; k++) x[k] = middle[k] + step[k];
  return std::isfinite(x[0] + x[1] + x[2] + x[3]);
}

/// What the cost of shape counts beside a quadric's: it decides where that is nothing, on plane walls with a linear
/// field.
inline double collapse_cost(const FieldQuadric &quadric, const Vec4 &x, const LinkSums &link, double length2_e) {
  constexpr double shape_share = 1e-5;
  return std::max(quadric(x), 0.0) + shape_share * collapse_cost(link, {x[0], x[1], x[2]}, length2_e);
}

/// The quadrics of the vertices of a surface, and the weight of its values.
class FieldQuadrics {
 public:
  explicit FieldQuadrics(Memory &memory) : quadric_(&memory) {}

  void find(double weight, Span<const Triangle> triangles, Span<const Vec3> points, Span<const double> values) {
    weight_ = weight;
    quadric_.resize(points.size());
    const auto corner = [&](std::int32_t v) { return with_value(points[std::size_t(v)], values[std::size_t(v)]); };
    for (const Triangle &t : triangles) {
      const FieldQuadric q = quadric_of(corner(t[0]), corner(t[1]), corner(t[2]));
      for (std::int32_t v : t) quadric_[std::size_t(v)].add(q);
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    low_ = *low;
    high_ = *high;
  }
  bool empty() const { return quadric_.empty(); }

  Vec4 with_value(const Vec3 &p, double value) const { return {p.x, p.y, p.z, weight_ * value}; }
  double value_of(const Vec4 &x) const { return std::clamp(x[3] / weight_, low_, high_); }

  FieldQuadric of_edge(int from, int to) const {
    FieldQuadric sum = quadric_[std::size_t(from)];
    sum.add(quadric_[std::size_t(to)]);
    return sum;
  }
  void merge(int from, int to) { quadric_[std::size_t(to)].add(quadric_[std::size_t(from)]); }

 private:
  double weight_ = 0, low_ = 0, high_ = 0;
  Array<FieldQuadric> quadric_;
};

}  // namespace tetlod
