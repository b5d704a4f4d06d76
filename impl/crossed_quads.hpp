// Quadrilaterals that the tets on their two sides cut along different diagonals, as hexahedra that are split one by
// one.
#pragma once
#include <array>

#include "mesh.hpp"
#include "triangle_corners.hpp"

namespace tetlod {

/// Two triangles of a closed surface with a diagonal in between, and triangles that lie back to back on them and have
/// the other diagonal.
struct CrossedQuad {
  std::array<std::int32_t, 2> one;
  std::array<std::int32_t, 2> other;  ///< the two that fill the quad, or one of the others at that diagonal, and -1
  Tet tet;                            ///< that fits on the first two, as they are seen from outside; with no volume
  bool is_closed() const { return other[1] >= 0; }  ///< by that tet
};

/// corners: of triangles that one tet each has, tet_of, seen from outside. The quad's tet is none of the mesh, and has
/// a hundredth of the volume of the largest tet at the triangles at most; that of four triangles may have half, but
/// where it may be a cavity: with no vertex of a quad that is none, or was found before, and not on four sides others
/// that may be one. Each triangle is of one quad at most. At vertices of very many triangles none are looked for.
/// at_gap: of each vertex, whether such a quad has it; so far, and after.
Array<CrossedQuad> find_crossed_quads(const MeshView &mesh, const TriangleCorners &corners,
                                      Span<const std::int32_t> tet_of, Array<std::uint8_t> &at_gap, Job &job);
bool any_crossed_quads(const MeshView &mesh, const TriangleCorners &corners, Span<const std::int32_t> tet_of, Job &job);

/// Pairs of triangles with an edge in common, each of which has one that lies back to back on another at one of its
/// corners, where the other diagonal of their quad is a Delaunay edge, and theirs is none: `other` is -1, -1. When all
/// of both sides are, the sides are the same, but for squares.
Array<CrossedQuad> find_slanted_quads(const MeshView &mesh, const TriangleCorners &corners,
                                      Span<const std::int32_t> tet_of, Job &job);

}  // namespace tetlod
