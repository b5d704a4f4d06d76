// How far the simplified boundary is from the original one, and a limit to it: past the paper, whose decimation bounds
// nothing.
#pragma once
#include "collapse_rules.hpp"
#include "surface_distance.hpp"

namespace tetlod {

/// Of a surface, where its distance to another is measured.
enum class Samples {
  vertices,
  between_too  ///< the middles of edges and triangles as well
};

/// A limit is held at all of them; where there is none, the vertices say enough.
inline Samples samples_for(double limit) { return limit > 0 ? Samples::between_too : Samples::vertices; }

/// The largest distance from a sample of either surface to the other surface. tree_of_b goes when it was used.
double largest_deviation(const Surface &a, TreeOnDemand &tree_of_a, const Surface &b, TreeOnDemand tree_of_b,
                         Samples samples, Job &job);

/// What the spokes of a star would stand for, and for each of the star's own samples the one of the original's that is
/// nearest, so far.
class SamplesOfStar {
 public:
  explicit SamplesOfStar(Memory &memory) : homes_(&memory), places_(&memory) {}

  void begin(const Star &star);
  void add(const Star &star, std::int32_t sample, const Vec3 &p, std::size_t spoke);

  struct Home {
    std::int32_t sample, triangle;
  };
  struct Place {
    Vec3 point;
    std::int32_t nearest = -1;
    double distance2 = std::numeric_limits<double>::infinity();
  };
  Span<const Home> homes() const { return homes_; }
  Span<const Place> places() const { return places_; }

 private:
  Array<Home> homes_;
  Array<Place> places_;  // the centre, the middles of the edges from it to the ring, those of the spokes
};

/// Keeps all samples of the original surface within a distance of the triangles that stand for them, and those of the
/// simplified one within it of the original. Each triangle has a list of the original's samples that it stands for.
class DeviationLimit {
 public:
  /// original: its triangles are those that the decimation begins with, by number. nearest: its tree. Both must live as
  /// long.
  DeviationLimit(const Surface &original, const TriangleTree &nearest, double limit, Job &job);

  /// Whether the collapse would take the surface too far. If not, `of_star` is for move_on.
  bool is_passed(const Star &star, SamplesOfStar &of_star) const;
  /// The collapse was made: the star's spokes stand for what its old triangles stood for. Collapses whose stars have no
  /// triangle in common may be looked at and made at the same time.
  void move_on(const Star &star, const SamplesOfStar &of_star);

 private:
  bool is_far(const SamplesOfStar::Place &place) const;

  double limit2_;
  const TriangleTree &nearest_;
  Array<Vec3> samples_;               // of the original
  Array<std::int32_t> triangle_;      // of each, one that has it
  Array<std::int32_t> first_, next_;  // lists of them, by triangle
};

}  // namespace tetlod
