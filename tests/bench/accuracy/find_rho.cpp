#include "find_rho.hpp"

#include <cmath>
#include <limits>

namespace bench {
namespace {

constexpr int kMostRuns = 8;
constexpr double kNearEnough = 0.03;  // of the tets asked for
constexpr double kLeastRho = 1e-4, kMostRho = 1;

}  // namespace

Parameters paper_at(const Mesh &mesh, std::int64_t tets, std::int64_t threads) {
  Parameters trial, best;
  trial.preset = best.preset = TETLOD_PRESET_PAPER;
  trial.threads = threads;
  trial.sigma = std::sqrt(double(tets) / double(mesh.tets.size()));
  double least_off = std::numeric_limits<double>::infinity(), low = kLeastRho, high = kMostRho;
  for (int run = 0; run < kMostRuns && least_off > kNearEnough; run++) {
    trial.rho = std::sqrt(low * high);
    const double got = double(run_tetlod(mesh, trial).report.tets_out);
    const double off = std::fabs(got / double(tets) - 1);
    if (off < least_off) {
      least_off = off;
      best = trial;
    }
    (got > double(tets) ? low : high) = trial.rho;
  }
  return best;
}

}  // namespace bench
