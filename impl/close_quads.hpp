// Crossed quads are closed, so that the tets on their two sides are neighbours.
#pragma once
#include "extract_boundary.hpp"
#include "prepare.hpp"

namespace tetlod {

/// A tet is put into each crossed quad of the boundary. As it has next to no volume, it gives way, with the tets around
/// one of its edges, to others around the same edge's ring, where these are sound: on one side of the quad they have
/// the diagonal of the other then. They have the numbers of those that they replace. The boundary is as
/// extract_boundary() leaves it, and nothing of it is excluded; it is extracted anew.
void close_crossed_quads(Job &job, Boundary &boundary, Original &original);

}  // namespace tetlod
