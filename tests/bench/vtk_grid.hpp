// A mesh in VTK's own form.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "bench_mesh.hpp"

namespace bench {

constexpr const char *kField = "scalar";  // the name of its active scalars

vtkSmartPointer<vtkUnstructuredGrid> grid_for_vtk(const Mesh &mesh);

}  // namespace bench
