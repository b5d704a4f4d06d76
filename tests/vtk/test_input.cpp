// Which of a grid's cells and arrays the filter takes, which it leaves out with a warning, and which are an error; and
// the types that the result has.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTetra.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

using cli_test::Cube;
using cli_test::Kind;

class Input : public Filter {
 protected:
  void expect_warning(const std::string &part) {
    EXPECT_GT(updated()->GetNumberOfCells(), 0);
    EXPECT_TRUE(listener.errors.empty()) << listener.errors.front();
    ASSERT_EQ(listener.warnings.size(), 1U);
    EXPECT_NE(listener.warnings.front().find(part), std::string::npos) << listener.warnings.front();
    listener.warnings.clear();
  }
};

template <class Array>
vtkSmartPointer<Array> array_of(const char *name, vtkIdType tuples, int components = 1) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

template <class Array>
vtkSmartPointer<Array> numbers(const char *name, vtkIdType tuples, int components = 1) {
  const auto array = array_of<Array>(name, tuples, components);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); i++) array->SetValue(i, 3);
  return array;
}

// The same cells, each with points of its own, in an order that is another one in every second.
Grid with_points_of_their_own(vtkUnstructuredGrid &grid) {
  auto apart = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    grid.GetCellPoints(c, ids);
    const vtkIdType first = points->GetNumberOfPoints(), count = ids->GetNumberOfIds();
    const auto own = [&](vtkIdType k) { return c % 2 ? count - 1 - k : k; };
    for (vtkIdType k = 0; k < count; k++) {
      points->InsertNextPoint(grid.GetPoint(ids->GetId(own(k))));
      heat->InsertNextValue(grid.GetPointData()->GetArray("heat")->GetComponent(ids->GetId(own(k)), 0));
    }
    for (vtkIdType k = 0; k < count; k++) ids->SetId(k, first + own(k));
    apart->InsertNextCell(grid.GetCellType(c), ids);
  }
  apart->SetPoints(points);
  apart->GetPointData()->SetScalars(heat);
  return apart;
}

double volume_of(vtkUnstructuredGrid &tets) {
  double volume = 0;
  for (vtkIdType t = 0; t < tets.GetNumberOfCells(); t++) {
    double p[4][3];
    for (int k = 0; k < 4; k++) tets.GetPoint(tets.GetCell(t)->GetPointId(k), p[k]);
    volume += std::abs(vtkTetra::ComputeVolume(p[0], p[1], p[2], p[3]));
  }
  return volume;
}

TEST_F(Input, ArraysOfTooManyComponentsAreLeftOut) {
  for (const int type : {vtkDataObject::POINT, vtkDataObject::CELL}) {
    const Grid grid = cube_grid();
    const vtkIdType tuples = grid->GetNumberOfElements(type);
    grid->GetAttributes(type)->AddArray(numbers<vtkDoubleArray>("few", tuples, 64));
    grid->GetAttributes(type)->AddArray(numbers<vtkDoubleArray>("many", tuples, 65));
    filter->SetInputData(grid);
    const std::string of = type == vtkDataObject::POINT ? "points" : "cells";
    expect_warning("array 'many' of " + of + " is left out: it has 65 components");
    vtkDataSetAttributes &made = *filter->GetOutput()->GetAttributes(type);
    EXPECT_TRUE(made.HasArray("few"));
    EXPECT_FALSE(made.HasArray("many"));
  }
}

TEST_F(Input, TextsAreLeftOut) {
  const Grid grid = cube_grid();
  grid->GetPointData()->AddArray(array_of<vtkStringArray>("label", grid->GetNumberOfPoints()));
  filter->SetInputData(grid);
  expect_warning("array 'label' of points is left out: it is not one of numbers");
}

TEST_F(Input, ArraysWithoutANameAreLeftOut) {
  const Grid grid = cube_grid();
  grid->GetCellData()->AddArray(numbers<vtkDoubleArray>(nullptr, grid->GetNumberOfCells()));
  filter->SetInputData(grid);
  expect_warning("array '' of cells is left out: it has no name");
}

TEST_F(Input, GlobalNumbersAreLeftOutInSilence) {
  const Grid grid = cube_grid();
  grid->GetPointData()->SetGlobalIds(numbers<vtkIdTypeArray>("number", grid->GetNumberOfPoints()));
  grid->GetCellData()->SetGlobalIds(numbers<vtkIdTypeArray>("number", grid->GetNumberOfCells()));
  filter->SetInputData(grid);
  EXPECT_GT(updated()->GetNumberOfCells(), 0);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("number"));
  EXPECT_FALSE(filter->GetOutput()->GetCellData()->HasArray("number"));
  expect_silence();
}

TEST_F(Input, CellsWithoutAVolumeAreLeftOut) {
  Cube cube;
  cube.with_triangle = true;
  filter->SetInputData(cube_grid(cube));
  expect_warning("1 cells without a volume are left out");
}

