// Points at one place become one, but of parts that only touch.
#pragma once
#include "touching_parts.hpp"

namespace tetlod {

struct Merged {
  std::int64_t points = 0;   ///< merged away
  bool depends = false;      ///< where parts may not be in contact, or may, it could be others
  bool sees_values = false;  ///< so it could with other values
  Torn torn;
};

/// Which points become one: merge_points() with the option's tolerance in that box, but with no less than what rounding
/// makes of one place, unless the mesh is as thin as that; and, where parts may be in contact,
/// keep_touching_parts_apart().
Merged merge_coincident(const Input &input, Span<const Vec3> points, Span<const Tet> tets,
                        Span<const std::uint8_t> used, const Box &box, const Options &options, Job &job,
                        Array<std::int32_t> &representative);

}  // namespace tetlod
