// Past the paper: where a coarse mesh's boundary lies, on the average, inside of the original's vertices, it goes
// outward.
#pragma once
#include "boundary_moves.hpp"
#include "job.hpp"

namespace tetlod {

/// Vertices of the mesh's boundary that serve the original vertices about them better farther outward, by least squares
/// of the distances, go there: fewer of these are outside then. None goes farther from the original than the farthest
/// of these is from the mesh, nor as far as a field that bends there would lose by it. Tets stay positive. Arguments as
/// those of lower_deviation.
void move_outward(const BoundaryMoves &by, Job &job, TetMesh &mesh, Array<std::int32_t> &origin);

}  // namespace tetlod
