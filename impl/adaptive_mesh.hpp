// A tetrahedral mesh that changes under the eyes of the original: in each tet the probes, points where the fields of
// the mesh are compared with the original's.
#pragma once
#include <cstdint>

#include "tet_complex.hpp"

namespace tetlod {

/// A point of the original and the original's values there.
template <std::size_t m>
struct Probe {
  Vec3 point;
  Values<m> value;
};

template <std::size_t m>
class AdaptiveMesh : public TetComplex {
 public:
  explicit AdaptiveMesh(Memory &memory)
      : TetComplex(memory),
        values(&memory),
        error(&memory),
        probes(&memory),
        vertex_of_probe(&memory),
        outside(&memory),
        in_no_tet(&memory),
        first_probe(&memory),
        next_probe(&memory) {}

  Array<Values<m>> values;  ///< of each vertex
  FieldScales scales;       ///< of the original
  Array<double> error;      ///< of each tet: the sum of squares at its probes, as they count
  Array<Probe<m>> probes;   ///< first those at original vertices
  std::size_t vertex_probes = 0;
  double vertex_weight = 1;                         ///< what each of those counts as, of one inside
  double share_of_vertices = 1;                     ///< of the original vertices that tets use, those that have one
  std::size_t left_out = 0, vertices_left_out = 0;  ///< probes in no tet, and those at original vertices among them
  Array<std::int32_t> vertex_of_probe;              ///< the original vertex of each of those
  Array<std::uint8_t> outside;    ///< of each: it lies outside, the probe on the boundary; empty: none does
  Array<std::int32_t> in_no_tet;  ///< original vertices, when probes were placed; changes of the mesh may have made
                                  ///< a matter of rounding of that
  Array<std::int32_t> first_probe, next_probe;  ///< lists of the probes in each tet, ended by -1

  /// Finds the neighbours of `tets`, which has no free slot yet; all else of a tet is empty.
  void connect(Job &job);

  const Values<m> &value(std::int32_t t, int k) const {
    return values[std::size_t(tets[std::size_t(t)][std::size_t(k)])];
  }
  Values<m> residual(const Tet &t, const double w[4], const Probe<m> &probe) const {
    Values<m> r;
    for (std::size_t i = 0; i < m; i++) {
      r[i] = -probe.value[i];
      for (std::size_t k = 0; k < 4; k++) r[i] += w[k] * values[std::size_t(t[k])][i];
    }
    return r;
  }
  /// Residuals as they count beside each other, and the sum of squares of that.
  Values<m> weighted(Values<m> r) const {
    for (std::size_t i = 1; i < m; i++) r[i] *= scales.weighted[i];
    return r;
  }
  double square(const Values<m> &r) const {
    const Values<m> counts = weighted(r);
    double sum = counts[0] * counts[0];
    for (std::size_t i = 1; i < m; i++) sum += counts[i] * counts[i];
    return sum;
  }
  /// Of a residual: as if all ranges were the first's.
  double largest_part(const Values<m> &residual) const {
    double largest = std::abs(residual[0]);
    for (std::size_t i = 1; i < m; i++) largest = std::max(largest, scales.relative[i] * std::abs(residual[i]));
    return largest;
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
  /// That of each.
  void measure_all(double fraction, Job &job);
  double total_error() const;

  double error_of(Span<const std::int32_t> some) const {
    double sum = 0;
    for (std::int32_t t : some) sum += error[std::size_t(t)];
    return sum;
  }

  double weight_of(std::int32_t probe) const { return std::size_t(probe) < vertex_probes ? vertex_weight : 1; }
  /// At the probes that are in a tet.
  double mean_square() const {
    const std::size_t vertices = vertex_probes - vertices_left_out, all = probes.size() - left_out;
    return total_error() / (vertex_weight * double(vertices) + double(all - vertices));
  }

  /// Whether `fresh` in place of `old`, of `old_error`, changes the sum of squares, and `price` for every tet more, by
  /// less than `best`, which it then becomes. Not where a tet would be unsound.
  bool is_better(Span<const std::int32_t> old, Span<const Tet> fresh, double price, double old_error,
                 double &best) const;

  /// `fresh` fill what `old` filled, and take over its probes. made: where fresh went.
  void replace(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made);

 private:
  double error_after(Span<const std::int32_t> old, Span<const Tet> fresh, const TetFrame *frames, double limit) const;
};

}  // namespace tetlod
