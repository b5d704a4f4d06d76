// Connectivity that follows the field: faces and edges exchanged where the probes gain by it.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// One sweep of face removals (2-3) and edge removals (3-2, 4-4, 5-6) over the tets that have an error. A flip is taken
/// when it lowers the sum of squares by more than `price` for every tet that it adds; one that saves a tet may raise it
/// by as much.
template <std::size_t m>
void flip_tets(double price, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
