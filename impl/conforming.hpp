// Tets whose faces lie on one another, but are not the same, become neighbours: where a mesh is refined in places, and
// where hexahedra were split one by one.
#pragma once
#include "numbered_tets.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Divides tets at hanging vertices, and then, if there are such, at others on their edges and faces; then closes
/// crossed quads, so that the faces in between are none of the boundary. Halves, and what takes the place of others,
/// have their numbers. All stays as it is where no solid comes of it, and where one would touch itself that does not.
/// boundary: as extract_boundary() leaves it, with nothing excluded.
void make_conforming(Job &job, Boundary &boundary, Original &original);

/// The same of tets that have no boundary yet, but not at vertices inside of faces, which parts that were divided
/// independently have. True: they did not conform, and do now, with no slit left.
bool can_conform(Job &job, NumberedTets &tets);

/// Closes what gaps they have. False: that comes to no end.
bool close_gaps_of(Job &job, NumberedTets &tets);

}  // namespace tetlod
