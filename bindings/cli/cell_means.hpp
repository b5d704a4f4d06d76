// Cell data steer by their means around points.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace cli {

// Where `field` names cell data and no point data, or there is none and the grid has cell data alone, it gets the means
// of the solid cells around each point as point data of that name; a note says so. Of several that nobody names it is
// the active scalars, else the first reals, else the first.
void add_means_of_cells(const std::string &field, vtkUnstructuredGrid &grid, std::vector<std::string> &notes);

}  // namespace cli
