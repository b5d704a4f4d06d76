#include "merged_values.hpp"

#include <algorithm>

#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Of a field, at a place.
struct AtPlace {
  double low = 0, high = 0, flagged = 0;
  std::int32_t lowest = -1, highest = -1;
  bool is_flagged = false;

  void add(double value, std::int32_t v, bool flag) {
    if (lowest < 0 || value < low) low = value, lowest = v;
    if (highest < 0 || value > high) high = value, highest = v;
    if (flag && !is_flagged) flagged = value, is_flagged = true;
  }
  double taken() const { return is_flagged ? flagged : low + (0.5 * high - 0.5 * low); }
  Spread spread() const { return {std::max(high - taken(), taken() - low), lowest, highest}; }
};

AtPlace values_at(std::size_t v, std::size_t field, const Original &original) {
  AtPlace values;
  const Array<FlaggedPoint> &flagged = original.moves.flagged;
  original.for_each_merged(v, [&](std::size_t u) {
    const FlaggedPoint point{std::int32_t(v), std::int32_t(u)};
    const bool is_flagged = std::binary_search(flagged.begin(), flagged.end(), point);
    values.add(original.view.scalars[u * original.view.fields + field], point.point, is_flagged);
  });
  return values;
}

void own_values(Job &job, Original &original) {
  if (!original.scalars.empty()) return;
  const Span<const double> submitted = original.view.scalars;
  grow(original.scalars, submitted.size(), job);
  for_each(submitted.size(), job, [&](std::size_t i) { original.scalars[i] = submitted[i]; });
  original.view.scalars = original.scalars;
}

}  // namespace

Array<std::int32_t> chain_merged(Span<const std::int32_t> representative, Job &job) {
  Array<std::int32_t> next = array_of(representative.size(), -1, job);
  for (std::size_t v = next.size(); v-- > 0;) {
    job.poll_at(v, 0.9);
    const auto to = std::size_t(representative[v]);
    if (to == v) continue;
    next[v] = next[to];
    next[to] = std::int32_t(v);
  }
  return next;
}

Array<FlaggedPoint> find_flagged(const Input &input, Job &job, const Original &original) {
  Array<FlaggedPoint> flagged(&job.memory);
  if (!input.flags.present) return flagged;
  for (std::size_t v = 0; v < original.next_merged.size(); v++) {
    job.poll_at(v, 0.9);
    if (!original.flags[v] || original.next_merged[v] < 0) continue;
    for (auto u = std::int32_t(v); u >= 0; u = original.next_merged[std::size_t(u)])
      if (input.flags.at<std::uint8_t>(u, 0)) flagged.push_back({std::int32_t(v), u});
  }
  return flagged;
}

Moves moves_to_flagged(Span<const FlaggedPoint> flagged, Span<const Vec3> points, Memory &memory) {
  Moves moves(&memory);
  std::int32_t last = -1;
  for (const auto &[vertex, point] : flagged) {
    const Vec3 &place = points[std::size_t(point)];
    if (vertex != last && place != points[std::size_t(vertex)]) moves.push_back({vertex, place});
    last = vertex;
  }
  return moves;
}

void find_points_that_count(const Input &input, Job &job, Original &original) {
  original.counts.assign(original.next_merged.size(), 0);
  for (std::size_t i = 0; i < original.view.tets.size(); i++) {
    job.poll_at(i, 0.9);
    const std::int64_t t = original.tet_number.empty() ? std::int64_t(i) : original.tet_number[i];
    for (int k = 0; k < 4; k++) original.counts[std::size_t(input.tets.integer(t, k) - input.index_base)] = 1;
  }
}

void take_merged_values(Job &job, Original &original) {
  original.spread = {};
  original.spread_range = {};
  const std::size_t fields = original.view.fields;
  for (std::size_t v = 0; v < original.next_merged.size(); v++) {
    job.poll_at(v, 0.9);
    for (std::size_t k = 0; k < fields && original.has_merged(v); k++) {
      const AtPlace values = values_at(v, k, original);
      const double now = original.view.scalars[v * fields + k];
      if (values.low == now && values.high == now) continue;
      own_values(job, original);
      original.scalars[v * fields + k] = values.taken();
      original.spread_range.low[k] = std::min(original.spread_range.low[k], values.low);
      original.spread_range.high[k] = std::max(original.spread_range.high[k], values.high);
      const Spread spread = values.spread();
      if (spread.distance > original.spread[k].distance) original.spread[k] = spread;
    }
  }
}

void find_spread_error(Original &original) {
  original.spread_error = 0;
  for (std::size_t k = 0; k < original.view.fields; k++)
    original.spread_error =
        std::max(original.spread_error, original.view.scales.relative[k] * original.spread[k].distance);
  original.spread_error = std::min(original.spread_error, original.range);  // no value leaves its field's
}

}  // namespace tetlod
