// One simplification by the library, through its C ABI.
#pragma once

#include "bench_mesh.hpp"
#include "tetlod.h"

namespace bench {

struct Parameters {
  double rho, sigma;
  std::int64_t threads;
};

struct TetlodRun {
  double seconds;  // of the wall clock, from tetlod_create to the views of the result
  tetlod_run_report report;
  Mesh result;
};

// With the paper's preset. Throws std::runtime_error with the library's message.
TetlodRun run_tetlod(const Mesh &mesh, const Parameters &parameters);

}  // namespace bench
