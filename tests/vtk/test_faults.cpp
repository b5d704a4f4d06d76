// What breaks VTK's own filters and writers, or readers let pass: arrays that are too short, wrong numbers beside
// ghosts, empty outputs; and what is lost when names, types and aborts meet.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

TEST_F(Filter, ArraysThatAreTooShort) {
  for (const int type : {vtkDataObject::POINT, vtkDataObject::CELL}) {
    const Grid grid = cube_grid();
    vtkNew<vtkDoubleArray> few;
    few->SetName("few");
    for (int i = 0; i < 3; i++) few->InsertNextValue(i);
    grid->GetAttributes(type)->AddArray(few);
    filter->SetInputData(grid);
    expect_failure("array 'few': 3 tuples for", TETLOD_ERR_ARGUMENT);
    add_ghosts(*grid, Half::lower);
    grid->Modified();
    expect_failure("array 'few': 3 tuples for", TETLOD_ERR_ARGUMENT);
  }
}

TEST_F(Filter, WrongNumbersBesideGhosts) {
  const vtkIdType wrong[] = {-1, 343, 99999, vtkIdType{1} << 40};
  for (const vtkIdType number : wrong) {
    const Grid grid = cube_grid();
    add_ghosts(*grid, Half::lower);
    vtkNew<vtkIdList> corners;
    grid->GetCellPoints(grid->GetNumberOfCells() - 1, corners);
    corners->SetId(2, number);
    grid->GetCells()->ReplaceCellAtId(grid->GetNumberOfCells() - 1, corners);
    filter->SetInputData(grid);
    expect_failure("names point " + std::to_string(number), TETLOD_ERR_ARGUMENT);
  }
}

TEST_F(Filter, PointsKeepTheirNumbersBesideGhosts) {
  const Grid grid = cube_grid();
  add_ghosts(*grid, Half::lower);
  grid->GetPointData()->GetScalars()->SetTuple1(342, std::numeric_limits<double>::quiet_NaN());
  filter->SetInputData(grid);
  expect_failure("vertex 342", TETLOD_ERR_MESH_NONFINITE);
}

TEST_F(Filter, TetsThatAreNotTheGridsCellsAreSaidToBe) {
  const Grid grid = cube_grid();
  vtkNew<vtkIdList> corners;
  grid->GetCellPoints(grid->GetNumberOfCells() - 1, corners);
  corners->SetId(0, corners->GetId(1));
  grid->GetCells()->ReplaceCellAtId(grid->GetNumberOfCells() - 1, corners);
  filter->SetInputData(grid);
  filter->RepairRepeatedOff();
  expect_failure("tet 1295", TETLOD_ERR_MESH_DEGENERATE);
  EXPECT_FALSE(listener.heard("split into"));
  add_ghosts(*grid, Half::lower);
  grid->Modified();
  expect_failure("tet 647 (of the tets that the grid's solid cells are split into)", TETLOD_ERR_MESH_DEGENERATE);
}

TEST_F(Filter, CellsWithoutPoints) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetCells(VTK_TETRA, cube_grid()->GetCells());
  vtkNew<vtkDoubleArray> none;
  none->SetName("none");
  grid->GetPointData()->SetScalars(none);
  filter->SetInputData(grid);
  expect_failure("the grid has no points", TETLOD_ERR_ARGUMENT);
}

// VTK's writer wants points and cells, be they none.
TEST_F(Filter, WhatIsEmptyCanBeWritten) {
  filter->SetInputData(vtkNew<vtkUnstructuredGrid>());
  const std::string nothing = bytes_of(updated());
  EXPECT_FALSE(nothing.empty());
  const Grid grid = cube_grid();
  grid->GetPointData()->GetScalars()->SetTuple1(7, std::numeric_limits<double>::quiet_NaN());
  filter->SetInputData(grid);
  EXPECT_EQ(bytes_of(updated()), nothing) << "an error";
  Watcher watcher{filter, true, {}};
  filter->SetInputData(cube_grid(large_cube()));
  filter->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::on_progress);
  EXPECT_EQ(bytes_of(updated()), nothing) << "an abort";
}

