// Writing the result.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "output_file.hpp"
#include "quiet_vtk.hpp"

namespace cli {

// Throws Failure where the format would lose an array or its name.
void check_arrays(const std::string &path, vtkUnstructuredGrid &grid);

// As .vtu or .vtk, by the path's ending. Throws Failure.
void write_grid(const OutputFile &file, vtkUnstructuredGrid *grid, VtkMessages &messages,
                std::vector<std::string> &notes);

}  // namespace cli
