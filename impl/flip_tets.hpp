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

/// Removes faces (2-3), one by one, where that leaves the smallest sum of squares, until there are so many tets, or no
/// face is left that leaves sound shapes. Looks at all of them each time.
template <std::size_t m>
void remove_faces(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
