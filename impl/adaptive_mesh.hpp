// A tetrahedral mesh that changes under the eyes of the original: connectivity that is replaced piece by piece, and in
// each tet the probes, points where the field of the mesh is compared with the original's.
#pragma once
#include <cstdint>
#include <functional>

#include "few.hpp"
#include "geometry.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// A point of the original and the original's value there.
struct Probe {
  Vec3 point;
  double value;
};

/// The linear functions that are 1 at one corner of a tet and 0 at the others.
struct TetFrame {
  Vec3 origin, row[3];
  double volume6;

  TetFrame() = default;
  TetFrame(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) : origin(a) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const Vec3 n = glm::cross(u, v);
    volume6 = glm::dot(n, w);
    const double inverse = 1 / volume6;
    row[0] = inverse * glm::cross(v, w);
    row[1] = inverse * glm::cross(w, u);
    row[2] = inverse * n;
  }
  /// Barycentric weights of p; returns the least.
  double weights(const Vec3 &p, double w[4]) const {
    const Vec3 q = p - origin;
    for (int k = 0; k < 3; k++) w[k + 1] = glm::dot(row[k], q);
    w[0] = 1 - w[1] - w[2] - w[3];
    return std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
  }
  Vec3 gradient(double a, double b, double c, double d) const {
    return (b - a) * row[0] + (c - a) * row[1] + (d - a) * row[2];
  }
};

/// Smallest volume of a tet, over the cube of its longest edge.
constexpr double least_shape = 1e-5;

/// Whether (a, b, c, d) is positive, and no sliver worse than `limit`.
inline bool is_sound(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d, double limit) {
  const double volume = det(a, b, c, d);
  if (!(volume > 0)) return false;
  const double longest =
      std::max({length2(b - a), length2(c - a), length2(d - a), length2(c - b), length2(d - b), length2(d - c)});
  return volume * volume > limit * limit * longest * longest * longest;
}

/// The frame in which p lies, or, outside of all, the one that it is least outside of; `first` before others. Its
/// weights.
inline std::size_t home_among(const TetFrame *frames, std::size_t count, std::size_t first, const Vec3 &p,
                              double w[4]) {
  double best = frames[first].weights(p, w);
  std::size_t home = first;
  for (std::size_t k = 0; k < count && best < 0; k++) {
    double other[4];
    if (k == first) continue;
    const double least = frames[k].weights(p, other);
    if (least <= best) continue;
    best = least;
    home = k;
    std::copy(other, other + 4, w);
  }
  return home;
}

/// What AdaptiveMesh::fixed says of a vertex beside 0 and 1: on the boundary, where the solid touches itself.
constexpr std::uint8_t touching = 2;

class AdaptiveMesh {
 public:
  explicit AdaptiveMesh(Memory &memory)
      : points(&memory),
        values(&memory),
        fixed(&memory),
        kept(&memory),
        tets(&memory),
        neighbours(&memory),
        error(&memory),
        probes(&memory),
        first_probe(&memory),
        next_probe(&memory),
        tet_of(&memory),
        memory_(memory),
        touched_(&memory),
        free_(&memory),
        outer_(&memory) {}

  Array<Vec3> points;
  Array<double> values;
  Array<std::uint8_t> fixed;  ///< vertices of the boundary: 1, or `touching`
  Array<std::uint8_t> kept;   ///< vertices that keep place and value
  Array<Tet> tets;            ///< every one positive; the first corner of a free slot is -1
  Array<Tet> neighbours;      ///< across the face opposite each corner; -1 on the boundary
  Array<double> error;        ///< of each tet: the sum of squares at its probes
  Array<Probe> probes;        ///< first those at original vertices
  std::size_t vertex_probes = 0;
  std::function<bool(const Vec3 &)> may_bound;  ///< whether a new vertex of the boundary may be there; empty: anywhere
  Array<std::int32_t> first_probe, next_probe;  ///< lists of the probes in each tet, ended by -1
  Array<std::int32_t> tet_of;                   ///< one of the tets of each vertex

  /// Finds the neighbours of `tets`, which has no free slot yet; all else of a tet is empty.
  void connect(Job &job);

