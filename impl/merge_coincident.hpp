// Points at one place become one, but of parts that only touch, and on the two sides of a crack.
#pragma once
#include "cracks.hpp"
#include "touching_parts.hpp"

namespace tetlod {

struct Merged {
  explicit Merged(Memory &memory) : asked(&memory), torn(&memory), cracks(memory) {}
  std::int64_t points = 0;  ///< merged away
  bool depends = false;     ///< where parts may not be in contact, or may, or be moved farther, it could be others
  Jumps asked;              ///< on which it depends, too
  Torn torn;
  Cracks cracks;
};

/// Which points become one: merge_points() with the option's tolerance in that box, but with no less than what rounding
/// makes of one place, unless the mesh is as thin as that; and, where parts may be in contact,
/// keep_touching_parts_apart() and keep_cracks_open(). opened: by moves that were made before.
Merged merge_coincident(const Input &input, Span<const Vec3> points, Span<const Tet> tets,
                        Span<const std::uint8_t> used, const Box &box, const Options &options, Job &job,
                        Array<std::int32_t> &representative, const Moves *opened = nullptr);

}  // namespace tetlod
