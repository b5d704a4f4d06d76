#include "contest.hpp"

#include <algorithm>

#include "run_peer.hpp"

namespace bench {
namespace {

struct Rounds {
  std::vector<TetlodRun> ours;
  std::vector<PeerRun> theirs;
};

// Tells the peer its goal, and brings what is read once (files, pages, the worker's program) into memory.
std::int64_t warm_up(const Mesh &mesh, const Parameters &parameters) {
  return run_tetlod(mesh, parameters).report.tets_out;
}

Rounds take_turns(const Mesh &mesh, const Parameters &parameters, int rounds) {
  const Peer peer(mesh);
  const std::int64_t goal = warm_up(mesh, parameters);
  Rounds all;
  for (int round = 0; round < rounds; round++) {
    const bool peer_first = round % 2 == 1;
    if (peer_first) all.theirs.push_back(peer.run(goal));
    all.ours.push_back(run_tetlod(mesh, parameters));
    if (!peer_first) all.theirs.push_back(peer.run(goal));
  }
  return all;
}

template <class Run>
Side side_of(const Mesh &mesh, const std::vector<Run> &runs) {
  std::vector<double> seconds, rms;
  FieldError error{};
  for (const Run &run : runs) {
    error = measure_field_error(mesh, run.result);
    seconds.push_back(run.seconds);
    rms.push_back(error.rms);
  }
  return {static_cast<std::int64_t>(runs.back().result.tets.size()), spread_of(seconds), spread_of(rms), error};
}

Spread ratio_of(const Rounds &all) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < all.ours.size(); i++) ratios.push_back(all.ours[i].seconds / all.theirs[i].seconds);
  return spread_of(ratios);
}

// The last report, with the median over the rounds for each stage.
tetlod_run_report report_of(const std::vector<TetlodRun> &runs) {
  tetlod_run_report report = runs.back().report;
  for (const auto stage :
       {&tetlod_run_report::seconds_prepare, &tetlod_run_report::seconds_boundary, &tetlod_run_report::seconds_decimate,
        &tetlod_run_report::seconds_sample, &tetlod_run_report::seconds_cull, &tetlod_run_report::seconds_remesh,
        &tetlod_run_report::seconds_values, &tetlod_run_report::seconds_total}) {
    std::vector<double> seconds;
    for (const TetlodRun &run : runs) seconds.push_back(run.report.*stage);
    report.*stage = spread_of(seconds).median;
  }
  return report;
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

Contest hold_contest(const std::string &name, const Mesh &mesh, const Parameters &parameters, int rounds) {
  const Rounds all = take_turns(mesh, parameters, rounds);
  Contest contest{};
  contest.name = name;
  contest.points_in = static_cast<std::int64_t>(mesh.points.size());
  contest.tets_in = static_cast<std::int64_t>(mesh.tets.size());
  contest.parameters = parameters;
  contest.rounds = rounds;
  contest.tetlod = side_of(mesh, all.ours);
  contest.peer = side_of(mesh, all.theirs);
  contest.ratio = ratio_of(all);
  contest.report = report_of(all.ours);
  return contest;
}

}  // namespace bench
