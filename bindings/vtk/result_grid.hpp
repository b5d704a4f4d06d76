// The library's result as a grid.
#pragma once

#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "carried_arrays.hpp"
#include "tetlod.hpp"

namespace tetlod_vtk {

// The arrays of the original that the result has, too.
struct OriginalArrays {
  vtkSmartPointer<vtkDataArray> points, steering;
  std::string name;                             // of the steering field
  vtkSmartPointer<vtkUnsignedCharArray> flags;  // may be null
  std::vector<CarriedArray> others;
  CellArrays of_cells;
};

// Fills the grid from the context's last result: points in double precision, in which their tets are known to be
// positive; the steering field keeps its name, is the active scalars, and keeps its type if it is a float and nothing
// bounds its error. Points at the places of flagged ones have their flags, others none.
void fill_result(const tetlod::Context &context, const OriginalArrays &arrays, vtkUnstructuredGrid &grid);

}  // namespace tetlod_vtk
