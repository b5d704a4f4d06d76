// How far the simplified boundary is from the original one, and a limit to it: past the paper, whose decimation bounds
// nothing.
#pragma once
#include "collapse_rules.hpp"
#include "surface_distance.hpp"

namespace tetlod {

/// The largest distance from a vertex of either surface to the other surface.
double largest_deviation(const Surface &a, const Surface &b, Job &job);

/// Keeps vertices of the original surface within a distance of the triangles that stand for them, and vertices of the
/// simplified one within it of the original. Each triangle has a list of the original vertices that it stands for.
class DeviationLimit {
 public:
  /// original: must live as long; its triangles are those that the decimation begins with, by number.
  DeviationLimit(const Surface &original, double limit, Job &job);

  /// Whether the collapse would take the surface too far.
  bool is_passed(const Star &star);
  /// The collapse was made: the star's spokes stand for what its old triangles stood for.
  void move_on(const Star &star);

 private:
  double limit2_;
  const Surface &original_;
  NearestTriangle nearest_;
  Array<std::int32_t> first_, next_;                    // lists of vertices, by triangle
  Array<std::pair<std::int32_t, std::int32_t>> homes_;  // of the collapse looked at last: vertex, triangle
};

}  // namespace tetlod
