// Writing the result.
#pragma once

#include <string>
#include <vector>

#include "quiet_vtk.hpp"
#include "simplify.hpp"

namespace cli {

// The context's result as .vtu or .vtk, by the path's ending; the field keeps its name and its type, the
// arrays that ride along theirs. Points are in
// double precision, in which their tets are known to be positive. Throws Failure.
void write_grid(const std::string &path, const tetlod_context *context, const TetMesh &original, VtkMessages &messages,
                std::vector<std::string> &notes);

}  // namespace cli
