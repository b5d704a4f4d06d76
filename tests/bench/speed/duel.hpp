// A stage, or a whole run, against somebody else's program for the same task.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "spread.hpp"
#include "stopwatch.hpp"

namespace bench {

// Why a duel is not held: the rival is not there, or cannot do the task.
struct NoRival : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Duel {
  std::string task, set, rival;
  std::string skipped;  // why; empty: it was held
  Spread cpu, wall, rival_cpu, rival_wall;
  Spread cpu_speedup, wall_speedup;  // the rival's seconds over ours of the same round
};

// Rounds in turns; `ours` and `theirs` return what one took (Cost), `theirs` may throw NoRival.
template <class Ours, class Theirs>
Duel hold_duel(const std::string &task, const std::string &set, const std::string &rival, int rounds, const Ours &ours,
               const Theirs &theirs) {
  Duel duel{task, set, rival, "", {}, {}, {}, {}, {}, {}};
  struct Round {
    Cost ours, theirs;
  };
  std::vector<Round> all;
  try {
    for (int round = 0; round < rounds; round++) {
      const Cost rival_cost = theirs();
      all.push_back({ours(), rival_cost});
    }
  } catch (const NoRival &missing) {
    duel.skipped = missing.what();
    return duel;
  }
  duel.cpu = spread_of(all, [](const Round &r) { return r.ours.cpu; });
  duel.wall = spread_of(all, [](const Round &r) { return r.ours.wall; });
  duel.rival_cpu = spread_of(all, [](const Round &r) { return r.theirs.cpu; });
  duel.rival_wall = spread_of(all, [](const Round &r) { return r.theirs.wall; });
  duel.cpu_speedup = spread_of(all, [](const Round &r) { return r.theirs.cpu / r.ours.cpu; });
  duel.wall_speedup = spread_of(all, [](const Round &r) { return r.theirs.wall / r.ours.wall; });
  return duel;
}

}  // namespace bench
