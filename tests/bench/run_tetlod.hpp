// One simplification by the library, through its C ABI.
#pragma once

#include "bench_mesh.hpp"
#include "stopwatch.hpp"
#include "tetlod.h"

namespace bench {

struct Parameters {
  std::int32_t preset = TETLOD_PRESET_PAPER;
  double rho = 0.01, sigma = 0.1;  // of the preset paper
  double target = 0.1;             // part of the tets that the other presets keep
  double max_error = 0;            // TETLOD_OPT_MAX_ERROR of the other presets
  std::int64_t threads = 1;
};

// "paper", "fast" or "accurate".
const char *preset_name(std::int32_t preset);

constexpr std::size_t kStages = 7;
constexpr std::size_t kRemeshStage = 5;

// Of the processors, for each stage that tetlod_stage_name names; the worker's are remeshing's.
using StageSeconds = std::array<double, kStages>;

struct TetlodRun {
  Cost cost;  // from tetlod_create to the views of the result, and tetlod_destroy's share of the processors
  StageSeconds stage_cpu;
  tetlod_run_report report;
  Mesh result;
  std::vector<Triangle> boundary;  // of the result
};

// Throws std::runtime_error with the library's message.
TetlodRun run_tetlod(const Mesh &mesh, const Parameters &parameters);

}  // namespace bench
