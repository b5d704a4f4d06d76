#include "growth.hpp"

#include <cmath>
#include <utility>

namespace bench {
namespace {

// (tets, the least seconds of the rounds: other programs can only add to them)
using Curve = std::vector<std::pair<double, double>>;

// The slope of log(seconds) over log(tets).
double exponent_of(const Curve &curve) {
  const double n = double(curve.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto &[tets, seconds] : curve) {
    const double u = std::log(tets), v = std::log(seconds);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const double spread = n * xx - x * x;
  return spread > 0 ? (n * xy - x * y) / spread : 0;
}

}  // namespace

Growth measure_growth(const GrowthOptions &options, const Parameters &parameters, int rounds) {
  Growth growth{};
  Curve ours, theirs;
  for (const std::int64_t goal : options.tets) {
    const Mesh mesh = make_front_mesh(goal, options.time);
    growth.sizes.push_back(hold_contest("generated front", mesh, parameters, rounds, goal <= options.peer_limit));
    const Contest &contest = growth.sizes.back();
    ours.emplace_back(double(contest.tets_in), contest.tetlod.cpu.least);
    if (contest.peer) theirs.emplace_back(double(contest.tets_in), contest.peer->cpu.least);
  }
  growth.tetlod_exponent = exponent_of(ours);
  growth.peer_exponent = exponent_of(theirs);
  return growth;
}

double bytes_in_all(const Contest &contest) {
  const double arrays =
      double(contest.points_in) * (sizeof(Point) + sizeof(double)) + double(contest.tets_in) * sizeof(Tet);
  return arrays + double(contest.report.peak_bytes) + double(contest.report.worker_peak_bytes);
}

}  // namespace bench
