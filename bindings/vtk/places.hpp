// Points by their places.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <array>
#include <vector>

namespace tetlod_vtk {

std::array<double, 3> point(vtkUnstructuredGrid &grid, vtkIdType id);

// So that it is positive, if it has a volume.
void orient(vtkUnstructuredGrid &grid, vtkIdType *tet);

// Blocks of a grid may each have points of their own where they meet.
class Places {
 public:
  explicit Places(vtkUnstructuredGrid &grid);

  // The lowest that is at the point's place.
  vtkIdType rank(vtkIdType id) const { return lowest_.empty() ? id : lowest_[std::size_t(id)]; }

  // Goes around a face from its lowest point on.
  void begin_at_lowest(std::vector<vtkIdType> &face) const;

 private:
  std::vector<vtkIdType> lowest_;  // empty: no two are at one
};

}  // namespace tetlod_vtk
