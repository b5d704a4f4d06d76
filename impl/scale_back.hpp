// The result at the size that the original came with: doubles that are extreme are scaled for the run.
#pragma once
#include "job.hpp"
#include "mesh.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Next to zero, and beyond the largest double, that rounds, and what was a sound mesh may be none then: throws
/// Status::mesh_degenerate.
void scale_back(const Original &original, Job &job, TetMesh &mesh);

}  // namespace tetlod
