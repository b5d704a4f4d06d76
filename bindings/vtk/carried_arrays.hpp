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

struct CarriedArray {
  vtkSmartPointer<vtkDataArray> original;  // the grid's
  int32_t association;                     // TETLOD_POINT_FIELD or TETLOD_CELL_FIELD
  int type;                                // VTK's, of the result's array
  int attribute;                           // vtkDataSetAttributes::AttributeTypes that it is active as; -1: none
  LentArray reals;                         // what the library gets: a tuple a point or a tet
  double weight = 0;                       // positive: it steers

  // A grid may have a point and a cell array of one name; the library's fields have one each.
  std::string key() const {
    return std::string(association == TETLOD_CELL_FIELD ? "cell " : "point ") + original->GetName();
  }
};

// All named arrays of numbers but the steering one. Those of cells keep their type; those of points become means, so
// integers become doubles. Ghost marks and global numbers have no meaning any more. A note says which are left out:
// without a name, or of more than 64 components.
std::vector<CarriedArray> carried_arrays(vtkUnstructuredGrid &grid, vtkDataArray *steering, const Tets &tets,
                                         std::vector<std::string> &notes);

// Gives the result's array the original's unit and names of components. What else VTK has noted of an array is of its
// values, such as their range; it depends on who asked for it before.
void describe_as(vtkDataArray &original, vtkDataArray &result);

// The array on the context's result.
vtkSmartPointer<vtkDataArray> fetch_carried(const tetlod::Context &context, const CarriedArray &array, int64_t tuples);

}  // namespace tetlod_vtk
