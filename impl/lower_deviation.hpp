// Past the paper: where collapses left the boundary farthest from the original's, it goes back there.
#pragma once
#include "boundary_moves.hpp"
#include "job.hpp"

namespace tetlod {

/// Vertices of the mesh's boundary move, and its edges and triangles are divided, to lower the distances between the
/// boundaries, the largest first, down to `least`, as long as there are no more than `most` tets. Tets stay positive.
/// origin: what each point of the mesh was, see came_from.hpp. Vertices that stay get no other triangles
/// among themselves, either. Returns the largest distance from a vertex of either boundary to the other.
double lower_deviation(const BoundaryMoves &by, double least, std::int64_t most, Job &job, TetMesh &mesh,
                       Array<std::int32_t> &origin);

}  // namespace tetlod
