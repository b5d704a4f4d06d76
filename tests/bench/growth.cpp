#include "growth.hpp"

#include <cmath>

namespace bench {
namespace {

// The least of the rounds: other programs can only add to it.
double seconds_of_tetlod(const Contest &contest) { return contest.tetlod.seconds.least; }
double seconds_of_peer(const Contest &contest) { return contest.peer.seconds.least; }

// The slope of log(seconds) over log(tets).
double exponent_of(const std::vector<Contest> &sizes, double (*seconds)(const Contest &)) {
  const double n = double(sizes.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Contest &contest : sizes) {
    const double u = std::log(double(contest.tets_in)), v = std::log(seconds(contest));
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const double spread = n * xx - x * x;
  return spread > 0 ? (n * xy - x * y) / spread : 0;
}

// A leaf of the sampling tree as wide as so many cells, whatever their width.
Parameters scaled(const Parameters &first, double first_tets, double tets) {
  return {first.rho * std::cbrt(first_tets / tets), first.sigma, first.threads};
}

}  // namespace

Growth measure_growth(const std::vector<std::int64_t> &tets, double time, const Parameters &first, int rounds) {
  Growth growth{};
  for (const std::int64_t goal : tets) {
    const Mesh mesh = make_front_mesh(goal, time);
    const Parameters parameters = scaled(first, double(tets.front()), double(goal));
    growth.sizes.push_back(hold_contest("generated front", mesh, parameters, rounds));
  }
  growth.tetlod_exponent = exponent_of(growth.sizes, seconds_of_tetlod);
  growth.peer_exponent = exponent_of(growth.sizes, seconds_of_peer);
  return growth;
}

}  // namespace bench
