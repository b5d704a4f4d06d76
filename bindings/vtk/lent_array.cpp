#include "lent_array.hpp"

#include <vtkDoubleArray.h>
#include <vtkSOADataArrayTemplate.h>

#include <cstddef>
#include <vector>

namespace tetlod_vtk {
namespace {

int32_t element_type(vtkDataArray &array) {
  const bool wide = array.GetElementComponentSize() == 8;
  if (is_real(array.GetDataType())) return wide ? TETLOD_FLOAT64 : TETLOD_FLOAT32;
  if (array.GetElementComponentSize() == 1) return TETLOD_UINT8;
  return wide ? TETLOD_INT64 : TETLOD_INT32;
}

tetlod_array described(vtkDataArray &array, int32_t components, void *data) {
  tetlod_array lent{};
  lent.struct_size = sizeof lent;
  lent.type = element_type(array);
  lent.tuples = array.GetNumberOfValues() / components;
  lent.components = components;
  lent.data = data;
  return lent;
}

template <class T>
std::vector<char *> component_pointers(vtkDataArray &array) {
  std::vector<char *> pointers;
  auto *parts = vtkSOADataArrayTemplate<T>::FastDownCast(&array);
  for (int c = 0; parts != nullptr && c < array.GetNumberOfComponents(); c++)
    pointers.push_back(reinterpret_cast<char *>(parts->GetComponentArrayPointer(c)));
  return pointers;
}

// Of an SOA array of floats or doubles; none for any other.
std::vector<char *> component_pointers(vtkDataArray &array) {
  if (array.GetDataType() == VTK_FLOAT) return component_pointers<float>(array);
  if (array.GetDataType() == VTK_DOUBLE) return component_pointers<double>(array);
  return {};
}

bool evenly_spaced(const std::vector<char *> &pointers) {
  for (std::size_t c = 2; c < pointers.size(); c++) {
    if (pointers[c] - pointers[c - 1] != pointers[1] - pointers[0]) return false;
  }
  return !pointers.empty();
}

LentArray copied(vtkDataArray *array) {
  vtkNew<vtkDoubleArray> copy;
  copy->DeepCopy(array);
  return {copy.Get(), described(*copy, copy->GetNumberOfComponents(), copy->GetPointer(0))};
}

LentArray in_parts(vtkDataArray *array, const std::vector<char *> &pointers) {
  tetlod_array lent = described(*array, array->GetNumberOfComponents(), pointers[0]);
  lent.tuple_stride = array->GetElementComponentSize();
  lent.component_stride = pointers.size() > 1 ? pointers[1] - pointers[0] : lent.tuple_stride;
  return {array, lent};
}

}  // namespace

bool is_real(int vtk_type) { return vtk_type == VTK_FLOAT || vtk_type == VTK_DOUBLE; }

LentArray lend_reals(vtkDataArray *array) {
  if (is_real(array->GetDataType()) && array->HasStandardMemoryLayout())
    return {array, described(*array, array->GetNumberOfComponents(), array->GetVoidPointer(0))};
  const std::vector<char *> pointers = component_pointers(*array);
  return evenly_spaced(pointers) ? in_parts(array, pointers) : copied(array);
}

LentArray lend_component(vtkDataArray *array, int component) {
  const std::vector<char *> pointers = component_pointers(*array);
  LentArray lent{array, {}};
  if (pointers.empty()) return lent;
  lent.array = described(*array, 1, pointers[static_cast<std::size_t>(component)]);
  lent.array.tuples = array->GetNumberOfTuples();
  return lent;
}

tetlod_array room_in(vtkDataArray *array, int32_t components) {
  return described(*array, components, array->GetVoidPointer(0));
}

}  // namespace tetlod_vtk
