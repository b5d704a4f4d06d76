// Points by their places.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <vector>

namespace tetlod_vtk {

// Blocks of a grid may each have points of their own where they meet.
class Places {
 public:
  explicit Places(vtkUnstructuredGrid &grid);

  // The lowest that is at the point's place.
  vtkIdType rank(vtkIdType id) const { return lowest_.empty() ? id : lowest_[std::size_t(id)]; }

 private:
  std::vector<vtkIdType> lowest_;  // empty: no two are at one
};

}  // namespace tetlod_vtk
