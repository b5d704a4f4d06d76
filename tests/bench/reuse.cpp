// What a context takes over from its earlier runs is worth: new values on the same mesh, levels of detail, and further
// fields that are moved to a result.
//
//     tetlod_reuse FILE [PRESET...]        paper, fast, accurate
//
// Seconds are the library's own (tetlod_run_report), those of the worker process included. Every reused result is
// compared with that of a context of its own; a warm start has other bytes, and its error is compared.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench_context.hpp"
#include "bench_mesh.hpp"
#include "stopwatch.hpp"
#include "tetlod.h"

namespace {

using bench::check;
using bench::Context;

Context make_context(const bench::Mesh &mesh) {
  Context context = bench::make_context();
  bench::submit(context.get(), mesh);
  return context;
}

// How much is kept: a part of the tets, or with the paper's preset of the boundary's edges.
void set_level(tetlod_context *context, const std::string &preset, double part) {
  if (preset == "paper") {
    check(tetlod_set_preset(context, TETLOD_PRESET_PAPER), context);
    check(tetlod_set_sigma(context, part), context);
    return;
  }
  check(tetlod_set_preset(context, preset == "fast" ? TETLOD_PRESET_FAST : TETLOD_PRESET_ACCURATE), context);
  check(tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, part), context);
}

tetlod_run_report run(tetlod_context *context) {
  check(tetlod_run(context), context);
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  check(tetlod_fetch_report(context, &report), context);
  return report;
}

// The same result by a context that has had no run; its seconds.
double fresh_seconds(const bench::Mesh &mesh, const std::string &preset, double part, const tetlod_run_report &reused) {
  const Context context = make_context(mesh);
  set_level(context.get(), preset, part);
  const tetlod_run_report report = run(context.get());
  if (report.hash != reused.hash) throw std::runtime_error("a reused run gave other bytes");
  return report.seconds_total;
}

// As a front that moves changes them.
void change_values(bench::Mesh &mesh, int step) {
  const double range = bench::range_of(mesh.values);
  for (std::size_t v = 0; v < mesh.values.size(); v++)
    mesh.values[v] += 0.02 * range * std::sin(3 * mesh.points[v][0] + mesh.points[v][1] + step);
}

void measure_steps(bench::Mesh mesh, const std::string &preset) {
  const Context context = make_context(mesh);
  set_level(context.get(), preset, 0.1);
  run(context.get());
  for (int step = 1; step <= 3; step++) {
    change_values(mesh, step);
    const tetlod_run_report report = run(context.get());
    const double fresh = fresh_seconds(mesh, preset, 0.1, report);
    std::printf("%-9s new values: %.2f s, %.2f s without reuse: %.2f x\n", preset.c_str(), report.seconds_total, fresh,
                report.seconds_total / fresh);
  }
}

double rms_of(tetlod_context *context) {
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  check(tetlod_measure_error(context, 0, &error), context);
  return error.rms;
}

// change(mesh, step) gives the mesh its values of that step, in place: they are lent.
template <class Change>
void measure_warm_start(bench::Mesh mesh, const std::string &preset, const char *what, const Change &change) {
  constexpr double warm_start = 0.25;
  const Context context = make_context(mesh), fresh = make_context(mesh);
  for (const Context *of : {&context, &fresh}) set_level(of->get(), preset, 0.1);
  check(tetlod_set_real(context.get(), TETLOD_OPT_WARM_START, warm_start), context.get());
  double first = 0;
  for (int i = 0; i < 8; i++) {
    change(mesh, i);
    const tetlod_run_report warm = run(context.get()), without = run(fresh.get());
    if (i == 0) first = warm.seconds_total;
    std::printf(
        "%-9s warm start, %s, step %d: %.2f s, %.2f x the first run, %.2f x one without, %lld collapses taken over, "
        "RMS %.2f x\n",
        preset.c_str(), what, i, warm.seconds_total, warm.seconds_total / first,
        warm.seconds_total / without.seconds_total, static_cast<long long>(warm.reused_collapses),
        rms_of(context.get()) / rms_of(fresh.get()));
  }
}

