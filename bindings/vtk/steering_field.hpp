// Which of a grid's arrays steers the simplification.
#pragma once

#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <string>

namespace tetlod_vtk {

// The point array of that name; without a name the active scalars, else the first array of one component. Throws
// std::runtime_error, which names the arrays that there are.
vtkDataArray *steering_field(vtkUnstructuredGrid &grid, const std::string &name);

}  // namespace tetlod_vtk
