#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "find_rho.hpp"
#include "outside_judge.hpp"
#include "run_peer.hpp"

namespace bench {
namespace {

constexpr double kSameSize = 0.1;  // parts of the peer's size

struct Original {
  const std::string &name;
  const Mesh &mesh;
  Shape shape;
  const std::string &judge;
};

// Of one result: the median of several would be of no mesh.
void compare_judges(const Original &original, Entry entry, const Mesh &result) {
  if (original.judge.empty()) return;
  entry.quality = measure_quality(original.mesh, original.shape, result);
  print_agreement(original.name, entry, ask_judge(original.judge, original.mesh, result));
}

template <class Run>
std::pair<Spread, Spread> costs_of(const std::vector<Run> &runs) {
  return {spread_of(runs, [](const Run &run) { return run.cost.wall; }),
          spread_of(runs, [](const Run &run) { return run.cost.cpu; })};
}

Quality median_of(const std::vector<Quality> &all) {
  const auto median = [&all](const auto &figure) { return spread_of(all, figure).median; };
  Quality middle{};
  for (double FieldError::*const figure :
       {&FieldError::rms, &FieldError::max, &FieldError::outside, &FieldError::max_everywhere, &FieldError::rms_inner,
        &FieldError::max_inner, &FieldError::outside_inner}) {
    middle.field.*figure = median([figure](const Quality &quality) { return quality.field.*figure; });
  }
  middle.hausdorff = median([](const Quality &quality) { return quality.hausdorff; });
  middle.volume = median([](const Quality &quality) { return quality.volume; });
  middle.valid = std::all_of(all.begin(), all.end(), [](const Quality &quality) { return quality.valid; });
  return middle;
}

double median_tets(const std::vector<PeerRun> &runs) {
  return spread_of(runs, [](const PeerRun &run) { return double(run.result.tets.size()); }).median;
}

Entry peer_entry(const Original &original, const std::vector<PeerRun> &runs) {
  std::vector<Quality> qualities;
  for (const PeerRun &run : runs) qualities.push_back(measure_quality(original.mesh, original.shape, run.result));
  const auto [wall, cpu] = costs_of(runs);
  const Entry entry{"peer", std::llround(median_tets(runs)), median_of(qualities), wall, cpu};
  compare_judges(original, entry, runs.back().result);
  return entry;
}

Entry preset_entry(const Original &original, const Parameters &parameters, const std::vector<TetlodRun> &runs) {
  const auto [wall, cpu] = costs_of(runs);
  const Mesh &result = runs.back().result;
  const Entry entry{preset_name(parameters.preset), std::int64_t(result.tets.size()),
                    measure_quality(original.mesh, original.shape, result), wall, cpu};
  compare_judges(original, entry, result);
  return entry;
}

// The presets at so many tets.
std::vector<Parameters> presets_at(const Mesh &mesh, std::int64_t tets, std::int64_t threads) {
  const double target = std::min(1.0, double(tets) / double(mesh.tets.size()));
  std::vector<Parameters> presets{paper_at(mesh, tets, threads)};
  for (const std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    Parameters parameters;
    parameters.preset = preset;
    parameters.target = target;
    parameters.threads = threads;
    presets.push_back(parameters);
  }
  return presets;
}

// `peer` null: the presets alone. `goal`: what the peer is asked for, or the presets without it. The peer is first: it
// is random where it stops, and the presets are asked for its median.
SizeRow measure_row(const Original &original, const Peer *peer, std::int64_t goal, const SweepOptions &options) {
  std::vector<PeerRun> theirs;
  for (int round = 0; peer && round < options.rounds; round++) theirs.push_back(peer->run(goal));
  if (peer) goal = std::llround(median_tets(theirs));
  const std::vector<Parameters> presets = presets_at(original.mesh, goal, options.threads);
  std::vector<std::vector<TetlodRun>> ours(presets.size());
  for (int round = 0; round < options.rounds; round++) {
    for (std::size_t p = 0; p < presets.size(); p++) ours[p].push_back(run_tetlod(original.mesh, presets[p]));
  }
  SizeRow row{double(goal) / double(original.mesh.tets.size()), {}};
  if (peer) row.entries.push_back(peer_entry(original, theirs));
  for (std::size_t p = 0; p < presets.size(); p++) {
    row.entries.push_back(preset_entry(original, presets[p], ours[p]));
  }
  return row;
}

bool is_reached(const SizeRow &row, double asked) { return row.asked <= (1 + kSameSize) * asked; }

}  // namespace

Sweep sweep_set(const std::string &name, const Mesh &mesh, const SweepOptions &options) {
  const Original original{name, mesh, shape_of(mesh), options.judge};
  const Peer peer(mesh);
  Sweep sweep{name, std::int64_t(mesh.points.size()), std::int64_t(mesh.tets.size()), {}};
  std::vector<double> falling = options.sizes;
  std::sort(falling.begin(), falling.end(), std::greater<>());
  bool peer_stops = false;  // where it stopped once it stops again, however little it is asked for
  for (const double size : falling) {
    std::fprintf(stderr, "%s: %.1f %%\n", name.c_str(), 100 * size);
    const std::int64_t goal = std::llround(size * double(mesh.tets.size()));
    if (!peer_stops) {
      sweep.rows.push_back(measure_row(original, &peer, goal, options));
      peer_stops = !is_reached(sweep.rows.back(), size);
    }
    if (peer_stops) sweep.rows.push_back(measure_row(original, nullptr, goal, options));
    sweep.rows.back().asked = size;
  }
  return sweep;
}

const Entry *peer_of(const SizeRow &row) {
  return !row.entries.empty() && row.entries.front().method == "peer" ? &row.entries.front() : nullptr;
}

bool is_comparable(const Entry &entry, const Entry &peer) {
  return std::fabs(double(entry.tets) - double(peer.tets)) <= kSameSize * double(peer.tets);
}

}  // namespace bench
