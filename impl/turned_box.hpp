// The box of some points along their own extent: that of thin things which lie askew to the axes is thin, too.
#pragma once
#include "geometry.hpp"

namespace tetlod {

class TurnedBox {
 public:
  /// Of one point at least.
  explicit TurnedBox(Span<const Vec3> points) : from_(points[0]) {
    find_axes(points);
    for (const Vec3 &p : points) box_.add(turned(p - from_));
    size_ = box_.diagonal();
  }

  /// All of the triangle is beyond a side, so clearly that rounding has no say.
  bool is_clear_of(const Vec3 corners[3]) const {
    constexpr double rounding = 1e-14;
    Box box;
    Vec3 far(0);
    for (int k = 0; k < 3; k++) {
      const Vec3 way = corners[k] - from_;
      box.add(turned(way));
      far += glm::abs(way);
    }
    const double margin = rounding * (far.x + far.y + far.z + size_);
    return !overlap({box.low - margin, box.high + margin}, box_);
  }

 private:
  /// To the point that is farthest from the first one; to the one that is farthest off the way there; across both.
  /// What has no length stays zero, and nothing is beyond it.
  void find_axes(Span<const Vec3> points) {
    for (int k = 0; k < 2; k++) {
      Vec3 longest(0);
      for (const Vec3 &p : points) {
        const Vec3 way = p - from_, across = way - glm::dot(way, axis_[0]) * axis_[0];
        if (length2(across) > length2(longest)) longest = across;
      }
      if (const double length = glm::length(longest); length > 0) axis_[k] = longest / length;
    }
    axis_[2] = glm::cross(axis_[0], axis_[1]);
  }

  Vec3 turned(const Vec3 &way) const {
    return {glm::dot(axis_[0], way), glm::dot(axis_[1], way), glm::dot(axis_[2], way)};
  }

  Vec3 from_, axis_[3] = {Vec3(0), Vec3(0), Vec3(0)};
  Box box_;
  double size_;
};

}  // namespace tetlod
