#include "times.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <vector>

#include "changes.hpp"
#include "level_run.hpp"
#include "spread.hpp"
#include "stopwatch.hpp"

namespace bench {
namespace {

// The same result by a context that has had no run; its seconds.
double fresh_seconds(const Mesh &mesh, const std::string &preset, double part, const tetlod_run_report &reused) {
  const Context context = context_of(mesh);
  set_level(context.get(), preset, part);
  const tetlod_run_report report = run(context.get());
  if (report.hash != reused.hash) throw std::runtime_error("a reused run gave other bytes");
  return report.seconds_total;
}

void print_ratios(const std::string &preset, const char *what, const std::vector<double> &ratios) {
  const Spread spread = spread_of(ratios);
  std::printf("%-9s %s: %.2f x the time without reuse (%.2f to %.2f)\n", preset.c_str(), what, spread.median,
              spread.least, spread.most);
  std::fflush(stdout);
}

// The coarsest first: its decimation is that of the others, carried on.
double ratio_of_levels(const Mesh &mesh, const std::string &preset) {
  const Context context = context_of(mesh);
  double reused = 0, fresh = 0;
  for (double part : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    set_level(context.get(), preset, part);
    const tetlod_run_report report = run(context.get());
    reused += report.seconds_total;
    fresh += fresh_seconds(mesh, preset, part, report);
  }
  return reused / fresh;
}

void measure_warm_start(const Mesh &mesh, const std::string &preset, const Change &change) {
  constexpr double warm_start = 0.25;
  ChangingMesh now(mesh, change);
  const Context context = context_of(now.mesh()), fresh = context_of(now.mesh());
  for (const Context *of : {&context, &fresh}) set_level(of->get(), preset, kLevel);
  check(tetlod_set_real(context.get(), TETLOD_OPT_WARM_START, warm_start), context.get());
  double first = 0;
  for (int step = 0; step < 8; step++) {
    now.go_to(step);
    const tetlod_run_report warm = run(context.get()), without = run(fresh.get());
    if (step == 0) first = warm.seconds_total;
    std::printf(
        "%-9s warm start, %s, step %d: %.2f s, %.2f x the first run, %.2f x one without, %lld collapses taken over, "
        "RMS %.2f x\n",
        preset.c_str(), change.name.c_str(), step, warm.seconds_total, warm.seconds_total / first,
        warm.seconds_total / without.seconds_total, static_cast<long long>(warm.reused_collapses),
        rms_of(context.get()) / rms_of(fresh.get()));
  }
}

Change slow_wave() { return growing_wave("a wave grows by 0.2 % of the range", 0.002); }

// In the unit cube, whose diagonal is the root of 3.
Change slow_front() {
  return {"a front moves by 0.4 % of the box", [](const Point &p, double, int step) {
            const double side = std::sqrt(3.0);
            return front_value({side * p[0], side * p[1], side * p[2]}, 0.5 + 0.004 * step);
          }};
}

// Seconds of the processor that a transfer takes, the least of some, each long enough for the clock.
double seconds_of_transfer(tetlod_context *context, const tetlod_array &original, tetlod_array &simplified) {
  constexpr int rounds = 10, repeats = 20;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; round++) {
    const Stopwatch watch;
    for (int i = 0; i < repeats; i++) check(tetlod_transfer(context, &original, &simplified), context);
    least = std::min(least, watch.cost().cpu / repeats);
  }
  return least;
}

}  // namespace

void measure_steps(const Mesh &mesh, const std::string &preset) {
  constexpr int steps = 5;
  ChangingMesh now(mesh, slow_wave());
  now.go_to(0);
  const Context context = context_of(now.mesh());
  set_level(context.get(), preset, kLevel);
  run(context.get());
  std::vector<double> ratios;
  for (int step = 1; step <= steps; step++) {
    now.go_to(step);
    const tetlod_run_report report = run(context.get());
    ratios.push_back(report.seconds_total / fresh_seconds(now.mesh(), preset, kLevel, report));
  }
  print_ratios(preset, "new values", ratios);
}

void measure_warm_starts(const Mesh &mesh, const std::string &preset) {
  measure_warm_start(mesh, preset, slow_wave());
  measure_warm_start(make_front_mesh(1'000'000, 0.5), preset, slow_front());
}

void measure_levels(const Mesh &mesh, const std::string &preset) {
  constexpr int rounds = 3;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; round++) ratios.push_back(ratio_of_levels(mesh, preset));
  print_ratios(preset, "levels 2, 5, 10, 20, 50 %", ratios);
}

void measure_transfer(const Mesh &mesh, const std::string &preset) {
  const Context context = context_of(mesh);
  set_level(context.get(), preset, kLevel);
  check(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 1), context.get());
  run(context.get());
  std::int64_t points = 0;
  check(tetlod_fetch_counts(context.get(), &points, nullptr, nullptr), context.get());
  for (const std::int32_t components : {1, 3}) {
    const std::size_t width = std::size_t(components);
    const std::vector<double> values(width * mesh.points.size(), 1.0);
    std::vector<double> moved(width * std::size_t(points));
    const tetlod_array original = lent(TETLOD_FLOAT64, mesh.points.size(), components, values.data());
    tetlod_array simplified = lent(TETLOD_FLOAT64, std::size_t(points), components, moved.data());
    const Stopwatch watch;
    check(tetlod_transfer(context.get(), &original, &simplified), context.get());
    const double first = watch.cost().cpu, later = seconds_of_transfer(context.get(), original, simplified);
    std::printf("%-9s transfer of %d components to %lld points: %.3f s, then %.1f ns a value\n", preset.c_str(),
                int(components), static_cast<long long>(points), first, 1e9 * later / double(moved.size()));
  }
}

}  // namespace bench
