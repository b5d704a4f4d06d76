// Vectors steer by their magnitude, as VTK colours by it.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace cli {

// The name of the point data that steers: `field`, or, where that names vectors, or there is none and the grid has
// vectors alone, their magnitude, which the grid gets as point data; a note says so. Else `field` as it is.
std::string steering_name(const std::string &field, vtkUnstructuredGrid &grid, std::vector<std::string> &notes);

}  // namespace cli
