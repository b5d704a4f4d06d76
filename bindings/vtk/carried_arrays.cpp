#include "carried_arrays.hpp"

#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>

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

// The steering field is the result's active point scalars.
int attribute_of(vtkDataSetAttributes &data, int index, int32_t association) {
  const int attribute = data.IsArrayAnAttribute(index);
  return association == TETLOD_POINT_FIELD && attribute == vtkDataSetAttributes::SCALARS ? -1 : attribute;
}

// A tuple a tet of an array with a tuple a cell.
vtkSmartPointer<vtkDataArray> a_tuple_a_tet(vtkDataArray *array, const Tets &tets) {
  if (tets.cells == nullptr) return array;
  auto spread = vtk::TakeSmartPointer(array->NewInstance());
  spread->SetNumberOfComponents(array->GetNumberOfComponents());
  spread->SetNumberOfTuples(tets.cells->GetNumberOfValues());
  for (vtkIdType t = 0; t < tets.cells->GetNumberOfValues(); t++)
    spread->SetTuple(t, vtkIdType(tets.cells->GetComponent(t, 0)), array);
  return spread;
}

CarriedArray carried(vtkDataArray *array, int32_t association, int attribute, const Tets &tets) {
  const bool of_cells = association == TETLOD_CELL_FIELD;
  const int type = array->GetDataType();
  return {array, association, of_cells || is_real(type) ? type : VTK_DOUBLE, attribute,
          lend_reals(of_cells ? a_tuple_a_tet(array, tets).Get() : array)};
}

vtkSmartPointer<vtkDataArray> array_for(const CarriedArray &array, int type) {
  auto values = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  values->SetName(array.original->GetName());
  values->SetNumberOfComponents(array.reals.array.components);
  return values;
}

}  // namespace

std::vector<CarriedArray> carried_arrays(vtkUnstructuredGrid &grid, vtkDataArray *steering, const Tets &tets,
                                         std::vector<std::string> &notes) {
  std::vector<CarriedArray> all;
  const auto add_all = [&](vtkDataSetAttributes &data, int32_t association) {
    for (int i = 0; i < data.GetNumberOfArrays(); i++) {
      vtkAbstractArray *array = data.GetAbstractArray(i);
      const std::string name = array->GetName() != nullptr ? array->GetName() : "";
      if (array == steering || is_bookkeeping(data, array)) continue;
      const std::string reason = why_left_out(*array);
      if (reason.empty())
        all.push_back(carried(data.GetArray(i), association, attribute_of(data, i, association), tets));
      else
        notes.push_back("array '" + name + "' is left out: it " + reason);
    }
  };
  add_all(*grid.GetPointData(), TETLOD_POINT_FIELD);
  add_all(*grid.GetCellData(), TETLOD_CELL_FIELD);
  return all;
}

void describe_as(vtkDataArray &original, vtkDataArray &result) {
  result.CopyComponentNames(&original);
  auto *unit = vtkDataArray::UNITS_LABEL();
  if (!original.HasInformation() || !original.GetInformation()->Has(unit)) return;
  result.GetInformation()->Set(unit, original.GetInformation()->Get(unit));
}

vtkSmartPointer<vtkDataArray> fetch_carried(const tetlod::Context &context, const CarriedArray &array, int64_t tuples) {
  auto fetched = array_for(array, is_real(array.type) ? array.type : VTK_DOUBLE);
  fetched->SetNumberOfTuples(tuples);
  tetlod_array room = room_in(fetched, fetched->GetNumberOfComponents());
  if (const auto status = tetlod_fetch_field(context.get(), array.key().c_str(), &room); status != TETLOD_OK)
    throw tetlod::Error(status, context.last_message());
  if (!is_real(array.type)) {
    auto integers = array_for(array, array.type);
    integers->DeepCopy(fetched);
    fetched = integers;
    fetched->SetName(array.original->GetName());
  }
  describe_as(*array.original, *fetched);
  return fetched;
}

}  // namespace tetlod_vtk
