// A judge from outside, a program that is asked about the same results: does it agree?
#pragma once

#include <string>

#include "sweep.hpp"

namespace bench {

// Writes both meshes to temporary files and runs `program ORIGINAL RESULT`, which prints one JSON object with rms, max,
// outside, rms_inner, hausdorff, volume and valid. The files: "TETMESH1", two int64 (points, tets), then coordinates
// and values in float64, corners in int32. Throws std::runtime_error.
Quality ask_judge(const std::string &program, const Mesh &original, const Mesh &result);

// One line on stderr: the two sides of each figure. rms_inner is at other random points, and may differ as such do.
void print_agreement(const std::string &set, const Entry &entry, const Quality &theirs);

}  // namespace bench