TEST_F(Filter, WhatWasAbortedRunsAgainFromBehind) {
  Watcher watcher{filter, true, {}};
  filter->SetInputData(cube_grid(large_cube()));
  filter->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::on_progress);
  const vtkNew<vtkTetlodSimplify> behind;
  behind->SetInputConnection(filter->GetOutputPort());
  behind->Update();
  EXPECT_EQ(behind->GetOutput()->GetNumberOfCells(), 0);
  watcher.aborts = false;
  behind->Update();
  EXPECT_GT(behind->GetOutput()->GetNumberOfCells(), 0);
  watcher.seen.clear();
  behind->Update();
  EXPECT_TRUE(watcher.seen.empty()) << "nothing changed";
  expect_silence();
}

TEST_F(Filter, WhatWasAbortedRunsAgainInBlocks) {
  const vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned b = 0; b < 3; b++) blocks->SetBlock(b, cube_grid(large_cube()));
  filter->SetInputDataObject(blocks);
  Watcher watcher{filter, true, {}};
  filter->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::on_progress);
  filter->Update();
  watcher.aborts = false;
  filter->Update();
  auto *const made = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(made, nullptr);
  for (unsigned b = 0; b < 3; b++) {
    const auto *const block = vtkUnstructuredGrid::SafeDownCast(made->GetBlock(b));
    ASSERT_NE(block, nullptr);
    EXPECT_GT(const_cast<vtkUnstructuredGrid *>(block)->GetNumberOfCells(), 0) << b;
  }
  expect_silence();
}

// A float of 1e5 is rounded by 1/256.
TEST_F(Filter, ABoundIsNotLostInFloats) {
  const Grid grid = cube_grid();
  vtkNew<vtkFloatArray> pressure, second;
  for (auto *const array : {pressure.Get(), second.Get()}) {
    array->SetName(array == second.Get() ? "second" : "pressure");
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); i++) {
      const double *const p = grid->GetPoint(i);
      array->InsertNextValue(float(1e5 + std::sin(5 * p[0]) * std::cos(4 * p[1] + p[2])));
    }
    grid->GetPointData()->AddArray(array);
  }
  filter->SetInputData(grid);
  use_field("pressure");
  filter->AddSteeringArray("second");
  filter->SetTargetRatio(0.5);
  for (const char *name : {"pressure", "second"})
    EXPECT_EQ(updated()->GetPointData()->GetArray(name)->GetDataType(), VTK_FLOAT);
  filter->SetTargetRatio(0);
  filter->SetMaxError(0.01);
  for (const char *name : {"pressure", "second"})
    EXPECT_EQ(updated()->GetPointData()->GetArray(name)->GetDataType(), VTK_DOUBLE);
  expect_silence();
}

TEST_F(Filter, NamesThatMayMeetDoNot) {
  const Grid grid = cube_grid();
  grid->GetPointData()->GetArray("heat")->SetName("point other");
  filter->SetInputData(grid);
  filter->AddSteeringArray("other");
  EXPECT_STREQ(updated()->GetPointData()->GetScalars()->GetName(), "point other");
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("other"), nullptr);
  filter->ClearSteeringArrays();
  grid->GetPointData()->GetArray("point other")->SetName(nullptr);
  grid->GetPointData()->GetArray("other")->SetName("scalars");
  grid->Modified();
  vtkDataArray *const steering = updated()->GetPointData()->GetScalars();
  EXPECT_STREQ(steering->GetName(), "scalars_");
  EXPECT_DOUBLE_EQ(steering->GetRange()[1], 6) << "the heat's, not the other's";
  expect_silence();
}

// Means of them number nothing, as global numbers, which are left out.
TEST_F(Filter, PedigreesOfPointsAreNumbersLikeOthers) {
  const Grid grid = cube_grid();
  vtkNew<vtkTypeInt64Array> numbers;
  numbers->SetName("pedigree");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); i++) numbers->InsertNextValue(i);
  grid->GetPointData()->SetPedigreeIds(numbers);
  filter->SetInputData(grid);
  EXPECT_NE(updated()->GetPointData()->GetArray("pedigree"), nullptr);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetPedigreeIds(), nullptr);
}

}  // namespace
}  // namespace vtk_test
