// Reading a mesh file.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "quiet_vtk.hpp"

namespace cli {

struct Original {
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::vector<std::string> parts;  // the files that a .pvtu names
};

// .vtu, .vtk or .pvtu. Throws Failure.
Original read_grid(const std::string &path, VtkMessages &messages, std::vector<std::string> &notes);

}  // namespace cli
