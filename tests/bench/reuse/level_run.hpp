// Runs of one context after another, by preset and by how much is kept.
#pragma once

#include <string>

#include "bench_context.hpp"

namespace bench {

constexpr double kLevel = 0.1;  // that most is measured at

// The mesh must stay.
Context context_of(const Mesh &mesh);

// A part of the tets, or with the preset paper of the boundary's edges.
void set_level(tetlod_context *context, const std::string &preset, double part);

tetlod_run_report run(tetlod_context *context);

// Of the last result, over the range.
double rms_of(tetlod_context *context);

}  // namespace bench
