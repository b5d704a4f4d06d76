// Crossed quads are closed, so that the tets on their two sides are neighbours.
#pragma once
#include "numbered_tets.hpp"

namespace tetlod {

/// A tet is put into each crossed quad of the boundary, and others on it, until the two sides have the same triangles.
/// As these have next to no volume, they give way, with the tets around one of their edges, to others around the same
/// edge's ring, where these are sound: on one side of the quad they have the diagonal of the other then. The boundary
/// is of before. False: nothing would be left of it.
bool close_crossed_quads(Job &job, NumberedTets &tets);

}  // namespace tetlod
