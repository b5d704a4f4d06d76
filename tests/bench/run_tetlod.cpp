#include "run_tetlod.hpp"

#include "bench_context.hpp"

namespace bench {
namespace {

Context context_for(const Parameters &parameters) {
  Context context = make_context();
  tetlod_context *const made = context.get();
  check(tetlod_set_preset(made, parameters.preset), made);
  if (parameters.preset == TETLOD_PRESET_PAPER) {
    check(tetlod_set_rho(made, parameters.rho), made);
    check(tetlod_set_sigma(made, parameters.sigma), made);
  } else {
    check(tetlod_set_real(made, TETLOD_OPT_TARGET_RATIO, parameters.target), made);
    check(tetlod_set_real(made, TETLOD_OPT_MAX_ERROR, parameters.max_error), made);
  }
  check(tetlod_set_int(made, TETLOD_OPT_THREADS, parameters.threads), made);
  return context;
}

// The library says by its progress callback when a stage begins.
class StageClock {
 public:
  static std::int32_t tick(void *clock, std::int32_t stage, double) {
    static_cast<StageClock *>(clock)->enter(std::size_t(stage));
    return 0;
  }
  StageSeconds end() {
    enter(stage_);
    return seconds_;
  }

 private:
  void enter(std::size_t stage) {
    const double now = cpu_seconds_of(RUSAGE_SELF);
    seconds_[stage_] += now - last_;
    last_ = now;
    stage_ = stage;
  }

  StageSeconds seconds_{};
  std::size_t stage_ = 0;
  double last_ = cpu_seconds_of(RUSAGE_SELF);
};

struct Views {
  tetlod_array points, tets, values;
};

Views view(const tetlod_context *context) {
  return {viewed(tetlod_view_points, context), viewed(tetlod_view_tets, context), viewed(tetlod_view_scalars, context)};
}

std::vector<Triangle> fetch_boundary(tetlod_context *context) {
  std::int64_t triangles = 0;
  check(tetlod_fetch_counts(context, nullptr, nullptr, &triangles), context);
  std::vector<Triangle> boundary(static_cast<std::size_t>(triangles));
  tetlod_array array = lent(TETLOD_INT32, boundary.size(), 3, boundary.data());
  check(tetlod_fetch_boundary(context, 0, &array), context);
  return boundary;
}

}  // namespace

const char *preset_name(std::int32_t preset) {
  switch (preset) {
    case TETLOD_PRESET_FAST: return "fast";
    case TETLOD_PRESET_ACCURATE: return "accurate";
    default: return "paper";
  }
}

TetlodRun run_tetlod(const Mesh &mesh, const Parameters &parameters) {
  TetlodRun run{};
  const Stopwatch watch;
  Context context = context_for(parameters);
  submit(context.get(), mesh);
  StageClock clock;
  check(tetlod_set_progress(context.get(), StageClock::tick, &clock), context.get());
  const double worker_begin = cpu_seconds_of(RUSAGE_CHILDREN);
  check(tetlod_run(context.get()), context.get());
  run.stage_cpu = clock.end();
  const Views views = view(context.get());
  run.cost = watch.cost();
  run.report.struct_size = sizeof run.report;
  check(tetlod_fetch_report(context.get(), &run.report), context.get());
  run.result = {copied<Point>(views.points), copied<Tet>(views.tets), copied<double>(views.values)};
  run.boundary = fetch_boundary(context.get());
  const Stopwatch ending;  // the worker's seconds come to light once it is waited for
  context.reset();
  run.cost.cpu += ending.cost().cpu;
  run.stage_cpu[kRemeshStage] += cpu_seconds_of(RUSAGE_CHILDREN) - worker_begin;
  return run;
}

}  // namespace bench
