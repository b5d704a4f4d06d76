#include "carried_arrays.hpp"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <numeric>

namespace tetlod_vtk {
namespace {

constexpr int kMostComponents = 64;

// Why an array of the grid is not carried; empty: it is.
std::string why_left_out(vtkAbstractArray &any) {
  auto *array = vtkDataArray::SafeDownCast(&any);
  if (array == nullptr) return "is not one of numbers";
  if (array->GetName() == nullptr || *array->GetName() == 0) return "has no name";
  const int components = array->GetNumberOfComponents();
  if (components < 1 || components > kMostComponents) return "has " + std::to_string(components) + " components";
  return "";
}

// Marks and numbers of this grid's points and cells, which the result does not have.
bool is_bookkeeping(vtkDataSetAttributes &data, vtkAbstractArray *array) {
  return array == data.GetGlobalIds() || array == data.GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
}

// The steering field is the result's active point scalars; means of numbers number nothing.
int attribute_of(vtkDataSetAttributes &data, int index, int32_t association) {
  const int attribute = data.IsArrayAnAttribute(index);
  const bool is_lost = attribute == vtkDataSetAttributes::SCALARS || attribute == vtkDataSetAttributes::PEDIGREEIDS;
  return association == TETLOD_POINT_FIELD && is_lost ? -1 : attribute;
}

// use(array, attribute) for each that is carried: none of the others, which have a part of their own.
template <class Use>
void for_carried(vtkDataSetAttributes &data, int32_t association, const std::vector<vtkDataArray *> &others,
                 std::vector<std::string> &notes, const Use &use) {
  for (int i = 0; i < data.GetNumberOfArrays(); i++) {
    vtkAbstractArray *array = data.GetAbstractArray(i);
    const std::string name = array->GetName() != nullptr ? array->GetName() : "";
    const bool is_other = std::find(others.begin(), others.end(), array) != others.end();
    if (is_other || is_bookkeeping(data, array)) continue;
    const std::string reason = why_left_out(*array);
    if (reason.empty())
      use(data.GetArray(i), attribute_of(data, i, association));
    else
      notes.push_back("array '" + name + "' of " + (association == TETLOD_POINT_FIELD ? "points" : "cells") +
                      " is left out: it " + reason);
  }
}

vtkSmartPointer<vtkDataArray> array_for(vtkDataArray &original, int type, int64_t tuples) {
  auto values = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  values->SetName(original.GetName());
  values->SetNumberOfComponents(original.GetNumberOfComponents());
  values->SetNumberOfTuples(tuples);
  describe_as(original, *values);
  return values;
}

// Means of integers are no integers.
int type_of_means(vtkDataArray &original) {
  return is_real(original.GetDataType()) ? original.GetDataType() : VTK_DOUBLE;
}

LentArray counted(vtkIdType count) {
  vtkNew<vtkTypeInt64Array> numbers;
  numbers->SetNumberOfValues(count);
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + count, 0);
  return {numbers.Get(), room_in(numbers, 1)};
}

void fetch(const tetlod::Context &context, const std::string &name, vtkDataArray &values) {
  tetlod_array room = room_in(&values, values.GetNumberOfComponents());
  require(tetlod_fetch_field(context.get(), name.c_str(), &room), context);
}

}  // namespace

void require(tetlod_status status, const tetlod::Context &context) {
  if (status != TETLOD_OK) throw tetlod::Error(status, context.last_message());
}

std::string name_of_none(vtkDataSetAttributes &data, std::string name) {
  while (data.HasArray(name.c_str())) name += "_";
  return name;
}

std::vector<CarriedArray> carried_arrays(vtkUnstructuredGrid &grid, const std::vector<vtkDataArray *> &others,
                                         std::vector<std::string> &notes) {
  std::vector<CarriedArray> all;
  for_carried(*grid.GetPointData(), TETLOD_POINT_FIELD, others, notes, [&](vtkDataArray *array, int attribute) {
    all.push_back({array, attribute, lend_reals(array)});
  });
  return all;
}

CellArrays cell_arrays(vtkUnstructuredGrid &grid, const Tets &tets, std::vector<std::string> &notes) {
  CellArrays arrays{{}, tets.cells, {}, name_of_none(*grid.GetPointData(), "tet numbers")};
  for_carried(*grid.GetCellData(), TETLOD_CELL_FIELD, {}, notes, [&](vtkDataArray *array, int attribute) {
    arrays.all.push_back({array, attribute});
  });
  if (!arrays.all.empty()) arrays.numbers = counted(tets.corners->GetNumberOfValues() / 4);
  return arrays;
}

void describe_as(vtkDataArray &original, vtkDataArray &result) {
  result.CopyComponentNames(&original);
  auto *unit = vtkDataArray::UNITS_LABEL();
  if (!original.HasInformation() || !original.GetInformation()->Has(unit)) return;
  result.GetInformation()->Set(unit, original.GetInformation()->Get(unit));
}

int steering_type(const tetlod::Context &context, vtkDataArray &original) {
  return context.get_real(TETLOD_OPT_MAX_ERROR) > 0 ? VTK_DOUBLE : type_of_means(original);
}

vtkSmartPointer<vtkDataArray> fetch_carried(const tetlod::Context &context, const CarriedArray &array, int64_t points) {
  vtkDataArray &original = *array.original;
  const int type = array.weight > 0 ? steering_type(context, original) : type_of_means(original);
  auto fetched = array_for(original, type, points);
  fetch(context, array.name(), *fetched);
  return fetched;
}

std::vector<vtkSmartPointer<vtkDataArray>> fetch_all(const tetlod::Context &context, const CellArrays &arrays,
                                                     int64_t tets) {
  std::vector<vtkSmartPointer<vtkDataArray>> all;
  if (arrays.all.empty()) return all;
  vtkNew<vtkTypeInt64Array> numbers;
  numbers->SetNumberOfValues(tets);
  fetch(context, arrays.name_of_numbers, *numbers);
  for (const CellArrays::One &one : arrays.all) {
    all.push_back(array_for(*one.original, one.original->GetDataType(), tets));
    for (vtkIdType t = 0; t < tets; t++) {
      const vtkIdType of_tet = numbers->GetValue(t);
      all.back()->SetTuple(t, arrays.cells ? vtkIdType(arrays.cells->GetComponent(of_tet, 0)) : of_tet, one.original);
    }
  }
  return all;
}

}  // namespace tetlod_vtk
