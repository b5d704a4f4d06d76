// Points at one place become one, but of parts that only touch.
#pragma once
#include "pipeline.hpp"

namespace tetlod {

struct Merged {
  std::int64_t points = 0;  ///< merged away
  bool depends = false;     ///< where parts may not be in contact, or may, it could be others
};

/// Which points become one: merge_points() with the option's tolerance in that box, but no less than what rounding
/// makes of one place, and, where parts may be in contact, keep_touching_parts_apart().
Merged merge_coincident(Span<const Vec3> points, Span<const Tet> tets, Span<const std::uint8_t> used, const Box &box,
                        const Options &options, Job &job, Array<std::int32_t> &representative);

}  // namespace tetlod
