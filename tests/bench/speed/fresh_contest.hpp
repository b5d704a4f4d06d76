// tetlod and its peer on one mesh, in turns, each run in a process of its own.
#pragma once

#include <string>
#include <vector>

#include "run_tetlod.hpp"
#include "spread.hpp"

namespace bench {

struct FreshRuns {
  std::int32_t preset;
  std::int64_t threads;
  Spread wall;  // seconds
};

struct FreshContest {
  std::string set;
  double target;  // part of the tets that is kept
  std::int64_t tets_in;
  Spread peer;  // wall seconds
  std::vector<FreshRuns> runs;
};

// The presets fast and accurate with each of these numbers of threads. The peer collapses to the number of tets that
// `fast` reached.
FreshContest hold_fresh_contest(const std::string &set, const Mesh &mesh, double target,
                                const std::vector<std::int64_t> &threads, int rounds);

}  // namespace bench
