// Tets whose connectivity is replaced piece by piece.
#pragma once
#include <cstdint>
#include <functional>

#include "few.hpp"
#include "job.hpp"
#include "members.hpp"
#include "mesh.hpp"
#include "tet_frame.hpp"

namespace tetlod {

/// What TetComplex::fixed says of a vertex beside 0 and 1: on the boundary, where the solid touches itself.
constexpr std::uint8_t touching = 2;

/// What TetComplex::kept says of a vertex that keeps its values for the bound's sake alone.
constexpr std::uint8_t held = 4;

class TetComplex {
 public:
  explicit TetComplex(Memory &memory)
      : points(&memory),
        fixed(&memory),
        kept(&memory),
        tets(&memory),
        neighbours(&memory),
        tet_of(&memory),
        solid(&memory),
        memory_(memory),
        touched_(&memory),
        free_(&memory),
        outer_(&memory) {}

  Array<Vec3> points;
  Array<std::uint8_t> fixed;                    ///< vertices of the boundary: 1, or `touching`
  Array<std::uint8_t> kept;                     ///< vertices that keep place and values: the host's flags, or `held`
  Array<Tet> tets;                              ///< every one positive; the first corner of a free slot is -1
  Array<Tet> neighbours;                        ///< across the face opposite each corner; -1 on the boundary
  std::function<bool(const Vec3 &)> may_bound;  ///< whether a boundary that is divided may be there; empty: anywhere
  Array<std::int32_t> tet_of;                   ///< one of the tets of each vertex
  Array<std::int32_t> solid;                    ///< of the original's, of the first vertices; -1: not known

  /// Of `tets`, which has no free slot, with a tet of each vertex.
  void find_neighbours(Job &job);
  /// These, and which vertices are fixed.
  void connect(Job &job);

  /// The faces of the boundary, the vertices of each ascending, and the tet that each has.
  void find_boundary(Array<Triangle> &faces, Array<std::int32_t> &tet_of_face) const;

  std::size_t count() const { return tets.size() - free_.size(); }
  bool alive(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  Memory &memory() const { return memory_; }

  const Vec3 &corner(std::int32_t t, int k) const { return points[std::size_t(tets[std::size_t(t)][std::size_t(k)])]; }
  TetFrame frame(const Tet &t) const {
    return {points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])], points[std::size_t(t[3])]};
  }
  TetFrame frame(std::int32_t t) const { return {corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)}; }
  bool is_sound(const Tet &t, double limit) const {
    return tetlod::is_sound(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])],
                            points[std::size_t(t[3])], limit);
  }

  /// From here on touched() says of tets whether something has become of one of them.
  void begin_batch() { batch_++; }
  void touch(std::int32_t t) { touched_[std::size_t(t)] = batch_; }
  bool touched(Span<const std::int32_t> some) const {
    return std::any_of(some.begin(), some.end(), [&](std::int32_t t) { return touched_[std::size_t(t)] == batch_; });
  }

  /// The tets around an inner edge (a, b) of tet t and the ring of vertices, ring[i] and ring[i + 1] in tet i, so that
  /// (a, b, ring[i], ring[i + 1]) is positive. False on the boundary, where there are more than the lists hold, and
  /// where visit(tet) is false of one.
  template <std::size_t most, class Visit>
  bool ring(std::int32_t t, std::int32_t a, std::int32_t b, Few<std::int32_t, most> &around,
            Few<std::int32_t, most> &vertices, const Visit &visit) const;
  /// All tets of a vertex.
  void star(std::int32_t v, Array<std::int32_t> &around) const { tets_with(tet_of[std::size_t(v)], &v, 1, around); }
  /// False where there are more than a cavity holds.
  bool star(std::int32_t v, Cavity &around) const;
  /// Only up to a tet of which visit(tet) is false: false then.
  template <class Visit>
  bool star(std::int32_t v, Array<std::int32_t> &around, const Visit &visit) const;
  /// All tets with the `size` vertices of a simplex, of which t is one.
  void tets_with(std::int32_t t, const std::int32_t *simplex, std::size_t size, Array<std::int32_t> &around) const;

 protected:
  /// `fresh` fill what `old` filled; the faces around stay, or, on the boundary, are divided. made: where fresh went.
  void replace_tets(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made);

 private:
  struct OuterFace {
    Triangle vertices;  // ascending
    std::int32_t beyond;
    int side;
  };
  std::int32_t slot();
  void find_touching(Job &job);
  bool touches_along_edge(std::int32_t v, Span<const std::int32_t> around, Array<std::int32_t> &rim) const;
  template <class List, class Push>
  bool flood(const std::int32_t *simplex, std::size_t size, List &around, const Push &push) const;

  Memory &memory_;
  Array<std::uint32_t> touched_;  // the batch in which each tet changed last
  std::uint32_t batch_ = 0;
  Array<std::int32_t> free_;
  Array<OuterFace> outer_;
};

