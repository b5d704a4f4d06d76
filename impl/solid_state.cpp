#include "solid_state.hpp"

#include <numeric>

namespace tetlod {

SolidProgress::SolidProgress(std::size_t vertices, std::size_t tets, Memory &memory)
    : next_closing(std::int64_t(tets) / 4 * 3),  // soon, as the first rounds are the longest
      cheapest(vertices, CheapestEdge(), &memory),
      moved(vertices, -1, &memory),
      changed(vertices, 0, &memory) {
  std::iota(changed.begin(), changed.end(), 0);
}

SolidProgress::SolidProgress(const SolidProgress &of, Memory &memory)
    : round(of.round),
      most_waited(of.most_waited),
      largest_target(of.largest_target),
      next_closing(of.next_closing),
      cheapest(of.cheapest, &memory),
      moved(of.moved, &memory),
      changed(of.changed, &memory) {}

void SolidProgress::close_gaps(Span<const std::int32_t> left, Span<const std::int32_t> number) {
  const auto renumber = [&](std::int32_t &v) { v = v < 0 ? v : number[std::size_t(v)]; };
  keep_alone(left, cheapest);
  keep_alone(left, moved);
  for (CheapestEdge &edge : cheapest) renumber(edge.other);
  for (std::int32_t &v : changed) renumber(v);
}

void SolidHistory::begin(const MeshView &original, Memory &memory) {
  Fingerprint values;
  values.add(std::uint64_t(original.fields));
  for (std::size_t k = 0; k < original.fields; k++) values.add(original.scales.weighted[k]);
  for (double value : original.scalars) values.add(value);
  if (!(values == values_)) forget(memory);
  values_ = values;
}

}  // namespace tetlod
