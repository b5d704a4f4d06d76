// The cells of a grid as tets.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace tetlod_vtk {

struct Tets {
  vtkSmartPointer<vtkDataArray> corners;  // four point numbers a tet
  vtkSmartPointer<vtkDataArray> cells;    // the grid's cell that a tet is of; null: tet i is cell i
};

// The tets of a grid, over its own points: the grid's own array where it holds tets alone, otherwise
//   quadratic tets    eight tets each, when all volume cells are such;
//   other cells       by their corners: hexahedra, voxels, wedges and pyramids are cut from the lowest point on, so
//   that
//                     neighbours fit, also those that have points of their own at one place; of quadratic and higher
//                     cells the points between the corners are left out (a note says so);
//   surfaces, lines   are left out (a note says so);
//   ghosts            are left out: duplicate and hidden cells. Points that they alone have stay, unused.
// Throws std::runtime_error for other cells with a volume, and names them: polyhedra have become tets before.
Tets tets_of(vtkUnstructuredGrid &grid, std::vector<std::string> &notes);

}  // namespace tetlod_vtk
