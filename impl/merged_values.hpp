// The values of points that became one.
#pragma once
#include "prepare.hpp"

namespace tetlod {

/// Original::next_merged, of points with others than themselves as their representative.
Array<std::int32_t> chain_merged(Span<const std::int32_t> representative, Job &job);

/// Original::counts.
void find_points_that_count(const Input &input, Job &job, Original &original);

/// Of what became one the first value that the host flags counts, else the middle between the least and the greatest:
/// in original.view.scalars, which are a copy of the caller's array afterwards where any differ. Fills spread and
/// spread_range.
void take_merged_values(const Input &input, Job &job, Original &original);

/// Original::spread_error, of the scales and the spread.
void find_spread_error(Original &original);

}  // namespace tetlod
