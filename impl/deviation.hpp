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

/// The largest distance from a sample of either surface to the other surface.
double largest_deviation(const Surface &a, TreeOnDemand &tree_of_a, const Surface &b, Samples samples, Job &job);

/// Keeps all samples of the original surface within a distance of the triangles that stand for them, and those of the
/// simplified one within it of the original. Each triangle has a list of the original's samples that it stands for.
class DeviationLimit {
 public:
  /// original: its triangles are those that the decimation begins with, by number. nearest: its tree; must live as
  /// long.
  DeviationLimit(const Surface &original, const TriangleTree &nearest, double limit, Job &job);

  /// Whether the collapse would take the surface too far.
  bool is_passed(const Star &star);
  /// The collapse was made: the star's spokes stand for what its old triangles stood for.
  void move_on(const Star &star);

 private:
  bool is_far(const Vec3 &p) const;

  double limit_;
  const TriangleTree &nearest_;
  Array<Vec3> samples_;                                 // of the original
  Array<std::int32_t> first_, next_;                    // lists of them, by triangle
  Array<std::pair<std::int32_t, std::int32_t>> homes_;  // of the collapse looked at last: sample, triangle
};

}  // namespace tetlod
