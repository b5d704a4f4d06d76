// Quadrilaterals that the tets on their two sides cut along different diagonals, as hexahedra that are split one by
// one.
#pragma once
#include <array>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Four triangles that lie on one another: the faces of a tet with next to no volume, a tenth of the cube of its
/// longest side at most, and of none that the mesh has.
struct CrossedQuad {
  Tet corners;                           ///< ascending
  std::array<std::size_t, 4> triangles;  ///< k: the one without corner k
};

/// Among triangles that one tet each has, tet_of, in the order of their lowest vertex, the middle one, the highest.
/// Each triangle is of one quad at most.
Array<CrossedQuad> find_crossed_quads(const MeshView &mesh, Span<const Triangle> triangles,
                                      Span<const std::int32_t> tet_of, Job &job);

}  // namespace tetlod
