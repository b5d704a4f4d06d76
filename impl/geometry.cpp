#include "geometry.hpp"

namespace tetlod {

namespace {

Vec3 nearest_on_edge(const Vec3 &p, const Vec3 &from, const Vec3 &to, int i, int j) {
  const Vec3 edge = to - from;
  const double whole = length2(edge);
  const double t = whole > 0 ? std::clamp(glm::dot(p - from, edge) / whole, 0.0, 1.0) : 0.0;
  Vec3 weights(0);
  weights[i] = 1 - t;
  weights[j] = t;
  return weights;
}

}  // namespace

Vec3 nearest_in_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const Vec3 normal = area_vector(a, b, c);
  const double whole = length2(normal);
  if (whole > 0) {
    const Vec3 weights(glm::dot(glm::cross(c - b, p - b), normal) / whole,
                       glm::dot(glm::cross(a - c, p - c), normal) / whole,
                       glm::dot(glm::cross(b - a, p - a), normal) / whole);
    if (weights.x >= 0 && weights.y >= 0 && weights.z >= 0) return weights;
  }
  const Vec3 candidates[3] = {nearest_on_edge(p, a, b, 0, 1), nearest_on_edge(p, b, c, 1, 2),
                              nearest_on_edge(p, c, a, 2, 0)};
  const auto distance2 = [&](const Vec3 &w) { return length2(w.x * (a - p) + w.y * (b - p) + w.z * (c - p)); };
  int best = 0;
  for (int k = 1; k < 3; k++)
    if (distance2(candidates[k]) < distance2(candidates[best])) best = k;
  return candidates[best];
}

}  // namespace tetlod
