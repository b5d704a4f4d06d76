#include "measure_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "merged_values.hpp"

namespace tetlod {

namespace {

/// Of the fields of a mesh, field by field.
using Ranges = ValueRange<most_fields>;

void add_values(const MeshView &mesh, std::size_t v, Ranges &ranges) {
  for (std::size_t k = 0; k < mesh.fields; k++) {
    ranges.low[k] = std::min(ranges.low[k], mesh.scalars[v * mesh.fields + k]);
    ranges.high[k] = std::max(ranges.high[k], mesh.scalars[v * mesh.fields + k]);
  }
}

/// Away from the ends of doubles, so that what is scaled by it can be scaled back.
constexpr double least_scale = 1e-250, largest_scale = 1e250;
double sane_scale(double scale) { return scale > least_scale ? std::min(scale, largest_scale) : least_scale; }

/// Not more than a double holds.
double range_of(const Ranges &ranges, std::size_t k) {
  return std::min(ranges.high[k] - ranges.low[k], std::numeric_limits<double>::max());
}

/// What errors of a field are compared with. A constant one's are of rounding: they are to count next to nothing.
double extent_of(const Ranges &ranges, std::size_t k) {
  const double range = range_of(ranges, k);
  return range > 0 ? range : std::max({std::abs(ranges.low[k]), std::abs(ranges.high[k]), 1.0});
}

/// What is constant has no errors.
bool is_unequal(const Ranges &ranges, std::size_t k, double relative) {
  return ranges.high[k] > ranges.low[k] && (relative <= least_scale || relative >= largest_scale);
}

void find_scales(const Input &input, const Ranges &ranges, Original &original) {
  original.scalar_min = ranges.low[0];
  original.scalar_max = ranges.high[0];
  original.range = range_of(ranges, 0);
  original.view.scales = {};
  original.unequal_field = 0;
  for (std::size_t k = 1; k < original.view.fields; k++)
    if (!(original.range > 0) && ranges.high[k] > ranges.low[k]) original.range = extent_of(ranges, 0);
  for (std::size_t k = 1; k < original.view.fields; k++) {
    const double relative = sane_scale(original.range / extent_of(ranges, k));
    if (original.unequal_field == 0 && is_unequal(ranges, k, relative)) original.unequal_field = k;
    original.view.scales.relative[k] = relative;
    original.view.scales.weighted[k] = sane_scale(relative * input.steering[k - 1].weight);
  }
}

}  // namespace

void measure_ranges(const Input &input, Job &job, Original &original) {
  Ranges ranges = original.spread_range;
  original.box = {};
  for (std::size_t v = 0; v < original.view.used.size(); v++) {
    job.poll_at(v, 0.9);
    if (!original.view.used[v]) continue;
    add_values(original.view, v, ranges);
    original.box.add(original.view.points[v]);
  }
  find_scales(input, ranges, original);
  find_spread_error(original);
}

}  // namespace tetlod
