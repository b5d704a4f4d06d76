// Reading a mesh file.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "quiet_vtk.hpp"

namespace cli {

// .vtu, .vtk or .pvtu. Throws Failure.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string &path, VtkMessages &messages,
                                               std::vector<std::string> &notes);

}  // namespace cli
