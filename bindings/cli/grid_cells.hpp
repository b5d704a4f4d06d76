// The cells of a grid as tets.
#pragma once

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace cli {

// Four point numbers a tet, over the grid's own points: the grid's own array where it holds tets alone, otherwise
//   quadratic tets    eight tets each, when all volume cells are such;
//   other cells       by their corners: hexahedra, voxels, wedges, pyramids are split so that neighbours fit; of
//                     quadratic and higher cells the points between the corners are left out (a note says so);
//   surfaces, lines   are left out (a note says so).
// Throws Failure for polyhedra and other cells, and names them.
vtkSmartPointer<vtkDataArray> tets_of(vtkUnstructuredGrid &grid, std::vector<std::string> &notes);

}  // namespace cli
