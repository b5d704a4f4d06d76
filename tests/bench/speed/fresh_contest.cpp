#include "fresh_contest.hpp"

#include "mesh_file.hpp"
#include "run_rival.hpp"

namespace bench {
namespace {

double seconds_of(const char *who, const MeshOnDisk &mesh, double target, std::int64_t threads) {
  const std::string arguments =
      "'" + mesh.path() + "' " + who + " " + std::to_string(target) + " " + std::to_string(threads);
  return run_rival("bench_contestant", arguments, "VTK").wall;
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
  const MeshOnDisk file(mesh, ".mesh");
  for (int round = 0; round < rounds; round++) {
    of_peer.push_back(seconds_of("peer", file, target, 1));
    for (std::size_t i = 0; i < contest.runs.size(); i++) {
      const FreshRuns &run = contest.runs[i];
      seconds[i].push_back(seconds_of(preset_name(run.preset), file, target, run.threads));
    }
  }
  contest.peer = spread_of(of_peer);
  for (std::size_t i = 0; i < contest.runs.size(); i++) contest.runs[i].wall = spread_of(seconds[i]);
  return contest;
}

}  // namespace bench
