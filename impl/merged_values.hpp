// The values and the place of points that became one.
#pragma once
#include "prepare.hpp"

namespace tetlod {

/// Original::next_merged, of points with others than themselves as their representative.
Array<std::int32_t> chain_merged(Span<const std::int32_t> representative, Job &job);

/// Those that Original::moves is to have, by the flags as submitted, and where these move their vertices.
Array<FlaggedPoint> find_flagged(const Input &input, Job &job, const Original &original);
Moves moves_to_flagged(Span<const FlaggedPoint> flagged, Span<const Vec3> points, Memory &memory);

/// Original::counts.
void find_points_that_count(const Input &input, Job &job, Original &original);

/// Of what became one the first value that the host flags counts, else the middle between the least and the greatest:
/// in original.view.scalars, which are a copy of the caller's array afterwards where any differ. Fills spread and
/// spread_range.
void take_merged_values(Job &job, Original &original);

/// Original::spread_error, of the scales and the spread.
void find_spread_error(Original &original);

}  // namespace tetlod
