#include "steering_field.hpp"

#include <vtkCellData.h>
#include <vtkPointData.h>

#include <stdexcept>

namespace tetlod_vtk {
namespace {

bool is_scalar(vtkDataArray *array) { return array != nullptr && array->GetNumberOfComponents() == 1; }

// "a, b (3 components)"
std::string names_of(vtkDataSetAttributes &data) {
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkDataArray *array = data.GetArray(i);
    if (array == nullptr || array->GetName() == nullptr) continue;
    names += (names.empty() ? "" : ", ") + std::string(array->GetName());
    if (!is_scalar(array)) names += " (" + std::to_string(array->GetNumberOfComponents()) + " components)";
  }
  return names;
}

std::string what_there_is(vtkUnstructuredGrid &grid) {
  const std::string of_points = names_of(*grid.GetPointData()), of_cells = names_of(*grid.GetCellData());
  return (of_points.empty() ? "there is no point data" : "point data: " + of_points) +
         (of_cells.empty() ? "" : "; cell data: " + of_cells);
}

std::string why_not(vtkUnstructuredGrid &grid, const std::string &name) {
  if (grid.GetPointData()->HasArray(name.c_str())) return "field '" + name + "' is not one number a point";
  if (grid.GetCellData()->HasArray(name.c_str())) return "field '" + name + "' is cell data";
  return "no field '" + name + "'";
}

vtkDataArray *first_scalar(vtkUnstructuredGrid &grid) {
  vtkPointData &data = *grid.GetPointData();
  if (is_scalar(data.GetScalars())) return data.GetScalars();
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    if (is_scalar(data.GetArray(i))) return data.GetArray(i);
  }
  const char *const why =
      names_of(data).empty() ? "" : "no field of one number a point, which a calculator makes of a vector; ";
  throw std::runtime_error(why + what_there_is(grid));
}

}  // namespace

vtkDataArray *steering_field(vtkUnstructuredGrid &grid, const std::string &name) {
  if (name.empty()) return first_scalar(grid);
  vtkDataArray *array = grid.GetPointData()->GetArray(name.c_str());
  if (!is_scalar(array)) throw std::runtime_error(why_not(grid, name) + "; " + what_there_is(grid));
  return array;
}

}  // namespace tetlod_vtk
