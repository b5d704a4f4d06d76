// A tetrahedral mesh and its boundary while edges collapse: what is around each vertex.
#pragma once
#include "few.hpp"
#include "neighbours.hpp"
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

/// Those that are not gone alone, with the new numbers of their vertices.
template <class Simplex>
void keep_left(Array<Simplex> &simplices, Span<const std::int32_t> number, Job &job) {
  keep_where(simplices, job, [&](std::size_t i) { return simplices[i][0] >= 0; });
  for_each(simplices.size(), job, [&](std::size_t i) {
    for (std::int32_t &v : simplices[i]) v = number[std::size_t(v)];
  });
}

/// The new number of each vertex, from 0 on in the order of `left`; -1: it is not left.
inline Array<std::int32_t> numbers_of(Span<const std::int32_t> left, std::size_t vertices, Job &job) {
  Array<std::int32_t> numbers = array_of(vertices, -1, job);
  for_each(left.size(), job, [&](std::size_t i) { numbers[std::size_t(left[i])] = std::int32_t(i); });
  return numbers;
}

/// An edge with the tets around it, those at the edge apart.
struct SolidEdge {
  std::int32_t stays, gone;
  Few<std::int32_t, 2 * largest_cavity> stays_tets;  ///< not looked for where a vertex is removed
  Few<std::int32_t, 2 * largest_cavity> gone_tets;
  Cavity edge_tets;
  Cavity cavity;  ///< where tets beyond give way, too: all that do
  Filling fresh;  ///< what comes in their place; else empty

  void begin(std::int32_t one_end, std::int32_t other_end) {
    stays = one_end;
    gone = other_end;
    stays_tets.clear();
    gone_tets.clear();
    edge_tets.clear();
    fresh.clear();
  }
  bool is_widened() const { return !fresh.empty(); }
  std::size_t tets_around() const { return stays_tets.size() + gone_tets.size() + edge_tets.size(); }
  std::size_t tets_saved() const { return is_widened() ? cavity.size() - fresh.size() : edge_tets.size(); }
};

/// What collapses need, for one thread at a time.
struct CollapseRoom {
  explicit CollapseRoom(Memory &memory) : tets(memory), triangles(memory), list(&memory), around(memory) {}
  ListRoom tets, triangles;
  Array<std::int32_t> list;
  Neighbours around;  ///< of a cavity; what is there twice does no harm

  /// The list, with that room.
  std::int32_t *of_size(std::size_t entries) {
    if (list.size() < entries) list.resize(entries);
    return list.data();
  }
  void clear() {
    for (ListRoom *room : {&tets, &triangles}) room->clear();
  }
};

/// Of the original.
struct SolidMeasures {
  double least_shape2 = 0;  ///< square of the shape of a tet, below which it is flat
  double volume = 0;
  std::size_t vertices = 0, tets = 0;
  double weight_of_planes = 0;  ///< in the quadrics
};

/// How the solid hangs together.
class SolidComplex {
 public:
  /// Takes all but `origin`.
  SolidComplex(SolidInOrder &&solid, Job &job);
  /// The lists are made from what is given.
  SolidComplex(Array<Vec3> &&points, Array<Rank> &&ranks, Array<Tet> &&tets, Array<Triangle> &&triangles,
               const SolidMeasures &measures, Job &job);

  Array<Vec3> points;
  Array<Rank> ranks;
  Array<Tet> tets;                  ///< positive; the first corner of one that is gone is -1
  Array<Triangle> triangles;        ///< the boundary, outward; likewise
  StarLists tets_of, triangles_of;  ///< some of them may be gone
  SolidMeasures measures;

  const Vec3 &point(std::int32_t v) const { return points[std::size_t(v)]; }
  Rank rank(std::int32_t v) const { return ranks[std::size_t(v)]; }
  bool on_boundary(std::int32_t v) const { return rank(v) >= Rank::boundary; }
  bool may_go(std::int32_t v) const { return rank(v) == Rank::inner || rank(v) == Rank::boundary; }
  struct Ends {
    std::int32_t stays, gone;
  };
  Ends ends_of(std::int32_t v, std::int32_t u) const { return rank(v) < rank(u) ? Ends{u, v} : Ends{v, u}; }
  bool keeps_place(std::int32_t stays, std::int32_t gone) const { return rank(stays) != rank(gone); }
  bool has_vertex(std::int32_t v) const { return !tets_of.of(v).empty(); }
  bool has_tet(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  bool has_triangle(std::int32_t t) const { return triangles[std::size_t(t)][0] >= 0; }
  bool has_edge(std::int32_t v, std::int32_t u) const {
    const Span<const std::int32_t> star = tets_of.of(v);
    return std::any_of(star.begin(), star.end(),
                       [&](std::int32_t t) { return has_tet(t) && has(tets[std::size_t(t)], u); });
  }
  void find_neighbours(std::int32_t v, Neighbours &neighbours) const { neighbours.find(v, tets_of.of(v), tets); }
  static constexpr std::size_t ahead = 4;  ///< vertices, in what follows
  /// What a look around the next ones of these vertices takes comes nearer: first lists, then the tets in them, then
  /// where two corners of each are, which are most of the neighbours.
  void prefetch_after(std::size_t i, Span<const std::int32_t> vertices) const {
    if (i + 3 * ahead < vertices.size()) tets_of.prefetch(vertices[i + 3 * ahead]);
    if (i + 2 * ahead < vertices.size())
      for (std::int32_t t : tets_of.of(vertices[i + 2 * ahead])) __builtin_prefetch(&tets[std::size_t(t)]);
    if (i + ahead < vertices.size())
      for (std::int32_t t : tets_of.of(vertices[i + ahead])) {
        __builtin_prefetch(&point(tets[std::size_t(t)][1]));
        __builtin_prefetch(&point(tets[std::size_t(t)][2]));
      }
  }
  /// Twice the area vector.
  Vec3 normal(std::int32_t triangle) const;

  /// The end that goes becomes the one that stays, which comes to be at `point`. Writes to the two ends, their tets, or
  /// those of the cavity, and the lists of the vertices of these alone.
  void collapse(const SolidEdge &edge, const Vec3 &point, CollapseRoom &room);

  /// Lists side by side again, when those that have grown take much room.
  void tidy(Span<CollapseRoom> rooms, Job &job);

  /// About, with what they grow by between two tidyings; those of triangles are few.
  static std::size_t bytes_of_lists(std::size_t vertices, std::size_t tets) {
    return StarLists::bytes(vertices, 4 * tets / much * (much + 1)) + StarLists::bytes(vertices, 0);
  }

 private:
  static constexpr std::size_t much = 8;  ///< times what has grown is all
  double volume(Job &job) const;
  std::int32_t *list_left(Span<const std::int32_t> star, std::int32_t *place) const;
  void merge_tets(const SolidEdge &edge, CollapseRoom &room);
  void fill_cavity(const SolidEdge &edge, CollapseRoom &room);
  void merge_triangles(const SolidEdge &edge, CollapseRoom &room);
};

}  // namespace tetlod
