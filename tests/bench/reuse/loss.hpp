// What warm starts lose, over many ways in which values change: their RMS error over that of runs without.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench_mesh.hpp"

namespace bench {

using NamedMesh = std::pair<std::string, Mesh>;

// Prints a table with a row for each warm-start, over all meshes, presets and changes, and what lost most. A tenth of
// the tets is kept; two threads.
void measure_loss(const std::vector<NamedMesh> &meshes, const std::vector<std::string> &presets);

}  // namespace bench
