// Vertices on the edges of coarser neighbours, as between the levels of a mesh that is refined in places.
#pragma once
#include "extract_boundary.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Two triangles of a closed surface, seen from outside, that lie back to back: a vertex on each edge of the one, and
/// the other at one of these edges. At vertices of very many triangles none are looked for.
struct DividedTriangle {
  std::int32_t coarse, fine;
};
Array<DividedTriangle> find_divided_triangles(const MeshView &mesh, Span<const Triangle> triangles, Job &job);

/// Divides the tets at edges of the boundary on which others of its vertices lie, until there are none, but for where
/// one would turn over. The halves have the number of the whole. The boundary is as extract_boundary() leaves it, and
/// nothing of it is excluded; it is extracted anew.
void divide_at_hanging_vertices(Job &job, Boundary &boundary, Original &original);

}  // namespace tetlod
