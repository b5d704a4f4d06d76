// Inner vertices move, with their values, to where the probes around them gain.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// One Gauss-Newton step on (x, y, z, values) for each inner vertex from number `first` on, shortened where a tet would
/// turn over or nothing is gained.
template <std::size_t m>
void move_vertices(std::size_t first, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
