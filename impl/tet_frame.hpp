// The linear functions of a tet, and whether its shape will do.
#pragma once
#include <algorithm>

#include "geometry.hpp"
#include "mesh.hpp"

namespace tetlod {

/// The linear functions that are 1 at one corner of a tet and 0 at the others.
struct TetFrame {
  Vec3 origin, row[3];
  double most;  ///< that a least weight may count as

  TetFrame() = default;
  TetFrame(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) : origin(a) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const Vec3 n = glm::cross(u, v);
    const double volume6 = glm::dot(n, w), inverse = 1 / volume6;
    row[0] = inverse * glm::cross(v, w);
    row[1] = inverse * glm::cross(w, u);
    row[2] = inverse * n;
    most = tetlod::is_flat(u, v, w, volume6) ? barely_outside : 1;
  }
  bool is_flat() const { return most < 0; }
  /// Barycentric weights of p; returns the least.
  double weights(const Vec3 &p, double w[4]) const {
    const Vec3 q = p - origin;
    for (int k = 0; k < 3; k++) w[k + 1] = glm::dot(row[k], q);
    w[0] = 1 - w[1] - w[2] - w[3];
    return std::min(std::min(std::min(w[0], w[1]), std::min(w[2], w[3])), most);  // in this order: NaN stays NaN
  }
  Vec3 gradient(double a, double b, double c, double d) const {
    return (b - a) * row[0] + (c - a) * row[1] + (d - a) * row[2];
  }
};

/// Smallest volume of a tet, over the cube of its longest edge.
constexpr double least_shape = 1e-5;

/// Square of the longest edge.
inline double longest2(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  return std::max({length2(b - a), length2(c - a), length2(d - a), length2(c - b), length2(d - b), length2(d - c)});
}

/// Whether (a, b, c, d) is positive, and no sliver worse than `limit`.
inline bool is_sound(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d, double limit) {
  const double volume = det(a, b, c, d);
  if (!(volume > 0)) return false;
  const double longest = longest2(a, b, c, d);
  return volume * volume > limit * limit * longest * longest * longest;
}

/// Square of the volume over the cube of the longest edge.
inline double shape2(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  const double volume = det(a, b, c, d), longest = longest2(a, b, c, d);
  return volume * volume / (longest * longest * longest);
}

/// The frame in which p lies, or, outside of all, the one that it is least outside of; `first` before others. Its
/// weights.
inline std::size_t home_among(const TetFrame *frames, std::size_t count, std::size_t first, const Vec3 &p,
                              double w[4]) {
  double best = frames[first].weights(p, w);
  std::size_t home = first;
  for (std::size_t k = 0; k < count && best < 0; k++) {
    double other[4];
    if (k == first) continue;
    const double least = frames[k].weights(p, other);
    if (least <= best) continue;
    best = least;
    home = k;
    std::copy(other, other + 4, w);
  }
  return home;
}

}  // namespace tetlod
