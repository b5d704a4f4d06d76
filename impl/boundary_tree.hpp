// Where the boundary of a mesh that changes is nearest to a point.
#pragma once
#include "solids.hpp"
#include "surface_distance.hpp"
#include "tet_complex.hpp"

namespace tetlod {

/// Of the mesh as it is.
struct BoundaryTree {
  BoundaryTree(const TetComplex &mesh, Job &job)
      : faces(&job.memory), tet_of_face(&job.memory), tree(mesh.points, faces_of(mesh), job) {}

  /// The nearest point to p, of what became of the solid of an original vertex, as far as that is known.
  NearestPoint nearest(const Vec3 &p, std::int32_t vertex, const SolidsOfTets &solids) const {
    if (!solids.are_several()) return tree.nearest(p);
    return tree.nearest_among(
        p, [&](std::int32_t face) { return solids.may_hold(tet_of_face[std::size_t(face)], vertex); });
  }

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
