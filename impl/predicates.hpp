// Signs of determinants, exact: a filter first, and where rounding might have decided, expansion arithmetic
// (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997).
// Exact for coordinates whose triple products neither overflow nor underflow.
#pragma once
#include "mesh.hpp"

namespace tetlod {

/// Sign of det(b - a, c - a, d - a): 1 when d is on the side of (b - a) x (c - a), 0 when the four are in one plane.
int orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d);
/// Of the corners of a tet.
inline int orientation(Span<const Vec3> points, const Tet &t) {
  const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
  return orientation(at(0), at(1), at(2), at(3));
}

/// In the coordinates i and j: 1 when a -> b -> c turns left, 0 when the three are on one line.
int turn(const Vec3 &a, const Vec3 &b, const Vec3 &c, int i, int j);

/// The two triangles share nothing but the vertices that they have in common by id. A triangle without area is
/// never apart from what it touches in its plane.
bool triangles_apart(const Vec3 *first, const Triangle &first_ids, const Vec3 *second, const Triangle &second_ids);

}  // namespace tetlod
