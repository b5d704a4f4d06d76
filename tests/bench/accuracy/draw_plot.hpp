// Error against size, a panel for each set, both axes logarithmic.
#pragma once

#include "sweep.hpp"

namespace bench {

// Throws std::runtime_error.
void draw_plot(const std::string &path, const std::vector<Sweep> &sweeps);

}  // namespace bench
