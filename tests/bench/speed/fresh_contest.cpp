#include "fresh_contest.hpp"

#include "new_process.hpp"
#include "run_peer.hpp"

namespace bench {
namespace {

struct Outcome {
  double wall;
  std::int64_t tets;
};

Outcome outcome_of(const Mesh &mesh, std::int32_t preset, double target, std::int64_t threads) {
  Parameters parameters;
  parameters.preset = preset;
  parameters.target = target;
  parameters.threads = threads;
  return in_new_process([&]() -> Outcome {
    const TetlodRun run = run_tetlod(mesh, parameters);
    return {run.cost.wall, run.report.tets_out};
  });
}

double peer_seconds(const Mesh &mesh, std::int64_t tets) {
  return in_new_process([&] { return Peer(mesh).run(tets).cost.wall; });
}

}  // namespace

FreshContest hold_fresh_contest(const std::string &set, const Mesh &mesh, double target,
                                const std::vector<std::int64_t> &threads, int rounds) {
  FreshContest contest{set, target, static_cast<std::int64_t>(mesh.tets.size()), {}, {}};
  for (const std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    for (const std::int64_t n : threads) contest.runs.push_back({preset, n, {}});
  }
  std::vector<std::vector<double>> seconds(contest.runs.size());
  std::vector<double> of_peer;
  const std::int64_t goal = outcome_of(mesh, TETLOD_PRESET_FAST, target, threads.front()).tets;
  for (int round = 0; round < rounds; round++) {
    of_peer.push_back(peer_seconds(mesh, goal));
    for (std::size_t i = 0; i < contest.runs.size(); i++) {
      seconds[i].push_back(outcome_of(mesh, contest.runs[i].preset, target, contest.runs[i].threads).wall);
    }
  }
  contest.peer = spread_of(of_peer);
  for (std::size_t i = 0; i < contest.runs.size(); i++) contest.runs[i].wall = spread_of(seconds[i]);
  return contest;
}

}  // namespace bench
