// Past the paper: a small mesh comes out by chance, so that there are several attempts, of which the best is kept. They
// differ in what the boundary's planes weigh where edges collapse.
#pragma once
#include <algorithm>
#include <cmath>
#include <iterator>

#include "budget.hpp"
#include "portable_math.hpp"
#include "refine.hpp"
#include "status.hpp"

namespace tetlod {

struct Attempt {
  TetMesh mesh;
  Report report;
  double score;  ///< the less, the better
};

/// Of the further attempts, what planes weigh of what they do usually. All take no longer than one on a mesh of so many
/// tets, about. There are none for a host whose time counts: what comes out must not depend on the clock.
inline Span<const double> weights_of_attempts(const Budget &budget, const Options &options, const Report &report) {
  static constexpr double weights[] = {0.55, 1.8, 0.3, 3.3, 0.15, 6};
  constexpr std::int64_t tets_of_all = 30000;
  const bool time_counts = options.effort != effort_accurate || options.time_limit > 0 || options.warm_start > 0;
  if (time_counts || options.max_error > 0 || keeps_all(budget, report)) return {};
  return {weights, std::min(std::size(weights), std::size_t(tets_of_all / report.sound_tets()))};
}

/// attempt(), which may better what there is. False: a memory limit refused it, and what there is serves. Where the
/// host's refused it, and something kept of earlier runs could go first, that is thrown on, and all is done again
/// without.
template <class Try>
bool attempt_in_memory(Job &job, const Try &attempt) {
  try {
    attempt();
    return true;
  } catch (const Error &error) {
    if (error.status() != Status::memory_limit || (!job.makes_do && job.memory.is_short())) throw;
    if (job.log) job.log(1, text("an attempt at a better mesh is left out: %s", error.what()).c_str());
    return false;
  }
}

/// The error counts, as a part of the range, and a little what planes that weigh less cost: the boundary's distance,
/// and vertices outside of it. By experience.
inline double score_of(const RefineReport &refined, double range, const Report &report) {
  constexpr double usual_error = 0.0002, usual_deviation = 0.002, usual_outside = 0.05;
  const double error = range > 0 ? std::sqrt(refined.mean_square) / range : 0;
  const double of_outside = root(refined.outside + usual_outside, 5);
  return (error + usual_error) * root(report.max_deviation + usual_deviation, 5) * of_outside * std::sqrt(of_outside);
}

}  // namespace tetlod
