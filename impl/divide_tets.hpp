// Tets are divided at vertices of their neighbours' that lie on their edges and faces.
#pragma once
#include "numbered_tets.hpp"

namespace tetlod {

/// At edges of the boundary that have a hanging vertex, once each, unless one would turn over. The boundary is of
/// before. False: there is nothing to divide.
bool divide_at_hanging_vertices(Job &job, NumberedTets &tets);

/// The same at vertices anywhere on edges of triangles of the boundary, or, if that is asked for, and no edge is
/// divided, inside of triangles.
bool divide_at_vertices_on_triangles(Job &job, NumberedTets &tets, bool inside_too);

}  // namespace tetlod
