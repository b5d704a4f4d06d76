// The result at the size that the original came with: doubles that are extreme are scaled for the run.
#pragma once
#include "job.hpp"
#include "mesh.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Next to zero, and beyond the largest double, that rounds. By more than doubles of the mesh's size are rounded, or so
/// that a tet has no volume: throws Status::mesh_degenerate.
void scale_back(const Original &original, Job &job, TetMesh &mesh);

}  // namespace tetlod
