// What the library borrows of an input grid during an execution.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "grid_cells.hpp"
#include "lent_array.hpp"
#include "result_grid.hpp"
#include "tetlod.hpp"

class vtkInformation;

namespace tetlod_vtk {

struct Original {
  vtkSmartPointer<vtkUnstructuredGrid> grid;  // the input, or one with its polyhedra cut
  LentArray points;                           // without a keeper: the grid's are separate x, y and z
  LentArray values;
  Tets tets;
  bool is_split = false;  // tets are not the input's cells
  OriginalArrays arrays;
};

// A point array that steers beside the first.
struct WeightedArray {
  std::string name;
  double weight;
};

// steering and flags are what SetInputArrayToProcess was told of input arrays 0 and 1, null where it was not. Throws
// std::runtime_error for an array that is not there and for cells that cannot be split; notes tell what is left out.
Original original_of(vtkUnstructuredGrid *input, vtkInformation *steering, const std::vector<WeightedArray> &further,
                     vtkInformation *flags, std::vector<std::string> &notes);

// Throws tetlod::Error. The original must live until the context is cleared.
void submit(tetlod::Context &context, const Original &original);

// Throws tetlod::Error, which says so where tets are not numbered as the grid's cells.
void run(tetlod::Context &context, const Original &original);

}  // namespace tetlod_vtk
