// Coincident points become one.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// representative[v]: the lowest numbered point that v is merged into, v itself when it stays; points with used[v] == 0
/// stay out of it. Tolerance 0: equal coordinates. Otherwise points in the order of their numbers join the first one
/// that stays within the tolerance. Returns how many were merged away.
std::int64_t merge_points(Span<const Vec3> points, Span<const std::uint8_t> used, double tolerance, Job &job,
                          Array<std::int32_t> &representative);

/// The same, sooner, within what is next to nothing beside the ways between points. -1: it is not, and nothing is
/// known.
std::int64_t merge_rounded(Span<const Vec3> points, Span<const std::uint8_t> used, double rounding, Job &job,
                           Array<std::int32_t> &representative);

}  // namespace tetlod
