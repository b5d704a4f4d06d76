// The paper's field error [4], by code that none of those that are compared has a part in.
#pragma once

#include <vector>

#include "bench_mesh.hpp"

namespace bench {

// Errors as fractions of the range of the original's values; points outside the result are counted and left out.
struct FieldError {
  double rms, max, outside;                    // at the original's vertices
  double max_everywhere;                       // there, those outside compared at the nearest point of the boundary
  double rms_inner, max_inner, outside_inner;  // at a random point in each of the original's tets, always the same
};

// `boundary`: the result's.
FieldError measure_field_error(const Mesh &original, const Mesh &result, const std::vector<Triangle> &boundary);

}  // namespace bench
