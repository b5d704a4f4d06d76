#include "floor_duel.hpp"

#include <cstdio>

#include "face_pass.hpp"
#include "run_rival.hpp"

namespace bench {
namespace {

std::string described(const Parameters &p) {
  char text[96];
  std::snprintf(text, sizeof text, "preset %s at %.2f %%, %d thread%s", preset_name(p.preset), 100 * p.target,
                int(p.threads), p.threads == 1 ? "" : "s");
  return text;
}

}  // namespace

std::vector<Duel> hold_floor_duels(const std::string &set, const Mesh &mesh, const Parameters &parameters, int rounds) {
  const TetlodRun run = run_tetlod(mesh, parameters);
  const SurfaceOnDisk file(run.result.points.data(), run.result.points.size(), run.boundary.data(),
                           run.boundary.size());
  FacePass pass(mesh.tets, parameters.threads);
  const std::string task = described(parameters);
  const auto ours = [&] { return run_tetlod(mesh, parameters).cost; };
  return {hold_duel(task, set, "bare TetGen", rounds, ours,
                    [&] { return run_rival("bench_tetgen", "'" + file.path() + "'", "libtet1.5-dev"); }),
          hold_duel(task, set, "one pass over the faces", rounds, ours, [&] { return pass.run(); })};
}

}  // namespace bench
