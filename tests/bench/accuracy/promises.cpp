#include "promises.hpp"

#include <cmath>
#include <stdexcept>

#include "quality.hpp"
#include "run_tetlod.hpp"

namespace bench {
namespace {

constexpr double kSizeTolerance = 0.03;
constexpr double kRounding = 1e-9;  // between the library's arithmetic and the judge's

Parameters accurate(std::int64_t threads) {
  Parameters parameters;
  parameters.preset = TETLOD_PRESET_ACCURATE;
  parameters.threads = threads;
  return parameters;
}

Promise look_at(const Mesh &mesh, const Parameters &parameters, Promise promise) {
  try {
    const TetlodRun run = run_tetlod(mesh, parameters);
    promise.kept = double(run.result.tets.size()) / double(mesh.tets.size());
    promise.error = measure_field_error(mesh, run.result, shape_of(run.result).boundary).max_everywhere;
    promise.reported = run.report.max_error;
    promise.cpu = run.cost.cpu;
    promise.is_kept = promise.is_bound ? promise.error <= promise.asked + kRounding
                                       : std::fabs(promise.kept / promise.asked - 1) <= kSizeTolerance;
  } catch (const std::runtime_error &error) {
    promise.failure = error.what();
  }
  return promise;
}

}  // namespace

std::vector<Promise> measure_promises(const Mesh &mesh, const PromiseOptions &options) {
  std::vector<Promise> promises;
  for (const double bound : options.bounds) {
    Parameters parameters = accurate(options.threads);
    parameters.target = 0;
    parameters.max_error = bound;
    promises.push_back(look_at(mesh, parameters, {true, bound, false, 0, 0, 0, 0, ""}));
  }
  for (const double target : options.targets) {
    Parameters parameters = accurate(options.threads);
    parameters.target = target;
    promises.push_back(look_at(mesh, parameters, {false, target, false, 0, 0, 0, 0, ""}));
  }
  return promises;
}

void write_promise_head(std::FILE *to) {
  std::fputs(
      "| set | promise | kept | tets kept, % | largest error, % | as reported, % | CPU s |\n"
      "|---|---|---|---|---|---|---|\n",
      to);
}

void write_promise(std::FILE *to, const std::string &set, const Promise &p) {
  std::fprintf(to, "| %s | %s %g | %s | ", set.c_str(), p.is_bound ? "max-error" : "target-ratio", p.asked,
               p.is_kept ? "yes" : "**no**");
  if (p.failure.empty()) {
    std::fprintf(to, "%.3f | %.4f | %.4f | %.3f |\n", 100 * p.kept, 100 * p.error, 100 * p.reported, p.cpu);
  } else {
    std::fprintf(to, "%s | | | |\n", p.failure.c_str());
  }
  std::fflush(to);
}

}  // namespace bench
