// Vertices on the edges of coarser neighbours, as between the levels of a mesh that is refined in places.
#pragma once
#include "triangle_corners.hpp"

namespace tetlod {

/// It lies on the edge, but for rounding, and has one of its own to the end `from`. On one side of the two edges at
/// least, triangles lie back to back.
struct HangingVertex {
  std::int32_t vertex, from, to;
};

/// corners: of the triangles of a closed surface, seen from outside. At vertices of very many triangles none are looked
/// for.
Array<HangingVertex> find_hanging_vertices(const MeshView &mesh, const TriangleCorners &corners, Job &job);
bool any_hanging_vertices(const MeshView &mesh, const TriangleCorners &corners, Job &job);

}  // namespace tetlod
