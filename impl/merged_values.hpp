// The values of points that became one: the middle between the least and the greatest of them counts.
#pragma once
#include "mesh.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Points with others than themselves as their representative, each with that, in its order.
Array<MergedPoint> find_merged(Span<const std::int32_t> representative, Job &job);

/// Of original.merged, in original.view.scalars, which is a copy of the caller's array afterwards where any differ.
/// original.spread: of each field, how far the values of a place are from its middle, at most.
void take_middles(Job &job, Original &original);

}  // namespace tetlod
