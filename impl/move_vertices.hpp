// Inner vertices move, with their values, to where the probes around them gain.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// One Gauss-Newton step on (x, y, z, values) for each inner vertex from number `first` on, shortened where a tet would
/// turn over or nothing is gained. Returns how many moved.
template <std::size_t m>
std::int64_t move_vertices(std::size_t first, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
