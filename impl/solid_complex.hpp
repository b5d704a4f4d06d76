// A tetrahedral mesh and its boundary while edges collapse: what is around each vertex.
#pragma once
#include "extract_boundary.hpp"
#include "few.hpp"
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

/// An edge with the tets around it, those at the edge apart.
struct SolidEdge {
  std::int32_t stays, gone;
  Few<std::int32_t, 2 * largest_cavity> stays_tets, gone_tets;
  Cavity edge_tets;
};

/// How the solid hangs together.
class SolidComplex {
 public:
  SolidComplex(const MeshView &original, const Boundary &boundary, Job &job);

  Array<Vec3> points;
  Array<Rank> ranks;
  Array<Tet> tets;                  ///< positive; the first corner of one that is gone is -1
  Array<Triangle> triangles;        ///< the boundary, outward; likewise
  StarLists tets_of, triangles_of;  ///< some of them may be gone
  StarLists neighbours;             ///< of each vertex
  std::int64_t count;               ///< of the tets that are there
  double least_shape2;              ///< square of the shape of a tet, below which it is flat

  const Vec3 &point(std::int32_t v) const { return points[std::size_t(v)]; }
  Rank rank(std::int32_t v) const { return ranks[std::size_t(v)]; }
  bool on_boundary(std::int32_t v) const { return rank(v) >= Rank::boundary; }
  bool has_vertex(std::int32_t v) const { return !tets_of.of(v).empty(); }
  bool has_tet(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  bool has_triangle(std::int32_t t) const { return triangles[std::size_t(t)][0] >= 0; }
  /// Twice the area vector.
  Vec3 normal(std::int32_t triangle) const;
  double volume() const;  ///< before any collapse

  /// From here on touched() says of edges whether something has become of a tet around them.
  void begin_batch() { batch_++; }
  bool touched(const SolidEdge &edge) const;

  /// The end that goes becomes the one that stays, which comes to be at `point`.
  void collapse(const SolidEdge &edge, const Vec3 &point);

 private:
  void find_neighbours(Job &job);
  double usual_shape2(Memory &memory) const;
  template <class Simplices>
  void merge_stars(const SolidEdge &edge, Simplices &simplices, StarLists &stars);
  void merge_neighbours(const SolidEdge &edge);

  Array<std::uint32_t> touched_;  // the batch in which each tet changed last
  std::uint32_t batch_ = 0;
  Array<std::int32_t> list_;
};

}  // namespace tetlod
