// Both contestants on one mesh, in turns.
#pragma once

#include <string>
#include <vector>

#include "field_error.hpp"
#include "run_tetlod.hpp"

namespace bench {

struct Spread {
  double median, least, most;
};

Spread spread_of(std::vector<double> values);

struct Side {
  std::int64_t tets_out;  // of the last round
  Spread seconds;
  Spread rms;        // the peer draws random numbers, so its result is another each round
  FieldError error;  // of the last round
};

struct Contest {
  std::string name;
  std::int64_t points_in, tets_in;
  Parameters parameters;
  int rounds;
  Side tetlod, peer;
  Spread ratio;              // of the seconds, tetlod's over the peer's of the same round
  tetlod_run_report report;  // counts of the last round, seconds of each stage the medians
};

// The peer collapses to the number of tets that tetlod reached. Who is first changes from round to round.
Contest hold_contest(const std::string &name, const Mesh &mesh, const Parameters &parameters, int rounds);

}  // namespace bench
