#include "result_grid.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "lent_array.hpp"

namespace tetlod_vtk {
namespace {

void fill_points(const tetlod::Context &context, vtkDataArray &original, vtkIdType count, vtkUnstructuredGrid &grid) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  context.fetch_points({static_cast<double *>(points->GetVoidPointer(0)), count, 3});
  describe_as(original, *points->GetData());
  grid.SetPoints(points);
}

void fill_tets(const tetlod::Context &context, vtkIdType count, vtkUnstructuredGrid &grid) {
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(4 * count);
  context.fetch_tets(0, {corners->GetPointer(0), count, 4});
  vtkNew<vtkCellArray> tets;
  if (!tets->SetData(4, corners)) throw std::runtime_error("VTK did not take the result's tets");
  grid.SetCells(VTK_TETRA, tets);
}

void fill_scalars(const tetlod::Context &context, const OriginalArrays &arrays, vtkIdType count,
                  vtkUnstructuredGrid &grid) {
  auto values = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(steering_type(context, *arrays.steering)));
  values->SetName(arrays.name.c_str());
  values->SetNumberOfTuples(count);
  tetlod_array room = room_in(values, 1);
  require(tetlod_fetch_scalars(context.get(), &room), context);
  describe_as(*arrays.steering, *values);
  grid.GetPointData()->SetScalars(values);
}

// Flagged points stay in their places, also where they became one with others.
vtkSmartPointer<vtkUnsignedCharArray> flags_of_result(const OriginalArrays &arrays, vtkUnstructuredGrid &result) {
  const auto place = [](vtkDataArray &points, vtkIdType v) {
    return std::array<double, 3>{points.GetComponent(v, 0), points.GetComponent(v, 1), points.GetComponent(v, 2)};
  };
  const auto is_number = [](double x) { return std::isfinite(x); };
  std::map<std::array<double, 3>, unsigned char> of_place;
  for (vtkIdType v = 0; v < arrays.flags->GetNumberOfValues(); v++) {
    if (arrays.flags->GetValue(v) == 0) continue;
    const auto at = place(*arrays.points, v);
    if (std::all_of(at.begin(), at.end(), is_number)) of_place[at] |= arrays.flags->GetValue(v);
  }
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(arrays.flags->GetName());
  flags->SetNumberOfValues(result.GetNumberOfPoints());
  for (vtkIdType v = 0; v < flags->GetNumberOfValues(); v++) {
    const auto found = of_place.find(place(*result.GetPoints()->GetData(), v));
    flags->SetValue(v, found != of_place.end() ? found->second : static_cast<unsigned char>(0));
  }
  return flags;
}

void add(vtkDataArray *array, int attribute, vtkDataSetAttributes &data) {
  const int at = data.AddArray(array);
  if (attribute >= 0) data.SetActiveAttribute(at, attribute);
}

}  // namespace

void fill_result(const tetlod::Context &context, const OriginalArrays &arrays, vtkUnstructuredGrid &grid) {
  const tetlod::Counts counts = context.fetch_counts();
  fill_points(context, *arrays.points, counts.points, grid);
  fill_tets(context, counts.tets, grid);
  fill_scalars(context, arrays, counts.points, grid);
  for (const CarriedArray &other : arrays.others)
    add(fetch_carried(context, other, counts.points), other.attribute, *grid.GetPointData());
  if (arrays.flags != nullptr) grid.GetPointData()->AddArray(flags_of_result(arrays, grid));
  const auto of_cells = fetch_all(context, arrays.of_cells, counts.tets);
  for (std::size_t i = 0; i < of_cells.size(); i++)
    add(of_cells[i], arrays.of_cells.all[i].attribute, *grid.GetCellData());
}

}  // namespace tetlod_vtk
