// A bound of the error for the original vertices that are just outside of a simplified mesh.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// Those where a field is off by more than `bound`, relative to its range as largest_error(): at the nearest point of
/// the boundary, where what serves them may be an inner vertex just beneath it that nobody sees from there; or in a tet
/// that they are out of by no more than rounding, which may be the one behind a sliver, but is where a reader may find
/// them. probes: projected.
template <std::size_t m>
Array<std::int32_t> beyond_outside(const MeshView &original, double bound, Job &job, const AdaptiveMesh<m> &mesh);

}  // namespace tetlod
