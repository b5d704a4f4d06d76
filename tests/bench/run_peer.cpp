#include "run_peer.hpp"

#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGridQuadricDecimation.h>

#include <stdexcept>

namespace bench {
namespace {

constexpr const char *kField = "scalar";

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

Mesh mesh_from_vtk(vtkUnstructuredGrid &grid) {
  Mesh mesh;
  vtkDataArray *const values = grid.GetPointData()->GetArray(0);  // the one field, without its name
  if (values == nullptr) throw std::runtime_error("the peer lost the field");
  mesh.points.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  mesh.values.resize(mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); i++) {
    grid.GetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
    mesh.values[i] = values->GetTuple1(static_cast<vtkIdType>(i));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    grid.GetCellPoints(c, corners);
    Tet tet;
    for (int k = 0; k < 4; k++) tet[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(corners->GetId(k));
    mesh.tets.push_back(tet);
  }
  return mesh;
}

}  // namespace

Peer::Peer(const Mesh &mesh) : grid_(vtkSmartPointer<vtkUnstructuredGrid>::New()) {
  grid_->SetPoints(points_for_vtk(mesh.points));
  grid_->GetPointData()->SetScalars(values_for_vtk(mesh.values));
  add_tets(mesh.tets, *grid_);
}

PeerRun Peer::run(std::int64_t tets) const {
  vtkNew<vtkUnstructuredGridQuadricDecimation> filter;
  filter->SetInputData(grid_);
  filter->SetScalarsName(kField);
  filter->SetTargetReduction(1.0 - double(tets) / double(grid_->GetNumberOfCells()));
  const Stopwatch watch;
  filter->Update();
  const Cost cost = watch.cost();
  return {cost, mesh_from_vtk(*filter->GetOutput())};
}

}  // namespace bench
