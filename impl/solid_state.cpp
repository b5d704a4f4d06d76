#include "solid_state.hpp"

#include <numeric>

#include "portable_math.hpp"

namespace tetlod {

SolidProgress::SolidProgress(std::size_t vertices, std::size_t tets, Job &job)
    : next_closing(std::int64_t(tets) / 5 * 3),  // where removals end on the way to a fifth; then to a tenth, ...
      cheapest(array_of(vertices, CheapestEdge(), job)),
      moved(array_of(vertices, -1, job)),
      home(&job.memory),
      into(&job.memory) {}

SolidProgress::SolidProgress(const SolidProgress &of, Memory &memory)
    : far(of.far),
      round(of.round),
      last_far(of.last_far),
      first_near(of.first_near),
      most_waited(of.most_waited),
      relaxed(of.relaxed),
      largest_target(of.largest_target),
      largest_size(of.largest_size),
      next_closing(of.next_closing),
      cost(of.cost),
      cheapest(of.cheapest, &memory),
      moved(of.moved, &memory),
      home(of.home, &memory),
      into(of.into, &memory) {}

void SolidProgress::choose_way(std::int64_t count, std::int64_t tets) {
  if (!removes()) return;
  (is_far(count, tets) ? last_far : first_near) = count;
}

void SolidProgress::follow(Span<const std::int32_t> origin, std::size_t originals) {
  home.assign(originals, -1);
  for (std::size_t v = 0; v < origin.size(); v++) home[std::size_t(origin[v])] = std::int32_t(v);
  into.resize(origin.size());
  std::iota(into.begin(), into.end(), 0);
}

void SolidProgress::close_gaps(Span<const std::int32_t> number, Job &job) {
  const auto renumber = [&](std::int32_t &v) { v = v < 0 ? v : number[std::size_t(v)]; };
  const auto is_left = [&](std::size_t v) { return number[v] >= 0; };
  job.parallel.at_once([&] { keep_where(cheapest, job, is_left); }, [&] { keep_where(moved, job, is_left); });
  for_each(cheapest.size(), job, [&](std::size_t v) { renumber(cheapest[v].other); });
  if (!follows()) return;
  for (std::int32_t &v : home) {
    while (v >= 0 && into[std::size_t(v)] != v) v = into[std::size_t(v)];
    renumber(v);
  }
  into.resize(moved.size());
  std::iota(into.begin(), into.end(), 0);
}

void SolidHistory::begin(const MeshView &original, const CollapseWay &way, Job &job) {
  Fingerprint values;
  values.add(std::uint64_t(original.fields));
  for (std::size_t k = 0; k < original.fields; k++) values.add(original.scales.weighted[k]);
  values.add(original.scalars, job);
  now_ = values;
  repeated_ = !is_earlier();
  if (!(way == way_) || (is_earlier() && !way.keeps_earlier)) forget_earlier(job.memory);
  way_ = way;
}

void SolidHistory::forget(Memory &memory) {
  states_ = Array<SolidState<1>>(&memory);
  set_usual_cost(0, 0);
}

void SolidHistory::forget_earlier(Memory &memory) {
  forget(memory);
  values_ = now_;
}

double SolidHistory::usual_cost(std::int64_t tets) const {
  if (!knows_usual_cost()) return 0;
  const double coarser = double(tets_of_cost_) / double(tets);
  return usual_cost_ * coarser * root(coarser, 3);  // of linear interpolation, of second order: to 4/3
}

}  // namespace tetlod
