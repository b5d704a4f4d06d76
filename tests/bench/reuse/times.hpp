// What a context takes over from its earlier runs is worth in time: new values on the same mesh, levels of detail, and
// further fields that are moved to a result. Seconds are the library's own (tetlod_run_report), those of the worker
// process included. Each prints lines.
#pragma once

#include <string>

#include "bench_mesh.hpp"

namespace bench {

// Of the same bytes as a context of its own gives, which is checked.
void measure_steps(const Mesh &mesh, const std::string &preset);
void measure_levels(const Mesh &mesh, const std::string &preset);

// Of other bytes, whose error is compared: on the mesh, and on a front of a million tets.
void measure_warm_starts(const Mesh &mesh, const std::string &preset);

void measure_transfer(const Mesh &mesh, const std::string &preset);

}  // namespace bench