TEST_F(Input, CellsWithoutAVolumeAloneAreAnError) {
  const Grid grid = cube_grid();
  vtkNew<vtkIdList> corners;
  corners->SetNumberOfIds(3);
  for (vtkIdType k = 0; k < 3; k++) corners->SetId(k, k);
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell(corners);
  grid->GetCellData()->Initialize();
  grid->SetCells(VTK_TRIANGLE, triangles);
  filter->SetInputData(grid);
  expect_failure("there are no cells with a volume", TETLOD_ERR_ARGUMENT);
}

TEST_F(Input, CurvedCellsAreTakenByTheirCorners) {
  Cube cube;
  cube.kind = Kind::quadratic_hexahedron;
  filter->SetInputData(cube_grid(cube));
  expect_warning("216 cells of type 25 (vtkQuadraticHexahedron) are taken by their corners");
}

TEST_F(Input, ACellWithTooFewPointsIsAnError) {
  Cube cube;
  cube.kind = Kind::hexahedron;
  const Grid grid = cube_grid(cube);
  grid->GetCellData()->Initialize();
  vtkNew<vtkIdList> corners;
  grid->GetCellPoints(0, corners);
  corners->SetNumberOfIds(7);
  grid->InsertNextCell(VTK_HEXAHEDRON, corners);
  filter->SetInputData(grid);
  expect_failure("cell 216 has 7 points only", TETLOD_ERR_ARGUMENT);
}

// As blocks of a grid have where they meet. Split along other diagonals, cells would have slits between them.
TEST_F(Input, CellsWithPointsOfTheirOwnAreSplitSoThatTheyFit) {
  for (const Kind kind : {Kind::hexahedron, Kind::wedge, Kind::pyramid}) {
    Cube cube;
    cube.kind = kind;
    const Grid apart = with_points_of_their_own(*cube_grid(cube));
    filter->SetInputData(apart);
    EXPECT_NEAR(volume_of(*updated()), 1, 1e-12) << int(kind);
  }
  expect_silence();
}

TEST_F(Input, AFieldOfCellsIsNamedAsSuch) {
  use_field("part");
  expect_failure("field 'part' is cell data; point data: heat, other, flow (3 components)", TETLOD_ERR_ARGUMENT);
}

TEST_F(Input, WithoutActiveScalarsTheFirstArrayOfOneNumberSteers) {
  const Grid grid = cube_grid();
  const vtkSmartPointer<vtkDataArray> heat = grid->GetPointData()->GetArray("heat");
  grid->GetPointData()->RemoveArray("heat");
  grid->GetPointData()->AddArray(heat);  // behind the others, and not active
  filter->SetInputData(grid);
  EXPECT_STREQ(updated()->GetPointData()->GetScalars()->GetName(), "other");
  expect_silence();
}

TEST_F(Input, FlagsOfCellsAreAnError) {
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "part");
  expect_failure("point flags 'part' are asked for as cell data", TETLOD_ERR_ARGUMENT);
}

TEST_F(Input, FlagsHaveOneComponent) {
  const Grid grid = cube_grid();
  grid->GetPointData()->AddArray(numbers<vtkUnsignedCharArray>("flags", grid->GetNumberOfPoints(), 2));
  filter->SetInputData(grid);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flags");
  expect_failure("point flags 'flags' are not a point array of one unsigned char", TETLOD_ERR_ARGUMENT);
}

TEST_F(Input, PointsAreDoublesAndTetsOf32BitsWhateverTheyWere) {
  Cube cube;
  cube.real = "float";
  const Grid grid = cube_grid(cube);
  ASSERT_EQ(grid->GetPoints()->GetDataType(), VTK_FLOAT);
  grid->GetCells()->ConvertTo64BitStorage();
  filter->SetInputData(grid);
  EXPECT_EQ(updated()->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_FALSE(filter->GetOutput()->GetCells()->IsStorage64Bit());
}

TEST_F(Input, ArraysOfPointsStayFloatsAndIntegersBecomeDoubles) {
  const Grid grid = cube_grid();
  grid->GetPointData()->AddArray(numbers<vtkFloatArray>("float", grid->GetNumberOfPoints(), 2));
  grid->GetPointData()->AddArray(numbers<vtkIntArray>("int", grid->GetNumberOfPoints(), 2));
  filter->SetInputData(grid);
  vtkPointData &made = *updated()->GetPointData();
  EXPECT_EQ(made.GetArray("float")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(made.GetArray("int")->GetDataType(), VTK_DOUBLE);
  for (const char *name : {"float", "int"})
    EXPECT_EQ(made.GetArray(name)->GetComponent(made.GetNumberOfTuples() - 1, 1), 3) << name;
}

}  // namespace
}  // namespace vtk_test
