// Vertices anywhere on the triangles of coarser neighbours, as where two cells are more than one level of refinement
// apart.
#pragma once
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// It lies on an edge of the triangle, the one opposite that corner, or, -1, inside of it, but for rounding.
struct VertexOnTriangle {
  std::int32_t vertex, triangle, opposite;
};

/// Of a closed surface, seen from outside: of each triangle, if ones that lie back to back on it have a corner of it,
/// the middlemost other vertex of these on one of its edges, or, if there is none, inside of it. Parts with points of
/// their own have no corner in common. Where very many boxes meet that of one, not all are looked at.
Array<VertexOnTriangle> find_vertices_on_triangles(Span<const Vec3> points, Span<const Triangle> triangles, Job &job);

}  // namespace tetlod
