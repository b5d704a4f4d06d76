// The boundary of a mesh, and how far a result's is from the original's.
#pragma once

#include <vector>

#include "bench_mesh.hpp"

namespace bench {

struct Shape {
  std::vector<Triangle> boundary;  // faces used once
  double volume;                   // of the tets, absolute
  std::int64_t not_positive;       // tets that are inside out or flat
  std::int64_t over_shared;        // faces of more than two tets
  std::int64_t nonmanifold_edges;  // of the boundary, not used by two of its triangles
};

Shape shape_of(const Mesh &mesh);

// Every tet positive, no face in more than two, and no more non-manifold edges on the boundary than the original has.
bool is_valid(const Shape &original, const Shape &result);

// The largest distance of a vertex or centroid of either boundary to the other, over the original's diagonal.
double hausdorff(const Mesh &original, const Shape &original_shape, const Mesh &result, const Shape &result_shape);

}  // namespace bench
