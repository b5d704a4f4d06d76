// Inner vertices that the field does not need give their tets back.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// One sweep of collapses of inner vertices into a neighbour. A collapse is made when it raises the sum of squares by
/// less than `price` for every tet that it saves.
template <std::size_t m>
void remove_vertices(double price, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
