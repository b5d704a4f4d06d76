// Fields of the original onto another mesh.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "stencil.hpp"
#include "strided.hpp"

namespace tetlod {

/// to[i] = the mean of from[ids[i]] with weights[i], component by component, never beyond the values that it is a mean
/// of; a value of weight 0 has no part in it, so NaN and infinity spread no further than they must. Integers are mostly
/// names, of which a mean means nothing: to[i] = that one of them with the largest weight. Both arrays have as many
/// components, and reals are float32 or float64 in both; `to` has integers of the type of `from`, or int64. `from` has
/// a tuple for every vertex, `to` for every point.
void transfer(const Stencil &stencil, const StridedArray &from, const StridedArray &to, Job &job);

/// to[i] = from[ids[i]], likewise.
void transfer(Span<const std::int32_t> ids, const StridedArray &from, const StridedArray &to, Job &job);

}  // namespace tetlod
