// A tetrahedral mesh and its boundary while edges collapse: the quadric of each vertex, and what is around it.
#pragma once
#include "extract_boundary.hpp"
#include "few.hpp"
#include "local_quadric.hpp"
#include "star_lists.hpp"

namespace tetlod {

/// What may become of a vertex. Of two different ones the higher stays where it is.
enum class Rank : std::uint8_t {
  inner,
  kept_inner,  ///< keeps place and value
  boundary,
  kept_boundary,
  touching  ///< on the boundary, where the solid touches itself: none of its edges collapses
};

struct SolidVertex {
  Vec4 place{};  ///< x, y, z, and the value as a length
  LocalQuadric quadric;
  Vec3 point() const { return {place[0], place[1], place[2]}; }
};

/// An edge with the tets around it, those at the edge apart.
struct SolidEdge {
  std::int32_t stays, gone;
  Few<std::int32_t, 2 * largest_cavity> stays_tets, gone_tets;
  Cavity edge_tets;
};

class SolidMesh {
 public:
  /// scale: the length that a unit of the scalar counts as.
  SolidMesh(const MeshView &original, const Boundary &boundary, double scale, Job &job);

  Array<SolidVertex> vertices;
  Array<Rank> ranks;
  Array<Tet> tets;                  ///< positive; the first corner of one that is gone is -1
  Array<Triangle> triangles;        ///< the boundary, outward; likewise
  StarLists tets_of, triangles_of;  ///< some of them may be gone
  StarLists neighbours;             ///< of each vertex
  std::int64_t count;               ///< of the tets that are there

  const SolidVertex &vertex(std::int32_t v) const { return vertices[std::size_t(v)]; }
  Vec3 point(std::int32_t v) const { return vertex(v).point(); }
  Rank rank(std::int32_t v) const { return ranks[std::size_t(v)]; }
  bool on_boundary(std::int32_t v) const { return rank(v) >= Rank::boundary; }
  bool has_vertex(std::int32_t v) const { return !tets_of.of(v).empty(); }
  bool has_tet(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  bool has_triangle(std::int32_t t) const { return triangles[std::size_t(t)][0] >= 0; }
  /// Twice the area vector.
  Vec3 normal(std::int32_t triangle) const;
  double volume() const;

  /// From here on touched() says of edges whether something has become of a tet around them.
  void begin_batch() { batch_++; }
  bool touched(const SolidEdge &edge) const;

  /// The end that goes becomes the one that stays, which comes to be at `place`, with the quadrics of both.
  void collapse(const SolidEdge &edge, const Vec4 &place);

 private:
  void find_neighbours(Job &job);
  double weight_of_planes() const;
  void find_quadrics(Job &job);
  Vec3 gradient(const Tet &t) const;
  LocalQuadric quadric_of(std::int32_t v, Span<const Vec3> gradients, double weight_of_planes) const;
  template <class Simplices>
  void merge_stars(const SolidEdge &edge, Simplices &simplices, StarLists &stars);
  void merge_neighbours(const SolidEdge &edge);

  Array<std::uint32_t> touched_;  // the batch in which each tet changed last
  std::uint32_t batch_ = 0;
  Array<std::int32_t> list_;
};

}  // namespace tetlod