  std::size_t count() const { return tets.size() - free_.size(); }
  bool alive(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  Memory &memory() const { return memory_; }

  const Vec3 &corner(std::int32_t t, int k) const { return points[std::size_t(tets[std::size_t(t)][std::size_t(k)])]; }
  double value(std::int32_t t, int k) const { return values[std::size_t(tets[std::size_t(t)][std::size_t(k)])]; }
  TetFrame frame(std::int32_t t) const { return {corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)}; }
  TetFrame frame(const Tet &t) const {
    return {points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])], points[std::size_t(t[3])]};
  }
  bool is_sound(const Tet &t, double limit) const {
    return tetlod::is_sound(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])],
                            points[std::size_t(t[3])], limit);
  }
  double residual(const Tet &t, const double w[4], const Probe &probe) const {
    double sum = -probe.value;
    for (std::size_t k = 0; k < 4; k++) sum += w[k] * values[std::size_t(t[k])];
    return sum;
  }

  template <class Visit>
  void for_probes(std::int32_t t, const Visit &visit) const {
    for (std::int32_t p = first_probe[std::size_t(t)]; p >= 0; p = next_probe[std::size_t(p)]) visit(p);
  }
  void put_probe(std::int32_t probe, std::int32_t t) {
    next_probe[std::size_t(probe)] = first_probe[std::size_t(t)];
    first_probe[std::size_t(t)] = probe;
  }

  /// The error of t, summed again.
  void measure(std::int32_t t);
  double total_error() const;

  double error_of(Span<const std::int32_t> some) const {
    double sum = 0;
    for (std::int32_t t : some) sum += error[std::size_t(t)];
    return sum;
  }

  /// Whether `fresh` in place of `old`, of `old_error`, changes the sum of squares, and `price` for every tet more, by
  /// less than `best`, which it then becomes. Not where a tet would be unsound.
  bool is_better(Span<const std::int32_t> old, Span<const Tet> fresh, double price, double old_error,
                 double &best) const;

  /// From here on touched() says of tets whether something has become of one of them.
  void begin_batch() { batch_++; }
  void touch(std::int32_t t) { touched_[std::size_t(t)] = batch_; }
  bool touched(Span<const std::int32_t> some) const {
    return std::any_of(some.begin(), some.end(), [&](std::int32_t t) { return touched_[std::size_t(t)] == batch_; });
  }

  /// `fresh` fill what `old` filled; the faces around stay, or, on the boundary, are divided. made: where fresh went.
  void replace(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made);

  /// The tets around an inner edge (a, b) of tet t and the ring of vertices, ring[i] and ring[i + 1] in tet i, so that
  /// (a, b, ring[i], ring[i + 1]) is positive. False on the boundary and where there are more than the lists hold.
  /// Or where visit(tet) says so of a tet.
  template <std::size_t most, class Visit>
  bool ring(std::int32_t t, std::int32_t a, std::int32_t b, Few<std::int32_t, most> &around,
            Few<std::int32_t, most> &vertices, const Visit &visit) const;
  /// All tets of a vertex. False where there are more than a cavity holds.
  void star(std::int32_t v, Array<std::int32_t> &around) const { tets_with(tet_of[std::size_t(v)], &v, 1, around); }
  bool star(std::int32_t v, Cavity &around) const;
  /// All tets with the `size` vertices of a simplex, of which t is one.
  void tets_with(std::int32_t t, const std::int32_t *simplex, std::size_t size, Array<std::int32_t> &around) const;

 private:
  struct OuterFace {
    Triangle vertices;  // ascending
    std::int32_t beyond;
    int side;
  };
  std::int32_t slot();
  void find_touching(Job &job);
  double error_after(Span<const std::int32_t> old, Span<const Tet> fresh, const TetFrame *frames, double limit) const;
  template <class List, class Push>
  bool flood(const std::int32_t *simplex, std::size_t size, List &around, const Push &push) const;

  Memory &memory_;
  Array<std::uint32_t> touched_;  // the batch in which each tet changed last
  std::uint32_t batch_ = 0;
  Array<std::int32_t> free_;
  Array<OuterFace> outer_;
};

template <std::size_t most, class Visit>
bool AdaptiveMesh::ring(std::int32_t t, std::int32_t a, std::int32_t b, Few<std::int32_t, most> &around,
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

}  // namespace tetlod
