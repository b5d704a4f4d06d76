// Where the boundary of a mesh that changes is nearest to a point.
#pragma once
#include "surface_distance.hpp"
#include "tet_complex.hpp"

namespace tetlod {

/// Of the mesh as it is.
struct BoundaryTree {
  BoundaryTree(const TetComplex &mesh, Job &job)
      : faces(&job.memory), tet_of_face(&job.memory), tree(mesh.points, faces_of(mesh), job) {}

  Array<Triangle> faces;
  Array<std::int32_t> tet_of_face;
  TriangleTree tree;

 private:
  Span<const Triangle> faces_of(const TetComplex &mesh) {
    mesh.find_boundary(faces, tet_of_face);
    return faces;
  }
};

}  // namespace tetlod
