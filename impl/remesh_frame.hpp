// The box near 1 in which TetGen works, and the exact way there and back.
#pragma once
#include <array>

#include "mesh.hpp"

namespace tetlod {

/// p -> (p * 2^-magnitude - shift) * 2^-zoom. Powers of two are exact. So is the shift: an axis is shifted only when
/// its coordinates have one sign and differ by less than a factor of two, and then by one of them (Sterbenz). What is
/// less than 1e-40 of the box becomes 0.
struct Frame {
  int magnitude = 0;
  Vec3 shift{0};
  std::array<int, 3> zoom{};

  Vec3 unit(const Vec3 &p) const;  ///< p * 2^-magnitude: in [-1, 1], where determinants neither over- nor underflow
  Vec3 into(const Vec3 &p) const;
  Vec3 back(const Vec3 &q) const;
};

/// The frame that keeps the shape; the longest extent becomes 1 to 2. The box must have extents above zero.
Frame uniform_frame(const Box &box);

/// The frame in which every extent becomes 1 to 2.
Frame stretched_frame(const Box &box);

}  // namespace tetlod
