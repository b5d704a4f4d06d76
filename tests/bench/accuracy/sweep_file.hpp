// Sweeps as JSON: what the table and the plot are made from, at once or later.
#pragma once

#include "sweep.hpp"

namespace bench {

// Both throw std::runtime_error.
void write_sweeps(const std::string &path, const std::vector<Sweep> &sweeps, const SweepOptions &options);
std::vector<Sweep> read_sweeps(const std::string &path);

}  // namespace bench
