// Tets that are turned over, as of a mesh that has been bent too far, or of polyhedra that were split: their vertices
// are moved until they are not.
#pragma once
#include "prepare.hpp"

namespace tetlod {

/// Vertices of tets that are turned over, and of those beside them, each time as little as makes one of these upright;
/// none that the host has flagged, and those of the boundary at first by a tenth of others, or not where its triangles
/// agree which side is out. None where that comes to no end, or goes farther than 0.02 of the diagonal. boundary: as
/// extract_boundary() leaves it, with nothing excluded.
Moves find_moves(const Original &original, const Boundary &boundary, Job &job);

/// Unless triangles of the boundary do not agree then.
void make_moves(const Moves &moves, Job &job, Boundary &boundary, Original &original);

/// Throws Status::mesh_intersecting where the boundary has been moved as far as max-deviation, if that is set.
void refuse_moves(const Original &original, const Options &options);

}  // namespace tetlod