/// From the tets in `around` on, across faces that hold the simplex. push: false where the list is full.
template <class List, class Push>
bool TetComplex::flood(const std::int32_t *simplex, std::size_t size, List &around, const Push &push) const {
  Members members(memory_);
  for (std::size_t i = 0; i < around.size(); i++) {
    const Tet &tet = tets[std::size_t(around[i])];
    for (std::size_t k = 0; k < 4; k++) {
      const std::int32_t n = neighbours[std::size_t(around[i])][k];
      if (n < 0 || std::find(simplex, simplex + size, tet[k]) != simplex + size) continue;
      if (!members.has(around, n) && !push(n)) return false;
    }
  }
  return true;
}

template <class Visit>
bool TetComplex::star(std::int32_t v, Array<std::int32_t> &around, const Visit &visit) const {
  const auto push = [&](std::int32_t t) {
    around.push_back(t);
    return visit(t);
  };
  around.clear();
  return push(tet_of[std::size_t(v)]) && flood(&v, 1, around, push);
}

template <std::size_t most, class Visit>
bool TetComplex::ring(std::int32_t t, std::int32_t a, std::int32_t b, Few<std::int32_t, most> &around,
                      Few<std::int32_t, most> &vertices, const Visit &visit) const {
  around.clear();
  vertices.clear();
  std::int32_t from = -1, to = -1;
  for (std::int32_t v : tets[std::size_t(t)])
    if (v != a && v != b) (from < 0 ? from : to) = v;
  if (det(points[std::size_t(a)], points[std::size_t(b)], points[std::size_t(from)], points[std::size_t(to)]) < 0)
    std::swap(from, to);
  std::int32_t here = t;
  do {
    if (!visit(here) || !around.push(here)) return false;
    vertices.push(from);
    const Tet &tet = tets[std::size_t(here)];
    const auto side = std::size_t(std::find(tet.begin(), tet.end(), from) - tet.begin());
    here = neighbours[std::size_t(here)][side];
    if (here < 0) return false;
    from = to;
    for (std::int32_t v : tets[std::size_t(here)])
      if (v != a && v != b && v != from) to = v;
  } while (here != t);
  return true;
}

/// The vertices of the face opposite corner k, ascending.
Triangle sorted_face(const Tet &t, int k);

/// The tets instead of those around an edge (a, b), without it, 2 * (ring's size - 2): the ring's triangles from one of
/// its vertices, each with a tet to either side, b's first.
template <std::size_t most>
Few<Tet, 2 * (most - 2)> fan(const Few<std::int32_t, most> &ring, std::int32_t a, std::int32_t b, std::size_t apex) {
  Few<Tet, 2 * (most - 2)> fresh;
  const std::size_t n = ring.size();
  for (std::size_t i = 1; i + 1 < n; i++) {
    const std::int32_t p = ring[apex], q = ring[(apex + i) % n], r = ring[(apex + i + 1) % n];
    fresh.push({p, q, r, b});
    fresh.push({p, r, q, a});
  }
  return fresh;
}

}  // namespace tetlod
