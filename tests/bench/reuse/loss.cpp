#include "loss.hpp"

#include <algorithm>
#include <cstdio>

#include "changes.hpp"
#include "level_run.hpp"

namespace bench {
namespace {

constexpr int kSteps = 4;  // after the first, which nothing is before

struct Step {
  std::string name;
  double warm_start;
  bool is_warm;
  double rms, seconds;  // over those of a run without
};

Context tenth_of(const Mesh &mesh, const std::string &preset, double warm_start) {
  Context context = context_of(mesh);
  set_level(context.get(), preset, kLevel);
  check(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 2), context.get());
  check(tetlod_set_real(context.get(), TETLOD_OPT_WARM_START, warm_start), context.get());
  return context;
}

void take_steps(const NamedMesh &mesh, const std::string &preset, const Change &change, double warm_start,
                std::vector<Step> &steps) {
  ChangingMesh now(mesh.second, change);
  now.go_to(0);
  const Context warm = tenth_of(now.mesh(), preset, warm_start), without = tenth_of(now.mesh(), preset, 0);
  for (const Context *context : {&warm, &without}) run(context->get());
  for (int step = 1; step <= kSteps; step++) {
    now.go_to(step);
    const tetlod_run_report report = run(warm.get()), other = run(without.get());
    steps.push_back({mesh.first + ", " + preset + ", " + change.name + ", step " + std::to_string(step), warm_start,
                     report.reused_collapses > 0, rms_of(warm.get()) / rms_of(without.get()),
                     report.seconds_total / other.seconds_total});
  }
}

// Of those at such a part of them, from the least on.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::ptrdiff_t(part * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void print_row(double warm_start, std::vector<Step> steps) {
  const auto cold = std::stable_partition(steps.begin(), steps.end(), [](const Step &step) { return step.is_warm; });
  std::vector<double> rms, warm_seconds, cold_seconds;
  for (auto step = steps.begin(); step != cold; ++step) {
    rms.push_back(step->rms);
    warm_seconds.push_back(step->seconds);
  }
  for (auto step = cold; step != steps.end(); ++step) cold_seconds.push_back(step->seconds);
  const auto above = std::count_if(rms.begin(), rms.end(), [&](double x) { return x > 1 + warm_start; });
  std::printf("| %.2f | %zu of %zu | %.2f | %.2f | %.2f | %td | %.2f | %.2f |\n", warm_start, rms.size(), steps.size(),
              quantile(rms, 0.5), quantile(rms, 0.95), quantile(rms, 1), above, quantile(warm_seconds, 0.5),
              quantile(cold_seconds, 0.5));
  std::fflush(stdout);
}

void print_worst(std::vector<Step> steps) {
  constexpr std::size_t most = 6;
  std::sort(steps.begin(), steps.end(), [](const Step &a, const Step &b) { return a.rms > b.rms; });
  std::printf("\nWhat lost most:\n");
  for (std::size_t i = 0; i < std::min(most, steps.size()); i++)
    std::printf("- %.2f, with %.2f: %s\n", steps[i].rms, steps[i].warm_start, steps[i].name.c_str());
}

}  // namespace

void measure_loss(const std::vector<NamedMesh> &meshes, const std::vector<std::string> &presets) {
  std::printf(
      "| x | warm | median | 95 of 100 | largest | above 1 + x | time, warm | time, begun anew |\n"
      "|---|---|---|---|---|---|---|---|\n");
  std::vector<Step> all;
  for (const double warm_start : {0.12, 0.25, 0.5}) {
    std::vector<Step> steps;
    for (const NamedMesh &mesh : meshes)
      for (const std::string &preset : presets)
        for (const Change &change : all_changes()) take_steps(mesh, preset, change, warm_start, steps);
    print_row(warm_start, steps);
    all.insert(all.end(), steps.begin(), steps.end());
  }
  print_worst(all);
}

}  // namespace bench
