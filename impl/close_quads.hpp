// Crossed quads are closed, so that the tets on their two sides are neighbours.
#pragma once
#include "numbered_tets.hpp"

namespace tetlod {

/// A tet is put into each crossed quad of the boundary. As it has next to no volume, it gives way, with the tets around
/// one of its edges, to others around the same edge's ring, where these are sound: on one side of the quad they have
/// the diagonal of the other then. So are pairs of triangles turned that no two triangles of the other side meet, until
/// both sides have the same. The boundary is none any more. is_divided: tets were, and may leave such pairs alone.
void close_crossed_quads(bool is_divided, Job &job, NumberedTets &tets);

}  // namespace tetlod
