// Whether points lie on edges, and triangles on one another, but for the rounding of coordinates.
#pragma once
#include <algorithm>
#include <cmath>

#include "geometry.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Of the corners of the triangles, whose coordinates may have six digits, as they mostly do in text.
inline double rounding_of_six_digits(Span<const Vec3> points, Span<const Triangle> triangles) {
  double largest = 0;
  for (const Triangle &t : triangles)
    for (const std::int32_t v : t)
      for (int k = 0; k < 3; k++) largest = std::max(largest, std::abs(points[std::size_t(v)][k]));
  return 1e-5 * largest;
}

/// Whether the tip of a way from one end of an edge lies on the edge, and not beside one of its ends.
inline bool lies_on(const Vec3 &way, const Vec3 &edge, double rounding) {
  constexpr double most = 1e-3;  // of the way to the nearer end
  const double along = glm::dot(way, edge), edge2 = length2(edge);
  const Vec3 from_nearer_end = 2 * along < edge2 ? way : way - edge;
  const double off2 = length2(glm::cross(from_nearer_end, edge));
  return 0 < along && along < edge2 && off2 <= rounding * rounding * edge2 &&
         off2 <= most * most * length2(from_nearer_end) * edge2;
}

/// Whether normals are opposite, but for rounding.
inline bool are_back_to_back(const Vec3 &normal, const Vec3 &other) {
  constexpr double rounding = 0.01;
  return glm::dot(normal, other) < 0 &&
         length2(glm::cross(normal, other)) <= rounding * rounding * length2(normal) * length2(other);
}

}  // namespace tetlod
