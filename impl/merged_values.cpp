#include "merged_values.hpp"

#include <algorithm>

#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Calls visit(begin, end) of the merged points of each place.
template <class Visit>
void for_each_place(Span<const MergedPoint> merged, Job &job, const Visit &visit) {
  for (std::size_t begin = 0, end = 0; begin < merged.size(); begin = end) {
    job.poll_at(begin, 0.9);
    while (end < merged.size() && merged[end].into == merged[begin].into) end++;
    visit(begin, end);
  }
}

/// Of a field at a place, with the points that have them.
struct Extremes {
  double low, high;
  std::int32_t lowest, highest;
  void add(double value, std::int32_t v) {
    if (value < low) low = value, lowest = v;
    if (value > high) high = value, highest = v;
  }
  double half() const { return 0.5 * high - 0.5 * low; }
};

Extremes extremes_of(const MeshView &mesh, Span<const MergedPoint> place, std::size_t field) {
  const auto value_of = [&](std::int32_t v) { return mesh.scalars[std::size_t(v) * mesh.fields + field]; };
  const std::int32_t first = place[0].into;
  Extremes extremes{value_of(first), value_of(first), first, first};
  for (const MergedPoint &p : place) extremes.add(value_of(p.point), p.point);
  return extremes;
}

void own_values(Job &job, Original &original) {
  if (!original.scalars.empty()) return;
  const Span<const double> submitted = original.view.scalars;
  grow(original.scalars, submitted.size(), job);
  for_each(submitted.size(), job, [&](std::size_t i) { original.scalars[i] = submitted[i]; });
  original.view.scalars = original.scalars;
}

}  // namespace

Array<MergedPoint> find_merged(Span<const std::int32_t> representative, Job &job) {
  Array<MergedPoint> merged(&job.memory);
  for (std::size_t v = 0; v < representative.size(); v++) {
    job.poll_at(v, 0.9);
    if (representative[v] != std::int32_t(v)) merged.push_back({representative[v], std::int32_t(v)});
  }
  std::sort(merged.begin(), merged.end(), [](const MergedPoint &a, const MergedPoint &b) {
    return a.into != b.into ? a.into < b.into : a.point < b.point;
  });
  return merged;
}

void take_middles(Job &job, Original &original) {
  const std::size_t fields = original.view.fields;
  original.spread = {};
  original.spread_range = {};
  for_each_place(original.merged, job, [&](std::size_t begin, std::size_t end) {
    const Span<const MergedPoint> place(original.merged.data() + begin, end - begin);
    for (std::size_t k = 0; k < fields; k++) {
      const Extremes extremes = extremes_of(original.view, place, k);
      if (!(extremes.high > extremes.low)) continue;
      own_values(job, original);
      original.spread_range.low[k] = std::min(original.spread_range.low[k], extremes.low);
      original.spread_range.high[k] = std::max(original.spread_range.high[k], extremes.high);
      original.scalars[std::size_t(place[0].into) * fields + k] = extremes.low + extremes.half();
      Spread &worst = original.spread[k];
      if (extremes.half() > worst.half) worst = {extremes.half(), extremes.lowest, extremes.highest};
    }
  });
}

}  // namespace tetlod
