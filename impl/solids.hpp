// Which solid of an assembly: of a vertex of the original, and of a tet of what becomes of it. Solids in contact, or
// that have moved into each other, share places; a place of the one's is to be looked for in what became of that one.
#pragma once
#include "tet_complex.hpp"

namespace tetlod {

/// Of each vertex; -1 where several touch. Tets hang together by faces.
Array<std::int32_t> solids_of_vertices(const MeshView &mesh, Job &job);

/// Where none are in contact, nothing is known of them and any may hold anything.
class SolidsOfTets {
 public:
  /// of_vertices: MeshView::solid of the original. Tets hang together by faces, and are of their vertices' solid.
  SolidsOfTets(const TetComplex &mesh, Span<const std::int32_t> of_vertices, Job &job);

  bool are_several() const { return !of_vertices_.empty(); }
  /// Whether it became of the solid of the original's vertex, or one of the two is not known.
  bool may_hold(std::int32_t t, std::int32_t vertex) const {
    return !are_several() || may_be_one(of(t), of_vertices_[std::size_t(vertex)]);
  }
  /// -1: not known.
  std::int32_t of(std::int32_t t) const { return solid_[std::size_t(t)]; }

 private:
  Span<const std::int32_t> of_vertices_;
  Array<std::int32_t> solid_;  // of each tet
};

}  // namespace tetlod
