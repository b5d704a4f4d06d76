// The arrays of a grid beside the steering field: they ride along, or steer, too.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

#include "grid_cells.hpp"
#include "lent_array.hpp"
#include "tetlod.hpp"

namespace tetlod_vtk {

// Of points.
struct CarriedArray {
  vtkSmartPointer<vtkDataArray> original;  // the grid's
  int attribute;                           // vtkDataSetAttributes::AttributeTypes that it is active as; -1: none
  LentArray reals;                         // what the library gets
  double weight = 0;                       // positive: it steers

  const char *name() const { return original->GetName(); }  // the library's, too
};

// Of cells: the library carries the numbers of the tets, once, and values are copied as they are.
struct CellArrays {
  struct One {
    vtkSmartPointer<vtkDataArray> original;  // the grid's
    int attribute;
  };
  std::vector<One> all;
  vtkSmartPointer<vtkDataArray> cells;  // as Tets has them
  LentArray numbers;                    // of the tets; without a keeper where there are no arrays
  std::string name_of_numbers;          // for the library: that of no array of points
};

// Throws tetlod::Error unless it is TETLOD_OK.
void require(tetlod_status status, const tetlod::Context &context);

// That name, or one like it that no array has.
std::string name_of_none(vtkDataSetAttributes &data, std::string name);

// All named arrays of numbers of points but the others, which steer or flag. They become means, so integers become
// doubles. Ghost marks and global numbers have no meaning any more. A note says which are left out: without a name, or
// of more than 64 components.
std::vector<CarriedArray> carried_arrays(vtkUnstructuredGrid &grid, const std::vector<vtkDataArray *> &others,
                                         std::vector<std::string> &notes);

// The same of cells, which keep their type.
CellArrays cell_arrays(vtkUnstructuredGrid &grid, const Tets &tets, std::vector<std::string> &notes);

// Gives the result's array the original's unit and names of components. What else VTK has noted of an array is of its
// values, such as their range; it depends on who asked for it before.
void describe_as(vtkDataArray &original, vtkDataArray &result);

// Of what steers, on a result: floats stay what they are, unless their rounding could pass a bound of the error.
int steering_type(const tetlod::Context &context, vtkDataArray &original);

// The array on the context's result.
vtkSmartPointer<vtkDataArray> fetch_carried(const tetlod::Context &context, const CarriedArray &array, int64_t points);

// All of them, on the context's result.
std::vector<vtkSmartPointer<vtkDataArray>> fetch_all(const tetlod::Context &context, const CellArrays &arrays,
                                                     int64_t tets);

}  // namespace tetlod_vtk
