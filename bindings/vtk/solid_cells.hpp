// The cells of a grid that have a volume, and their faces.
#pragma once

#include <vtkType.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

namespace tetlod_vtk {

bool is_solid(int type);

// The type of cell that its corners, which VTK lists first, make; a curved cell's is another than its own.
int linear_type(int type);

// Without ghosts: another part of the mesh has those, or nobody.
bool is_ghost(vtkUnstructuredGrid &grid, vtkIdType cell);

// The points of a cell, at least so many. Throws std::runtime_error where they are fewer, or none of the grid's:
// nothing else looks at numbers from a file.
const vtkIdType *points_of(vtkUnstructuredGrid &grid, vtkIdType cell, int least);

// Points of each face in their order around it; by its corners, of a curved cell.
using Faces = std::vector<std::vector<vtkIdType>>;

// Of a solid cell, but a tet. Throws as above.
void get_faces(vtkUnstructuredGrid &grid, vtkIdType cell, Faces &faces);

}  // namespace tetlod_vtk
