// A tetrahedral mesh and its boundary while edges collapse: what is around each vertex.
#pragma once
#include "few.hpp"
#include "solid_in_order.hpp"
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

/// What collapses need, for one thread at a time.
struct CollapseRoom {
  explicit CollapseRoom(Memory &memory) : tets(memory), triangles(memory), neighbours(memory), list(&memory) {}
  ListRoom tets, triangles, neighbours;
  Array<std::int32_t> list;
};

/// How the solid hangs together.
class SolidComplex {
 public:
  /// Takes all but `origin`.
  SolidComplex(SolidInOrder &&solid, Job &job);

  Array<Vec3> points;
  Array<Rank> ranks;
  Array<Tet> tets;                  ///< positive; the first corner of one that is gone is -1
  Array<Triangle> triangles;        ///< the boundary, outward; likewise
  StarLists tets_of, triangles_of;  ///< some of them may be gone
  StarLists neighbours;             ///< of each vertex
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

  /// The end that goes becomes the one that stays, which comes to be at `point`. Writes to the two ends, their tets
  /// and their neighbours' lists alone.
  void collapse(const SolidEdge &edge, const Vec3 &point, CollapseRoom &room);

  /// Lists side by side again, when those that have grown take much room.
  void tidy(Span<CollapseRoom> rooms);

 private:
  void find_neighbours(Job &job);
  double usual_shape2(Memory &memory) const;
  void merge_tets(const SolidEdge &edge, CollapseRoom &room);
  void merge_triangles(const SolidEdge &edge, CollapseRoom &room);
  void merge_neighbours(const SolidEdge &edge, CollapseRoom &room);
};

}  // namespace tetlod
