// A bound that holds: nowhere, at the original's vertices, is a field off by more.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

struct LargestError {
  double value = 0;
  std::int64_t probe = -1;
};

/// At the probes of original vertices that lie in a tet, of any field: as if all ranges were the first's.
template <std::size_t m>
LargestError largest_error(const AdaptiveMesh<m> &mesh, Job &job);

/// Where a field is off by more than `bound`, relative to its range as largest_error(), the worst of each tet first,
/// values of the mesh give way; where they cannot, original vertices, with their values, become vertices of the mesh,
/// until there is none; those on the boundary divide its faces. Returns those, of the original's, with which that could
/// not be done: two are at one point of the boundary, or a tet would be too flat.
template <std::size_t m>
Array<std::int32_t> hold_bound(double bound, Job &job, AdaptiveMesh<m> &mesh);

/// Inserts original vertices where the error is the largest of all, until the mesh has about so many tets.
template <std::size_t m>
void lower_largest(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
