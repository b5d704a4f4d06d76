// Tets of no volume between two sides of a slit that have the same vertices, but other triangles.
#pragma once
#include "numbered_tets.hpp"

namespace tetlod {

/// Adds a tet to each crossed quad of the boundary, and others on it, until the two sides have the same triangles. They
/// wind as they fit; the boundary is of before. False: nothing would be left of it.
bool add_flat_layers(Job &job, NumberedTets &tets);

}  // namespace tetlod
