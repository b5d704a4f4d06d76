// What max-error and target-ratio promise, looked at with the judge of the benchmarks.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "bench_mesh.hpp"

namespace bench {

struct PromiseOptions {
  std::vector<double> bounds{0.1, 0.03, 0.01, 0.003};
  std::vector<double> targets{0.5, 0.2, 0.1, 0.05, 0.02};
  std::int64_t threads = 1;
};

struct Promise {
  bool is_bound;        // of the error, else a size
  double asked;         // part of the range, or of the tets
  bool is_kept;         // error at most as asked; size within 3 %
  double kept;          // part of the tets
  double error;         // the largest at the original's vertices, those outside included
  double reported;      // the same as the library reports it; 0 where it was not asked for
  double cpu;           // seconds
  std::string failure;  // of the run; empty: it succeeded
};

// With the preset accurate.
std::vector<Promise> measure_promises(const Mesh &mesh, const PromiseOptions &options);

// A table in Markdown.
void write_promise_head(std::FILE *to);
void write_promise(std::FILE *to, const std::string &set, const Promise &promise);

}  // namespace bench
