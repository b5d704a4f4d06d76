// Past the paper: where collapses left the boundary farthest from the original's, it goes back there.
#pragma once
#include "job.hpp"
#include "mesh.hpp"
#include "surface_distance.hpp"

namespace tetlod {

/// Vertices of the mesh's boundary move, and its edges and triangles are divided, to lower the distances between the
/// boundaries, the largest first, down to `least`, as long as there are no more than `most` tets. Tets stay positive;
/// the boundary may come to cross itself: to be looked at. origin: the original vertex that each point of the mesh
/// still is, or -1. to_original: the original's tree. stays: of original vertices, those that neither move nor get
/// other triangles among themselves; empty: none. Returns the largest distance from a vertex of either boundary to the
/// other.
double lower_deviation(const Surface &original, const TriangleTree &to_original, Span<const std::uint8_t> stays,
                       double least, std::int64_t most, Job &job, TetMesh &mesh, Array<std::int32_t> &origin);

}  // namespace tetlod
