#include "merge_coincident.hpp"

#include <algorithm>
#include <cmath>

#include "budget.hpp"
#include "merge_points.hpp"
#include "touching_parts.hpp"

namespace tetlod {

namespace {

/// By how much coordinates of one place may differ that were computed twice.
double rounding_of(const Box &box) { return std::max(1e-12 * box.diagonal(), 1e-15 * box.largest_coordinate()); }

}  // namespace

Merged merge_coincident(Span<const Vec3> points, Span<const Tet> tets, Span<const std::uint8_t> used, const Box &box,
                        const Options &options, Job &job, Array<std::int32_t> &representative) {
  const double tolerance = std::max(options.merge_tolerance * box.diagonal(), rounding_of(box));
  const std::int64_t merged = merge_points(points, used, std::isfinite(tolerance) ? tolerance : 0, job, representative);
  if (merged == 0 || !takes_contacts(options)) return {merged, merged > 0};
  const std::int64_t left = keep_touching_parts_apart(points, tets, used, job, representative);
  return {left, left < merged};
}

}  // namespace tetlod
