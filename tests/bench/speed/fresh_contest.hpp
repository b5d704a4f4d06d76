// tetlod and its peer on one mesh, in turns, each run in a program of its own, where memory has yet to be handed out.
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

// The presets fast and accurate with each of these numbers of threads. All are to keep `target` of the tets, which
// tetlod meets by a thousandth.
FreshContest hold_fresh_contest(const std::string &set, const Mesh &mesh, double target,
                                const std::vector<std::int64_t> &threads, int rounds);

}  // namespace bench
