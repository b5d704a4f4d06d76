// Writing the result.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "quiet_vtk.hpp"

namespace cli {

// As .vtu or .vtk, by the path's ending. Throws Failure.
void write_grid(const std::string &path, vtkUnstructuredGrid *grid, VtkMessages &messages,
                std::vector<std::string> &notes);

}  // namespace cli
