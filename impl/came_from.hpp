// What a point of a mesh whose edges have collapsed was: the original vertex v, which it still is, or, as ~v, one that
// it has come from, of the same solid.
#pragma once
#include <cstdint>

namespace tetlod {

inline std::int32_t came_from(std::int32_t origin) { return origin < 0 ? ~origin : origin; }

/// It is there no more.
inline std::int32_t moved_away(std::int32_t origin) { return ~came_from(origin); }

}  // namespace tetlod
