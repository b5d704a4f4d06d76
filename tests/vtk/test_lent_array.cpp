// Arrays are lent in place where VTK's layout allows it, and the result does not depend on the layout.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkSOADataArrayTemplate.h>

#include "filter_fixture.hpp"
#include "lent_array.hpp"

namespace vtk_test {
namespace {

using namespace tetlod_vtk;

template <class Array>
vtkSmartPointer<Array> counted(vtkIdType tuples, int components) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; i++) {
    for (int c = 0; c < components; c++) array->SetComponent(i, c, static_cast<double>(10 * i + c));
  }
  return array;
}

double element(const tetlod_array &array, int64_t tuple, int32_t component) {
  const bool is_float = array.type == TETLOD_FLOAT32;
  const int64_t size = is_float ? 4 : 8;
  const int64_t tuple_stride = array.tuple_stride != 0 ? array.tuple_stride : size * array.components;
  const int64_t component_stride = array.component_stride != 0 ? array.component_stride : size;
  const char *at = static_cast<char *>(array.data) + tuple * tuple_stride + component * component_stride;
  return is_float ? double(*reinterpret_cast<const float *>(at)) : *reinterpret_cast<const double *>(at);
}

void expect_counted(const tetlod_array &array, int64_t tuples, int32_t components) {
  ASSERT_EQ(array.tuples, tuples);
  ASSERT_EQ(array.components, components);
  for (int64_t i = 0; i < tuples; i++) {
    for (int32_t c = 0; c < components; c++) EXPECT_EQ(element(array, i, c), double(10 * i + c));
  }
}

TEST(LentArray, InterleavedRealsAreInPlace) {
  const auto doubles = counted<vtkDoubleArray>(5, 3);
  const auto floats = counted<vtkFloatArray>(5, 9);
  EXPECT_EQ(lend_reals(doubles).array.data, doubles->GetPointer(0));
  EXPECT_EQ(lend_reals(floats).array.data, floats->GetPointer(0));
  expect_counted(lend_reals(doubles).array, 5, 3);
  expect_counted(lend_reals(floats).array, 5, 9);
}

TEST(LentArray, SeparateComponentsAreInPlaceWhereTheyAreEvenlySpaced) {
  const auto one = counted<vtkSOADataArrayTemplate<double>>(5, 1);
  const auto two = counted<vtkSOADataArrayTemplate<float>>(5, 2);
  EXPECT_EQ(lend_reals(one).array.data, one->GetComponentArrayPointer(0));
  EXPECT_EQ(lend_reals(two).array.data, two->GetComponentArrayPointer(0));
  expect_counted(lend_reals(one).array, 5, 1);
  expect_counted(lend_reals(two).array, 5, 2);
}

TEST(LentArray, UnevenComponentsAreCopiedOrLentOneByOne) {
  std::vector<double> memory(100);
  const auto three = counted<vtkSOADataArrayTemplate<double>>(5, 3);
  const std::size_t begins[] = {0, 10, 50};
  for (int c = 0; c < 3; c++) {
    double *part = memory.data() + begins[c];
    for (vtkIdType i = 0; i < 5; i++) part[i] = static_cast<double>(10 * i + c);
    three->SetArray(c, part, 5, true, true);
  }
  expect_counted(lend_reals(three).array, 5, 3);
  EXPECT_EQ(lend_component(three, 2).array.data, memory.data() + 50);
  three->SetArray(2, memory.data() + 20, 5, true, true);
  EXPECT_EQ(lend_reals(three).array.data, memory.data()) << "even again";
}

TEST(LentArray, IntegersBecomeDoubles) {
  expect_counted(lend_reals(counted<vtkIntArray>(4, 2)).array, 4, 2);
  EXPECT_EQ(lend_component(counted<vtkIntArray>(4, 2), 1).array.data, nullptr);
}

template <class T>
void make_separate(vtkUnstructuredGrid &grid) {
  vtkNew<vtkSOADataArrayTemplate<T>> xyz, heat;
  xyz->DeepCopy(grid.GetPoints()->GetData());
  heat->DeepCopy(grid.GetPointData()->GetScalars());
  heat->SetName("heat");
  grid.GetPoints()->SetData(xyz);
  grid.GetPointData()->SetScalars(heat);
}

std::string simplified(vtkUnstructuredGrid *grid) {
  vtkNew<vtkTetlodSimplify> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfCells(), 0);
  return bytes_of(filter->GetOutput());
}

TEST(LentArray, ResultsDoNotDependOnTheLayout) {
  const std::string expected = simplified(cube_grid());
  const Grid wide = cube_grid(), narrow = cube_grid(), separate = cube_grid();
  wide->GetCells()->ConvertTo64BitStorage();
  narrow->GetCells()->ConvertTo32BitStorage();
  make_separate<double>(*separate);
  EXPECT_EQ(simplified(wide), expected);
  EXPECT_EQ(simplified(narrow), expected);
  EXPECT_EQ(simplified(separate), expected);
}

}  // namespace
}  // namespace vtk_test
