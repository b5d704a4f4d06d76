// Where tets that are turned over reach the boundary, as of a mesh that has been bent too far, or of polyhedra that
// were split: their vertices are moved until they are not.
#pragma once
#include "prepare.hpp"

namespace tetlod {

/// Moves vertices of tets that are turned over, and of those beside them, each time as little as makes one of them
/// upright; nearly all of it inside, and none that the host has flagged. Where the boundary's triangles agree which
/// side is out nothing is moved; nor where that comes to no end, or goes farther than 0.02 of the diagonal. boundary:
/// as extract_boundary() leaves it, with nothing excluded.
void untangle(Job &job, Boundary &boundary, Original &original);

}  // namespace tetlod
