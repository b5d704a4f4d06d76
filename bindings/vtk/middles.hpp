// Cells with any faces become tets around their middles.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace tetlod_vtk {

// The grid, or, where it has polyhedra or prisms of five and six sides, another in which each of them is tets from its
// middle to triangles of its faces, with the cell's data. Quads are cut from their lowest point on, as those of other
// cells are, larger faces around middles of their own. Middles are points that are added at the end, in the mean of the
// points that they are of, and so are their data, for which integers become doubles. flags: the name of the point
// flags, or empty: a middle of a face is flagged as all of its points are, that of a cell not. A note says how many
// cells there are. Throws std::runtime_error for numbers of points that the grid does not have, and faces that are
// none.
vtkSmartPointer<vtkUnstructuredGrid> cut_around_middles(vtkUnstructuredGrid *grid, const std::string &flags,
                                                        std::vector<std::string> &notes);

}  // namespace tetlod_vtk
