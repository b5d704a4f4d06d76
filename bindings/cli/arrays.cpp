#include "arrays.hpp"

#include <vtkDoubleArray.h>

namespace cli {
namespace {

bool is_real(const vtkDataArray &array) {
  const int type = const_cast<vtkDataArray &>(array).GetDataType();
  return type == VTK_FLOAT || type == VTK_DOUBLE;
}

int32_t element_type(const vtkDataArray &array) {
  const bool wide = array.GetElementComponentSize() == 8;
  if (is_real(array)) return wide ? TETLOD_FLOAT64 : TETLOD_FLOAT32;
  return wide ? TETLOD_INT64 : TETLOD_INT32;
}

}  // namespace

vtkSmartPointer<vtkDataArray> as_reals(vtkDataArray *array) {
  if (is_real(*array) && array->HasStandardMemoryLayout()) return array;
  auto copy = vtkSmartPointer<vtkDoubleArray>::New();
  copy->DeepCopy(array);
  return copy;
}

tetlod_array borrowed(vtkDataArray *array, int32_t components) {
  tetlod_array view{};
  view.struct_size = sizeof view;
  view.type = element_type(*array);
  view.tuples = array->GetNumberOfValues() / components;
  view.components = components;
  view.data = array->GetVoidPointer(0);
  return view;
}

}  // namespace cli
