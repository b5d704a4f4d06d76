#include "shape.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkContourFilter.h>
#include <vtkCutter.h>
#include <vtkGeometryFilter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace cli {
namespace {

void add_polygon(vtkIdType size, const vtkIdType *ids, Shape &shape) {
  for (vtkIdType k = 0; k < size; k++) {
    const int a = static_cast<int>(ids[k]), b = static_cast<int>(ids[(k + 1) % size]);
    shape.edges.push_back({std::min(a, b), std::max(a, b)});
    if (k >= 2) shape.triangles.push_back({static_cast<int>(ids[0]), static_cast<int>(ids[k - 1]), a});
  }
}

Shape shape_of(vtkPolyData &data) {
  Shape shape;
  vtkDataArray *values = data.GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); i++) {
    Vector p{};
    data.GetPoint(i, p.data());
    shape.points.push_back(p);
    shape.values.push_back(values != nullptr ? values->GetTuple1(i) : 0.0);
  }
  for (vtkIdType c = 0; c < data.GetPolys()->GetNumberOfCells(); c++) {
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    data.GetPolys()->GetCellAtId(c, size, ids);
    add_polygon(size, ids, shape);
  }
  std::sort(shape.edges.begin(), shape.edges.end());
  shape.edges.erase(std::unique(shape.edges.begin(), shape.edges.end()), shape.edges.end());
  return shape;
}

template <class Filter>
Shape output_of(Filter &filter, const Sight &sight) {
  filter.SetInputData(sight.grid);
  filter.Update();
  return shape_of(*filter.GetOutput());
}

}  // namespace

Sight sight_of(vtkUnstructuredGrid *grid, const std::string &field) {
  auto bare = vtkSmartPointer<vtkUnstructuredGrid>::New();
  bare->CopyStructure(grid);
  vtkDataArray *values = grid->GetPointData()->GetArray(field.c_str());
  if (values == nullptr) values = grid->GetPointData()->GetScalars();
  bare->GetPointData()->SetScalars(values);
  return {bare, values};
}

Shape surface_of(const Sight &sight) {
  vtkNew<vtkGeometryFilter> filter;
  return output_of(*filter, sight);
}

Shape slice_of(const Sight &sight, int axis, double at) {
  Vector origin{}, normal{};
  origin[std::size_t(axis)] = at;
  normal[std::size_t(axis)] = 1;
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(origin.data());
  plane->SetNormal(normal.data());
  vtkNew<vtkCutter> filter;
  filter->SetCutFunction(plane);
  filter->GenerateTrianglesOff();
  return output_of(*filter, sight);
}

Shape isosurface_of(const Sight &sight, double value) {
  vtkNew<vtkContourFilter> filter;
  filter->SetValue(0, value);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  Shape shape = output_of(*filter, sight);
  shape.edges.clear();
  std::fill(shape.values.begin(), shape.values.end(), value);
  return shape;
}

}  // namespace cli
