// tetlod and its peer on one mesh, in turns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "field_error.hpp"
#include "run_tetlod.hpp"
#include "spread.hpp"

namespace bench {

struct Side {
  std::int64_t tets_out;  // of the last round
  Spread wall, cpu;       // seconds
  Spread rms;             // the peer draws random numbers, so its result is another each round
  FieldError error;       // of the last round
};

struct Contest {
  std::string name;
  std::int64_t points_in, tets_in;
  Parameters parameters;
  int rounds;
  Side tetlod;
  std::optional<Side> peer;          // none: the mesh is beyond the size at which the peer is waited for
  Spread wall_speedup, cpu_speedup;  // the peer's seconds over tetlod's of the same round
  StageSeconds stage_cpu;            // medians
  tetlod_run_report report;          // counts of the last round, seconds of each stage the medians
};

// The peer collapses to the number of tets that tetlod reached. Who is first changes from round to round.
Contest hold_contest(const std::string &name, const Mesh &mesh, const Parameters &parameters, int rounds,
                     bool with_peer);

}  // namespace bench
