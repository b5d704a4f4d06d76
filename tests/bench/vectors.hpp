// A little geometry of the judge's own.
#pragma once

#include "bench_mesh.hpp"

namespace bench {

inline Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

inline double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Point cross(const Point &a, const Point &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double triple(const Point &a, const Point &b, const Point &c) { return dot(a, cross(b, c)); }

// Positive for a tet whose corners are in the order that the C ABI asks for.
inline double six_volumes(const Mesh &mesh, const Tet &tet) {
  const Point &origin = mesh.points[std::size_t(tet[0])];
  return triple(minus(mesh.points[std::size_t(tet[1])], origin), minus(mesh.points[std::size_t(tet[2])], origin),
                minus(mesh.points[std::size_t(tet[3])], origin));
}

}  // namespace bench
