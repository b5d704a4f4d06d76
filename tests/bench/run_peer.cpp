#include "run_peer.hpp"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGridQuadricDecimation.h>

#include <stdexcept>

#include "vtk_grid.hpp"

namespace bench {
namespace {

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

Peer::Peer(const Mesh &mesh) : grid_(grid_for_vtk(mesh)) {}

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
