#include "contest.hpp"

#include "mesh_shape.hpp"
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

Rounds take_turns(const Mesh &mesh, const Parameters &parameters, int rounds, bool with_peer) {
  Rounds all;
  const std::int64_t goal = warm_up(mesh, parameters);
  std::optional<Peer> peer;
  if (with_peer) peer.emplace(mesh);
  for (int round = 0; round < rounds; round++) {
    const bool peer_first = round % 2 == 1;
    if (peer && peer_first) all.theirs.push_back(peer->run(goal));
    all.ours.push_back(run_tetlod(mesh, parameters));
    if (peer && !peer_first) all.theirs.push_back(peer->run(goal));
  }
  return all;
}

// `random`: every round has a result of its own.
template <class Run>
Side side_of(const Mesh &mesh, const std::vector<Run> &runs, bool random) {
  std::vector<double> rms;
  FieldError error{};
  for (std::size_t i = random ? 0 : runs.size() - 1; i < runs.size(); i++) {
    error = measure_field_error(mesh, runs[i].result, shape_of(runs[i].result).boundary);
    rms.push_back(error.rms);
  }
  return {static_cast<std::int64_t>(runs.back().result.tets.size()),
          spread_of(runs, [](const Run &run) { return run.cost.wall; }),
          spread_of(runs, [](const Run &run) { return run.cost.cpu; }), spread_of(rms), error};
}

Spread speedup_of(const Rounds &all, double Cost::*seconds) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < all.theirs.size(); i++) {
    ratios.push_back(all.theirs[i].cost.*seconds / all.ours[i].cost.*seconds);
  }
  return spread_of(ratios);
}

// The last report, with the median over the rounds for each stage.
tetlod_run_report report_of(const std::vector<TetlodRun> &runs) {
  tetlod_run_report report = runs.back().report;
  for (const auto stage :
       {&tetlod_run_report::seconds_prepare, &tetlod_run_report::seconds_boundary, &tetlod_run_report::seconds_decimate,
        &tetlod_run_report::seconds_sample, &tetlod_run_report::seconds_cull, &tetlod_run_report::seconds_remesh,
        &tetlod_run_report::seconds_values, &tetlod_run_report::seconds_total}) {
    report.*stage = spread_of(runs, [stage](const TetlodRun &run) { return run.report.*stage; }).median;
  }
  return report;
}

StageSeconds stages_of(const std::vector<TetlodRun> &runs) {
  StageSeconds medians{};
  for (std::size_t stage = 0; stage < kStages; stage++) {
    medians[stage] = spread_of(runs, [stage](const TetlodRun &run) { return run.stage_cpu[stage]; }).median;
  }
  return medians;
}

}  // namespace

Contest hold_contest(const std::string &name, const Mesh &mesh, const Parameters &parameters, int rounds,
                     bool with_peer) {
  const Rounds all = take_turns(mesh, parameters, rounds, with_peer);
  Contest contest{};
  contest.name = name;
  contest.points_in = static_cast<std::int64_t>(mesh.points.size());
  contest.tets_in = static_cast<std::int64_t>(mesh.tets.size());
  contest.parameters = parameters;
  contest.rounds = rounds;
  contest.tetlod = side_of(mesh, all.ours, false);
  contest.report = report_of(all.ours);
  contest.stage_cpu = stages_of(all.ours);
  if (!with_peer) return contest;
  contest.peer = side_of(mesh, all.theirs, true);
  contest.wall_speedup = speedup_of(all, &Cost::wall);
  contest.cpu_speedup = speedup_of(all, &Cost::cpu);
  return contest;
}

}  // namespace bench
