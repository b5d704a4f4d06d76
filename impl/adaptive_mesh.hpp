// A tetrahedral mesh that changes under the eyes of the original: connectivity that is replaced piece by piece, and in
// each tet the probes, points where the field of the mesh is compared with the original's.
#pragma once
#include <cstdint>

#include "geometry.hpp"
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
  Array<std::int32_t> first_probe, next_probe;  ///< lists of the probes in each tet, ended by -1
  Array<std::int32_t> tet_of;                   ///< one of the tets of each vertex

  /// Finds the neighbours of `tets`, which has no free slot yet; all else of a tet is empty.
  void connect();

  std::size_t count() const { return tets.size() - free_.size(); }
  bool alive(std::int32_t t) const { return tets[std::size_t(t)][0] >= 0; }
  Memory &memory() const { return memory_; }

  const Vec3 &corner(std::int32_t t, int k) const { return points[std::size_t(tets[std::size_t(t)][std::size_t(k)])]; }
  double value(std::int32_t t, int k) const { return values[std::size_t(tets[std::size_t(t)][std::size_t(k)])]; }
  TetFrame frame(std::int32_t t) const { return {corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)}; }
  TetFrame frame(const Tet &t) const {
    return {points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])], points[std::size_t(t[3])]};
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

  /// What replace() would make of the error: the probes of the old tets in the fresh ones.
  double error_after(Span<const std::int32_t> old, Span<const Tet> fresh) const;

  /// `fresh` fill what `old` filled; the faces around stay, or, on the boundary, are divided. made: where fresh went.
  void replace(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made);

  /// The tets around an inner edge (a, b) of tet t and the ring of vertices, ring[i] and ring[i + 1] in tet i, so that
  /// (a, b, ring[i], ring[i + 1]) is positive. False on the boundary and where there are more than `most`.
  bool ring(std::int32_t t, std::int32_t a, std::int32_t b, std::size_t most, Array<std::int32_t> &around,
            Array<std::int32_t> &vertices) const;
  /// All tets of a vertex.
  void star(std::int32_t v, Array<std::int32_t> &around) const;
  /// All tets with the `size` vertices of a simplex, of which t is one.
  void tets_with(std::int32_t t, const std::int32_t *simplex, std::size_t size, Array<std::int32_t> &around) const;

 private:
  struct OuterFace {
    Triangle vertices;  // ascending
    std::int32_t beyond;
    int side;
  };
  std::int32_t slot();
  void find_touching();

  Memory &memory_;
  Array<std::int32_t> free_;
  Array<OuterFace> outer_;
};

/// The vertices of the face opposite corner k, ascending.
Triangle sorted_face(const Tet &t, int k);

}  // namespace tetlod
