// Errors at the original vertices that are just outside of a simplified mesh.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// Of the original vertices that are outside, or on the boundary, as far as rounding goes.
struct OutsideErrors {
  Array<std::int32_t> beyond;  ///< those where a field is off by more than the bound
  double largest = 0;  ///< in tets that they are out of by no more than rounding; largest_error() has the others
};

/// As they count for a bound, relative to the range as largest_error(): at the nearest point of the boundary, where
/// what serves them may be an inner vertex just beneath it that nobody sees from there; and in a tet that they are out
/// of by no more than rounding, which may be the one behind a sliver, but is where a reader may find them. probes:
/// projected.
template <std::size_t m>
OutsideErrors errors_outside(const MeshView &original, double bound, Job &job, const AdaptiveMesh<m> &mesh);

/// The largest at vertices that were in no tet, or are left out of theirs, where changes of the mesh have made that a
/// matter of rounding.
template <std::size_t m>
double largest_outside(const MeshView &original, Job &job, const AdaptiveMesh<m> &mesh);

}  // namespace tetlod
