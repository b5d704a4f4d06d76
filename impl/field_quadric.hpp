// 3.2, past the paper: a boundary that sees the fields. Cost and placement of an edge collapse by quadrics in
// (x, y, z, w scalar, ...), after Garland and Zhou, "Quadric-based simplification in any dimension" (2005): the squared
// distance, in so many dimensions, to the planes of the triangles that a vertex stands for, weighted by their areas.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "cholesky.hpp"
#include "lindstrom_turk.hpp"

namespace tetlod {

/// x^T a x + 2 b . x + c.
template <std::size_t n>
struct FieldQuadric {
  Triangular<n> a{};
  Vector<n> b{};
  double c = 0;

  void add(const FieldQuadric &o) {
    for (std::size_t i = 0; i < a.size(); i++) a[i] += o.a[i];
    for (std::size_t i = 0; i < n; i++) b[i] += o.b[i];
    c += o.c;
  }
  double operator()(const Vector<n> &x) const { return dot(x, times<n>(a, x)) + 2 * dot(b, x) + c; }
};

/// Area times the squared distance to the plane through p, q, r; nothing for a triangle without area.
template <std::size_t n>
FieldQuadric<n> quadric_of(const Vector<n> &p, const Vector<n> &q, const Vector<n> &r) {
  Vector<n> e, f;
  for (std::size_t k = 0; k < n; k++) {
    e[k] = q[k] - p[k];
    f[k] = r[k] - p[k];
  }
  FieldQuadric<n> quadric;
  const double e2 = dot(e, e);
  if (!(e2 > 0)) return quadric;
  for (double &x : e) x /= std::sqrt(e2);
  const double along = dot(e, f);
  for (std::size_t k = 0; k < n; k++) f[k] -= along * e[k];
  const double f2 = dot(f, f);
  if (!(f2 > 0)) return quadric;
  for (double &x : f) x /= std::sqrt(f2);
  const double area = 0.5 * std::sqrt(e2 * f2);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < n; i++)
    for (std::size_t j = 0; j <= i; j++) quadric.a[entry++] = area * ((i == j) - e[i] * e[j] - f[i] * f[j]);
  const Vector<n> image = times<n>(quadric.a, p);
  for (std::size_t k = 0; k < n; k++) quadric.b[k] = -image[k];
  quadric.c = dot(p, image);
  return quadric;
}

/// Where the quadric and a small pull to the edge's middle have their least, on the plane that keeps the volume
/// [Lindstrom and Turk] where there is one. x is the edge's middle before. False when
/// rounding leaves no answer.
template <std::size_t n>
bool place_by_quadric(const FieldQuadric<n> &quadric, const VolumeSums &volume, Vector<n> &x) {
  constexpr double pull = 1e-3;
  Triangular<n> a = quadric.a;
  const double weight = pull * trace<n>(a) / double(n);
  for (std::size_t i = 0; i < n; i++) a[entry_of(i, i)] += weight;
  const Cholesky<n> solver(a, 1e-12 * trace<n>(a));
  if (!solver.regular()) return false;
  const Vector<n> middle = x;
  // From the middle on: what cancels there costs no digits.
  const Vector<n> image = times<n>(quadric.a, middle);
  Vector<n> down;
  for (std::size_t k = 0; k < n; k++) down[k] = -quadric.b[k] - image[k];
  Vector<n> step = solver.solve(down);
  if (volume_is_constrained(volume)) {
    const Vector<n> normal{volume.normal.x, volume.normal.y, volume.normal.z};
    const Vector<n> across = solver.solve(normal);
    const double lack = volume.offset - dot(normal, middle) - dot(normal, step);
    for (std::size_t k = 0; k < n; k++) step[k] += across[k] * (lack / dot(normal, across));
  }
  double sum = 0;
  for (std::size_t k = 0; k < n; k++) sum += x[k] = middle[k] + step[k];
  return std::isfinite(sum);
}

/// The quadric's least between a and b, and where it is.
template <std::size_t n>
double least_along_edge(const FieldQuadric<n> &quadric, const Vector<n> &a, const Vector<n> &b, Vector<n> &x) {
  Vector<n> half;
  for (std::size_t k = 0; k < n; k++) {
    x[k] = 0.5 * a[k] + 0.5 * b[k];
    half[k] = 0.5 * b[k] - 0.5 * a[k];
  }
  const Vector<n> image = times<n>(quadric.a, x);
  const double bend = dot(half, times<n>(quadric.a, half)), slope = dot(half, image) + dot(half, quadric.b);
  const double t = bend > 0 ? std::clamp(-slope / bend, -1.0, 1.0) : 0;
  const double at_middle = dot(x, image) + 2 * dot(quadric.b, x) + quadric.c;
  for (std::size_t k = 0; k < n; k++) x[k] += t * half[k];
  return at_middle + t * (2 * slope + t * bend);
}

/// What the cost of shape counts beside a quadric's: it decides where that is nothing, on plane walls with a linear
/// field.
template <std::size_t n>
double collapse_cost(double of_quadric, const Vector<n> &x, const LinkSums &link, double length2_e) {
  constexpr double shape_share = 1e-5;
  return std::max(of_quadric, 0.0) + shape_share * collapse_cost(link, {x[0], x[1], x[2]}, length2_e);
}

/// The quadrics of the vertices of a surface, and the weights of its values.
template <std::size_t m>
class FieldQuadrics {
 public:
  explicit FieldQuadrics(Memory &memory) : quadric_(&memory) {}

  using Point = Vector<3 + m>;

  void find(const std::array<double, most_fields> &weight, Span<const Triangle> triangles, Span<const Vec3> points,
            Span<const Values<m>> values) {
    weight_ = weight;
    quadric_.resize(points.size());
    const auto corner = [&](std::int32_t v) { return with_values(points[std::size_t(v)], values[std::size_t(v)]); };
    for (const Triangle &t : triangles) {
      const FieldQuadric<3 + m> q = quadric_of(corner(t[0]), corner(t[1]), corner(t[2]));
      for (std::int32_t v : t) quadric_[std::size_t(v)].add(q);
    }
    for (const Values<m> &of_vertex : values) range_.add(of_vertex);
  }
  bool empty() const { return quadric_.empty(); }

  Point with_values(const Vec3 &p, const Values<m> &values) const {
    Point x{p.x, p.y, p.z};
    for (std::size_t k = 0; k < m; k++) x[3 + k] = weight_[k] * values[k];
    return x;
  }
  Values<m> values_of(const Point &x) const {
    Values<m> values;
    for (std::size_t k = 0; k < m; k++) values[k] = x[3 + k] / weight_[k];
    return range_.clamp(values);
  }

  FieldQuadric<3 + m> of_edge(int from, int to) const {
    FieldQuadric<3 + m> sum = quadric_[std::size_t(from)];
    sum.add(quadric_[std::size_t(to)]);
    return sum;
  }
  void merge(int from, int to) { quadric_[std::size_t(to)].add(quadric_[std::size_t(from)]); }

 private:
  std::array<double, most_fields> weight_{};
  ValueRange<m> range_;
  Array<FieldQuadric<3 + m>> quadric_;
};

}  // namespace tetlod
