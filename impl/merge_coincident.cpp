#include "merge_coincident.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "budget.hpp"
#include "disjoint_sets.hpp"
#include "merge_points.hpp"
#include "touching_parts.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// By how much coordinates of one place may differ that were computed twice.
double rounding_of(const Box &box) { return std::max(1e-12 * box.diagonal(), 1e-15 * box.largest_coordinate()); }

/// A point that became one with others, as the first of these.
struct MergedPoint {
  std::int32_t first, part, point;
  bool operator<(const MergedPoint &other) const {
    return std::tie(first, part, point) < std::tie(other.first, other.part, other.point);
  }
};

/// Whether two that are not equal are of one part, which hangs together by the tets' points: it is thinner than
/// rounding.
bool merges_within_parts(Span<const Vec3> points, Span<const Tet> tets, Span<const std::int32_t> representative,
                         Job &job) {
  const auto is_equal = [&](std::int32_t v, std::int32_t u) {
    return points[std::size_t(v)] == points[std::size_t(u)];
  };
  std::size_t v = 0;
  while (v < points.size() && is_equal(std::int32_t(v), representative[v])) v++;
  if (v == points.size()) return false;
  DisjointSets parts(points.size(), job.memory);
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0.9);
    for (const std::int32_t u : tets[t]) parts.join(tets[t][0], u);
  }
  Array<MergedPoint> merged(&job.memory);
  for (v = 0; v < points.size(); v++) {
    job.poll_at(v, 0.9);
    const std::int32_t point = std::int32_t(v), first = representative[v];
    if (first == point) continue;
    merged.push_back({first, parts.lowest(point), point});
    merged.push_back({first, parts.lowest(first), first});
  }
  std::sort(merged.begin(), merged.end(), PollingLess(job, 0.9, std::less<MergedPoint>()));
  for (std::size_t i = 1; i < merged.size(); i++) {
    const MergedPoint &a = merged[i - 1], &b = merged[i];
    if (a.first == b.first && a.part == b.part && !is_equal(a.point, b.point)) return true;
  }
  return false;
}

std::int64_t merge_places(Span<const Vec3> points, Span<const Tet> tets, Span<const std::uint8_t> used,
                          double tolerance, double rounding, Job &job, Array<std::int32_t> &representative) {
  if (tolerance < rounding) {
    const std::int64_t merged = merge_points(points, used, rounding, job, representative);
    if (!merges_within_parts(points, tets, representative, job)) return merged;
  }
  return merge_points(points, used, tolerance, job, representative);
}

}  // namespace

Merged merge_coincident(const Input &input, Span<const Vec3> points, Span<const Tet> tets,
                        Span<const std::uint8_t> used, const Box &box, const Options &options, Job &job,
                        Array<std::int32_t> &representative) {
  const bool is_finite = std::isfinite(box.diagonal());
  const double tolerance = is_finite ? options.merge_tolerance * box.diagonal() : 0;
  const double rounding = is_finite ? rounding_of(box) : 0;
  const std::int64_t merged = merge_places(points, tets, used, tolerance, rounding, job, representative);
  if (merged == 0 || !takes_contacts(options)) return {merged, merged > 0, false};
  const KeptApart kept = keep_touching_parts_apart(input, points, tets, used, job, representative);
  return {kept.merged, kept.merged < merged || kept.sees_values, kept.sees_values};
}

}  // namespace tetlod