void measure_warm_starts(const bench::Mesh &mesh, const std::string &preset) {
  const std::vector<double> at_first = mesh.values;
  const double range = bench::range_of(at_first);
  const auto [low, high] = std::minmax_element(mesh.points.begin(), mesh.points.end());  // by their x
  const double length = (*high)[0] - (*low)[0];
  measure_warm_start(mesh, preset, "a wave grows by 0.2 % of the range", [&](bench::Mesh &now, int step) {
    for (std::size_t v = 0; v < at_first.size(); v++)
      now.values[v] = at_first[v] + 0.002 * step * range * std::sin(6 * now.points[v][0] / length);
  });
  const bench::Mesh front = bench::make_front_mesh(1'000'000, 0.5);
  measure_warm_start(front, preset, "a front moves by 0.4 % of the box", [](bench::Mesh &now, int step) {
    const std::vector<double> moved = bench::make_front_mesh(1'000'000, 0.5 + 0.004 * step).values;
    std::copy(moved.begin(), moved.end(), now.values.begin());
  });
}

// The coarsest first: its decimation is that of the others, carried on.
void measure_levels(const bench::Mesh &mesh, const std::string &preset) {
  const Context context = make_context(mesh);
  double reused = 0, fresh = 0;
  for (double part : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    set_level(context.get(), preset, part);
    const tetlod_run_report report = run(context.get());
    reused += report.seconds_total;
    fresh += fresh_seconds(mesh, preset, part, report);
  }
  std::printf("%-9s levels 2, 5, 10, 20, 50 %%: %.2f s, %.2f s without reuse: %.2f x\n", preset.c_str(), reused, fresh,
              reused / fresh);
}

// Seconds of the processor that a transfer takes, the least of some, each long enough for the clock.
double seconds_of_transfer(tetlod_context *context, const tetlod_array &original, tetlod_array &simplified) {
  constexpr int rounds = 10, repeats = 20;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; round++) {
    const bench::Stopwatch watch;
    for (int i = 0; i < repeats; i++) check(tetlod_transfer(context, &original, &simplified), context);
    least = std::min(least, watch.cost().cpu / repeats);
  }
  return least;
}

void measure_transfer(const bench::Mesh &mesh, const std::string &preset) {
  const Context context = make_context(mesh);
  set_level(context.get(), preset, 0.1);
  check(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 1), context.get());
  run(context.get());
  std::int64_t points = 0;
  check(tetlod_fetch_counts(context.get(), &points, nullptr, nullptr), context.get());
  for (const std::int32_t components : {1, 3}) {
    const std::size_t width = std::size_t(components);
    const std::vector<double> values(width * mesh.points.size(), 1.0);
    std::vector<double> moved(width * std::size_t(points));
    const tetlod_array original = bench::lent(TETLOD_FLOAT64, mesh.points.size(), components, values.data());
    tetlod_array simplified = bench::lent(TETLOD_FLOAT64, std::size_t(points), components, moved.data());
    const bench::Stopwatch watch;
    check(tetlod_transfer(context.get(), &original, &simplified), context.get());
    const double first = watch.cost().cpu, later = seconds_of_transfer(context.get(), original, simplified);
    std::printf("%-9s transfer of %d components to %lld points: %.3f s, then %.1f ns a value\n", preset.c_str(),
                int(components), static_cast<long long>(points), first, 1e9 * later / double(moved.size()));
  }
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: tetlod_reuse FILE [PRESET...]\n");
    return 2;
  }
  try {
    const bench::Mesh mesh = bench::read_mesh(argv[1]);
    for (int i = 2; i < argc || i == 2; i++) {
      const std::string preset = argc > 2 ? argv[i] : "paper";
      measure_steps(mesh, preset);
      if (preset != "paper") measure_warm_starts(mesh, preset);
      measure_levels(mesh, preset);
      measure_transfer(mesh, preset);
    }
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "tetlod_reuse: %s\n", error.what());
    return 1;
  }
}
