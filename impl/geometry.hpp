// Small geometry that several stages share: determinants, the nearest point of a triangle, barycentric weights.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "mesh.hpp"
#include "portable_math.hpp"

namespace tetlod {

/// Six times the signed volume of (a, b, c, d); positive when b, c, d are counter-clockwise seen from outside, i.e.
/// when d is on the side of (b - a) x (c - a).
inline double det(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

inline double six_volume(Span<const Vec3> points, const Tet &t) {
  const auto at = [&](std::size_t k) -> const Vec3 & { return points[std::size_t(t[k])]; };
  return det(at(0), at(1), at(2), at(3));
}

/// Twice the area vector of a triangle.
inline Vec3 area_vector(const Vec3 &a, const Vec3 &b, const Vec3 &c) { return glm::cross(b - a, c - a); }

inline Vec3 area_vector(Span<const Vec3> points, const Triangle &t) {
  return area_vector(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]);
}

/// Exact, as long as nothing becomes subnormal.
inline Vec3 times_power_of_two(const Vec3 &p, int exponent) {
  return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
}

inline bool is_finite(const Vec3 &p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// By x, those by y, those by z.
inline bool is_before(const Vec3 &p, const Vec3 &q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); }

inline double length2(const Vec3 &v) { return glm::dot(v, v); }

/// 1 for an equilateral triangle, 0 for a degenerate one: 4 sqrt(3) area / sum of squared edges.
inline double triangle_quality(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double edges = length2(b - a) + length2(c - b) + length2(a - c);
  return edges > 0 ? 2 * std::sqrt(3.0) * glm::length(area_vector(a, b, c)) / edges : 0;
}

/// The point of a triangle nearest to p, as barycentric weights.
Vec3 nearest_in_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c);

/// Copies of a triangle's corners, as points may be added meanwhile.
struct TriangleInSpace {
  Vec3 a, b, c;
  TriangleInSpace(const Vec3 &first, const Vec3 &second, const Vec3 &third) : a(first), b(second), c(third) {}
  TriangleInSpace(Span<const Vec3> points, const Triangle &t)
      : a(points[std::size_t(t[0])]), b(points[std::size_t(t[1])]), c(points[std::size_t(t[2])]) {}
  Vec3 middle() const { return (a + b + c) / 3.0; }
  Vec3 at(const Vec3 &weights) const { return weights.x * a + weights.y * b + weights.z * c; }
  Vec3 weights_nearest_to(const Vec3 &p) const { return nearest_in_triangle(p, a, b, c); }
  /// As seen from p: far from the origin the point itself is rounded by more than it is off.
  double distance2_to(const Vec3 &p) const {
    const Vec3 w = weights_nearest_to(p);
    return length2(w.x * (a - p) + w.y * (b - p) + w.z * (c - p));
  }
};

/// Linear between the values at the ends, at the point of the edge nearest to x; never beyond them by rounding.
inline double value_along_edge(const Vec3 &x, const Vec3 &from, const Vec3 &to, double value_from, double value_to) {
  const Vec3 edge = to - from;
  const double whole = length2(edge);
  const double t = whole > 0 ? std::clamp(glm::dot(x - from, edge) / whole, 0.0, 1.0) : 0.5;
  const auto [low, high] = std::minmax(value_from, value_to);
  return std::clamp((1 - t) * value_from + t * value_to, low, high);
}

/// The same of each field.
template <std::size_t m>
Values<m> values_along_edge(const Vec3 &x, const Vec3 &from, const Vec3 &to, const Values<m> &values_from,
                            const Values<m> &values_to) {
  Values<m> values;
  for (std::size_t k = 0; k < m; k++) values[k] = value_along_edge(x, from, to, values_from[k], values_to[k]);
  return values;
}

/// What a triangle adds to the winding number of p: its solid angle (Van Oosterom and Strackee 1983) over 4 pi,
/// positive from its inner side.
inline double winding_share(const Vec3 &p, const Vec3 &x, const Vec3 &y, const Vec3 &z) {
  constexpr double two_pi = 6.283185307179586;
  const Vec3 a = x - p, b = y - p, c = z - p;
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double above = glm::dot(a, glm::cross(b, c));
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return angle_of(above, below) / two_pi;
}

/// A point this far out of a tet, in barycentric weight, is out of it by rounding.
constexpr double out_by_rounding = 1e-6;

/// What the least weight of a point in a flat tet counts as, at most: the point is taken in another, where there is
/// one.
constexpr double barely_outside = -0.999 * out_by_rounding;

/// Volume over the product of three edges, or the cube of the longest: weights in flatter tets are what rounding makes
/// of them, where the tets do not lie along the axes.
constexpr double flattest = 1e-11;

/// Seen from the corner that these edges have in common, and that weights are reckoned from.
inline bool is_flat(const Vec3 &u, const Vec3 &v, const Vec3 &w, double volume6) {
  return !(volume6 * volume6 > flattest * flattest * length2(u) * length2(v) * length2(w));
}

/// The box of a tet, given its own, with the points that are out of it by rounding: three weights may be.
inline Box with_rounding(const Box &own) {
  const Vec3 margin = 3 * out_by_rounding * (own.high - own.low);
  return {own.low - margin, own.high + margin};
}

/// Barycentric weights of p in a tet of either winding; false for a tet without volume, which has none.
inline bool barycentric(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d, double weights[4]) {
  const double whole = det(a, b, c, d);
  if (whole == 0) return false;
  weights[0] = det(p, b, c, d) / whole;
  weights[1] = det(a, p, c, d) / whole;
  weights[2] = det(a, b, p, d) / whole;
  weights[3] = 1 - weights[0] - weights[1] - weights[2];
  return true;
}

}  // namespace tetlod
