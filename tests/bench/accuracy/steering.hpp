// What a second field that steers costs the first, and gains itself.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "field_error.hpp"

namespace bench {

struct SteeringOptions {
  double target = 0.1;  // part of the tets
  std::vector<double> weights{0.5, 1, 2};
  std::int64_t threads = 1;
};

struct Steering {
  std::string second;  // what it is
  std::string weight;  // "0": it rides along; "alone": it steers, and the first rides along
  FieldError of_first, of_second;
  double kept;  // part of the tets
  double cpu;   // seconds
};

// With the preset accurate. The second field is the length of the first's gradient, then a front that has nothing to do
// with the first.
std::vector<Steering> measure_steering(const Mesh &mesh, const SteeringOptions &options);

// A table in Markdown.
void write_steering_head(std::FILE *to);
void write_steering(std::FILE *to, const std::string &set, const Steering &steering);

}  // namespace bench
