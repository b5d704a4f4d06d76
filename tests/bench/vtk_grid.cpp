#include "vtk_grid.hpp"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace bench {
namespace {

vtkSmartPointer<vtkPoints> points_for_vtk(const std::vector<Point> &points) {
  auto made = vtkSmartPointer<vtkPoints>::New();
  made->SetDataTypeToDouble();
  made->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); i++) made->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  return made;
}

vtkSmartPointer<vtkDoubleArray> values_for_vtk(const std::vector<double> &values) {
  auto made = vtkSmartPointer<vtkDoubleArray>::New();
  made->SetName(kField);
  made->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); i++) made->SetValue(static_cast<vtkIdType>(i), values[i]);
  return made;
}

void add_tets(const std::vector<Tet> &tets, vtkUnstructuredGrid &grid) {
  grid.Allocate(static_cast<vtkIdType>(tets.size()));
  for (const Tet &tet : tets) {
    const vtkIdType corners[4] = {tet[0], tet[1], tet[2], tet[3]};
    grid.InsertNextCell(VTK_TETRA, 4, corners);
  }
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> grid_for_vtk(const Mesh &mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points_for_vtk(mesh.points));
  grid->GetPointData()->SetScalars(values_for_vtk(mesh.values));
  add_tets(mesh.tets, *grid);
  return grid;
}

}  // namespace bench
