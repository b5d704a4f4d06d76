// The filter keeps VTK's contract: it runs again when, and only when, something changed; arrays that are not there,
// empty input, an abort from an observer and time steps are what they are for every filter.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <limits>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

using cli_test::Cube;
using cli_test::Kind;

TEST_F(Filter, RunsAgainWhenAPropertyChangedAndOnlyThen) {
  const std::string first = bytes_of(updated());
  const vtkMTimeType then = filter->GetOutput()->GetMTime();
  filter->SetSigma(filter->GetSigma());
  filter->SetRepairFlat(filter->GetRepairFlat());
  EXPECT_EQ(updated()->GetMTime(), then);
  filter->SetSigma(0.9);
  EXPECT_NE(bytes_of(updated()), first);
  filter->SetSigma(1);
  EXPECT_EQ(bytes_of(updated()), first);
  expect_silence();
}

TEST_F(Filter, APropertyOutOfBoundsIsAnErrorAndKeepsItsValue) {
  filter->SetRho(0.25);
  const vtkMTimeType then = filter->GetMTime();
  filter->SetRho(1.5);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UserError + TETLOD_ERR_OPTION));
  filter->SetOption("threads", 0.5);
  filter->SetOption("no-such-option", 1);
  filter->SetPreset(17);
  EXPECT_EQ(filter->GetRho(), 0.25);
  EXPECT_EQ(filter->GetMTime(), then);
  for (const char *part : {"1.5", "threads", "no-such-option", "17"}) EXPECT_TRUE(listener.heard(part)) << part;
  EXPECT_EQ(listener.errors.size(), 4U);
}

TEST_F(Filter, APresetSetsTheOthers) {
  filter->SetPresetToFast();
  EXPECT_EQ(filter->GetTargetRatio(), 0.1);
  EXPECT_EQ(filter->GetEffort(), TETLOD_EFFORT_FAST);
  filter->SetPresetToPaper();
  EXPECT_EQ(filter->GetTargetRatio(), 0.0);
  expect_silence();
}

TEST_F(Filter, AnArrayThatIsNotThere) {
  use_field("cold");
  expect_failure("heat", TETLOD_ERR_ARGUMENT);
  use_field("flow");
  expect_failure("not one number", TETLOD_ERR_ARGUMENT);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "part");
  expect_failure("cell data", TETLOD_ERR_ARGUMENT);
  use_field("heat");
  EXPECT_GT(updated()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
}

TEST_F(Filter, AGridWithoutArrays) {
  const Grid bare = cube_grid();
  bare->GetPointData()->Initialize();
  filter->SetInputData(bare);
  expect_failure("there is no point data", TETLOD_ERR_ARGUMENT);
}

TEST_F(Filter, TheNamedArraySteersAndTheOthersRideAlong) {
  use_field("other");
  vtkPointData *points = updated()->GetPointData();
  EXPECT_STREQ(points->GetScalars()->GetName(), "other");
  EXPECT_EQ(points->GetNumberOfArrays(), 3);
  EXPECT_STREQ(points->GetVectors()->GetName(), "flow") << "vectors stay the active ones";
  const vtkDataArray *part = filter->GetOutput()->GetCellData()->GetArray("part");
  ASSERT_NE(part, nullptr);
  expect_silence();
}

TEST_F(Filter, OtherArraysSteerToo) {
  filter->SetTargetRatio(0.5);
  const std::string riding = bytes_of(updated());
  filter->AddSteeringArray("other", 3);
  const std::string steering = bytes_of(updated());
  EXPECT_NE(steering, riding);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 3);
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "heat");
  filter->AddSteeringArray("other", 0);
  EXPECT_EQ(bytes_of(updated()), riding);
  filter->AddSteeringArray("other", 3);
  EXPECT_EQ(bytes_of(updated()), steering);
  filter->ClearSteeringArrays();
  EXPECT_EQ(bytes_of(updated()), riding);
  expect_silence();
  const vtkMTimeType then = updated()->GetMTime();
  filter->AddSteeringArray("other", -2);
  filter->AddSteeringArray("", 1);
  EXPECT_TRUE(listener.heard("field other: weight -2"));
  EXPECT_TRUE(listener.heard("name is empty"));
  EXPECT_EQ(updated()->GetMTime(), then) << "what is refused changes nothing";
  filter->AddSteeringArray("cold");
  expect_failure("no field 'cold'", TETLOD_ERR_ARGUMENT);
}

void set_unit(vtkDataArray *array, const char *unit) {
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
}

std::string unit_of(vtkDataArray *array) {
  const char *unit = array->HasInformation() ? array->GetInformation()->Get(vtkDataArray::UNITS_LABEL()) : nullptr;
  return unit != nullptr ? unit : "";
}

TEST_F(Filter, UnitsAndNamesOfComponentsStay) {
  const Grid grid = cube_grid();
  set_unit(grid->GetPointData()->GetArray("heat"), "K");
  set_unit(grid->GetPointData()->GetArray("flow"), "m/s");
  set_unit(grid->GetCellData()->GetArray("part"), "1");
  set_unit(grid->GetPoints()->GetData(), "m");
  grid->GetPointData()->GetArray("flow")->SetComponentName(2, "up");
  filter->SetInputData(grid);
  vtkUnstructuredGrid *result = updated();
  EXPECT_EQ(unit_of(result->GetPointData()->GetArray("heat")), "K");
  EXPECT_EQ(unit_of(result->GetPointData()->GetArray("flow")), "m/s");
  EXPECT_EQ(unit_of(result->GetCellData()->GetArray("part")), "1");
  EXPECT_EQ(unit_of(result->GetPoints()->GetData()), "m");
  EXPECT_EQ(unit_of(result->GetPointData()->GetArray("other")), "");
  EXPECT_STREQ(result->GetPointData()->GetArray("flow")->GetComponentName(2), "up");
  const cli_test::Folder folder;
  write_grid(grid, folder / "in.vtu");
  const auto tool = cli_test::run_tool(
      {folder / "in.vtu", folder / "out.vtu", "--field", "heat", "--sigma", "1", "--pictures", folder / "pictures"});
  ASSERT_EQ(tool.status, 0) << tool.err;
  EXPECT_EQ(bytes_of(result), cli_test::contents_of(folder / "out.vtu"));
  EXPECT_NE(cli_test::contents_of(folder / "pictures/report.html").find("heat [K]"), std::string::npos);
}

// No double holds these; arrays of cells are copied, not computed with.
TEST_F(Filter, IntegersOfCellsAreWhatTheyWere) {
  constexpr vtkTypeInt64 large = (vtkTypeInt64{1} << 60) + 1;
  for (const Kind kind : {Kind::tet, Kind::hexahedron}) {
    Cube cube;
    cube.kind = kind;
    const Grid grid = cube_grid(cube);
    vtkNew<vtkTypeInt64Array> numbers;
    numbers->SetName("number");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); i++) numbers->InsertNextValue(large + 2 * i);
    grid->GetCellData()->AddArray(numbers);
    filter->SetInputData(grid);
    vtkCellData &made = *updated()->GetCellData();
    vtkDataArray *const copied = made.GetArray("number");
    ASSERT_TRUE(copied != nullptr && copied->GetDataType() == numbers->GetDataType());
    const auto *const value = static_cast<const vtkTypeInt64 *>(copied->GetVoidPointer(0));
    vtkDataArray &parts = *grid->GetCellData()->GetArray("part");
    for (vtkIdType t = 0; t < copied->GetNumberOfTuples(); t++) {
      const vtkTypeInt64 cell = (value[t] - large) / 2;
      ASSERT_TRUE(value[t] == large + 2 * cell && cell >= 0 && cell < grid->GetNumberOfCells());
      EXPECT_EQ(made.GetArray("part")->GetComponent(t, 0), parts.GetComponent(cell, 0));
    }
  }
  expect_silence();
}

// The library knows the numbers of tets, by which arrays of cells are copied, by a name that no array has.
TEST_F(Filter, AnArrayOfPointsMayHaveAnyName) {
  const Grid grid = cube_grid();
  for (const char *name : {"tet numbers", "tet numbers_"}) {
    const auto copy = vtk::TakeSmartPointer(grid->GetPointData()->GetArray("other")->NewInstance());
    copy->DeepCopy(grid->GetPointData()->GetArray("other"));
    copy->SetName(name);
    grid->GetPointData()->AddArray(copy);
  }
  filter->SetInputData(grid);
  vtkPointData &made = *updated()->GetPointData();
  for (const char *name : {"tet numbers", "tet numbers_"}) {
    vtkDataArray *const carried = made.GetArray(name);
    ASSERT_NE(carried, nullptr) << name;
    for (vtkIdType i = 0; i < carried->GetNumberOfTuples(); i++)
      ASSERT_EQ(carried->GetComponent(i, 0), made.GetArray("other")->GetComponent(i, 0));
  }
  EXPECT_TRUE(filter->GetOutput()->GetCellData()->HasArray("part"));
  expect_silence();
}

TEST_F(Filter, WhatVTKNotesOfAnArraysValuesDoesNotStay) {
  const Grid grid = cube_grid();
  filter->SetInputData(grid);
  const std::string before = bytes_of(updated());
  double range[2];
  grid->GetPointData()->GetArray("flow")->GetRange(range, -1);
  grid->GetPointData()->GetArray("flow")->GetFiniteRange(range, -1);
  ASSERT_TRUE(grid->GetPointData()->GetArray("flow")->HasInformation());
  filter->Modified();
  EXPECT_EQ(bytes_of(updated()), before);
}

TEST_F(Filter, NoCellsAreNoError) {
  filter->SetInputData(vtkNew<vtkUnstructuredGrid>());
  EXPECT_EQ(updated()->GetNumberOfPoints(), 0);
  expect_silence();
}

TEST_F(Filter, TheLibrarysMessageIsTheError) {
  const Grid grid = cube_grid();
  grid->GetPointData()->GetScalars()->SetTuple1(7, std::numeric_limits<double>::quiet_NaN());
  filter->SetInputData(grid);
  expect_failure("nan", TETLOD_ERR_MESH_NONFINITE);
  filter->RepairNonfiniteOn();
  EXPECT_GT(updated()->GetNumberOfCells(), 0);
}

TEST_F(Filter, CellsThatAreNotTetsAreSplit) {
  for (const Kind kind : {Kind::hexahedron, Kind::voxel, Kind::wedge, Kind::pyramid, Kind::quadratic_tet}) {
    Cube cube;
    cube.kind = kind;
    filter->SetInputData(cube_grid(cube));
    EXPECT_GT(updated()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetOutput()->GetCells()->IsHomogeneous(), 4);
  }
  expect_silence();
  const Grid points = cube_grid();
  points->GetCellData()->Initialize();
  const vtkIdType corners[] = {0, 1, 7, 49};
  points->InsertNextCell(VTK_CONVEX_POINT_SET, 4, corners);
  filter->SetInputData(points);
  expect_failure("cannot be split into tets", TETLOD_ERR_ARGUMENT);
}

TEST_F(Filter, GhostCellsAreLeftOut) {
  for (int kind : {vtkDataSetAttributes::DUPLICATECELL, vtkDataSetAttributes::HIDDENCELL}) {
    const Grid grid = cube_grid();
    add_ghosts(*grid, Half::upper, kind);
    filter->SetInputData(grid);
    double bounds[6];
    updated()->GetBounds(bounds);
    EXPECT_EQ(bounds[5], 0.5) << "the upper half is another's, or not to be seen";
    EXPECT_FALSE(filter->GetOutput()->GetCellData()->HasArray(vtkDataSetAttributes::GhostArrayName()));
    EXPECT_EQ(grid->GetNumberOfCells(), 6 * 6 * 6 * 6) << "the input is as it was";
  }
  tetlod_mesh_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(tetlod_check(filter->GetContext(), &report), TETLOD_ERR_STATE) << "the grid's arrays are let go of";
}

TEST_F(Filter, TheErrorIsMeasuredWhenAskedFor) {
  updated();
  EXPECT_EQ(filter->GetErrorRMS(), -1);
  filter->MeasureErrorOn();
  updated();
  EXPECT_GE(filter->GetErrorRMS(), 0);
  EXPECT_LT(filter->GetErrorRMS(), 1e-6) << "the field is linear";
  EXPECT_LE(filter->GetErrorRMS(), filter->GetErrorMaximum());
  EXPECT_EQ(filter->GetErrorOutside(), 0);
  EXPECT_GT(filter->GetSecondsOfRun(), 0);
  filter->MeasureErrorOff();
  updated();
  EXPECT_EQ(filter->GetErrorRMS(), -1) << "nobody has measured this result";
}

TEST_F(Filter, ProgressGoesForwards) {
  Watcher watcher{filter, false, {}};
  filter->SetInputData(cube_grid(large_cube()));
  filter->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::on_progress);
  updated();
  ASSERT_GT(watcher.seen.size(), 2U);
  EXPECT_TRUE(std::is_sorted(watcher.seen.begin(), watcher.seen.end()));
  EXPECT_EQ(watcher.seen.back(), 1.0);
  watcher.seen.clear();
  filter->SetRho(0.02);
  updated();
  ASSERT_FALSE(watcher.seen.empty());
  EXPECT_EQ(watcher.seen.front(), 0.0) << "a second run begins at the beginning";
}

TEST_F(Filter, AnAbortLeavesNothingAndIsNoError) {
  Watcher watcher{filter, true, {}};
  filter->SetInputData(cube_grid(large_cube()));
  filter->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::on_progress);
  EXPECT_EQ(updated()->GetNumberOfPoints(), 0);
  EXPECT_EQ(updated()->GetNumberOfPoints(), 0) << "aborted again: an aborted run is not up to date";
  expect_silence();
  watcher.aborts = false;
  EXPECT_GT(updated()->GetNumberOfPoints(), 0);
}

// The cube whose heat is (1 + t) times x + 2 y + 3 z at time t.
class CubeOverTime : public vtkUnstructuredGridAlgorithm {
 public:
  static CubeOverTime *New();
  int executions = 0;

 protected:
  CubeOverTime() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation *, vtkInformationVector **, vtkInformationVector *outputs) override {
    const double steps[] = {0, 1, 2}, range[] = {0, 2};
    vtkInformation *out = outputs->GetInformationObject(0);
    out->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps, 3);
    out->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }
  int RequestData(vtkInformation *, vtkInformationVector **, vtkInformationVector *outputs) override {
    const double t = outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkUnstructuredGrid *grid = vtkUnstructuredGrid::GetData(outputs);
    grid->ShallowCopy(cube_grid());
    vtkDataArray *heat = grid->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < heat->GetNumberOfTuples(); i++) heat->SetTuple1(i, (1 + t) * heat->GetTuple1(i));
    grid->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), t);
    executions++;
    return 1;
  }
};
vtkStandardNewMacro(CubeOverTime);

TEST_F(Filter, TimeStepsOneAfterAnother) {
  const vtkNew<CubeOverTime> source;
  filter->SetInputConnection(source->GetOutputPort());
  for (const double t : {0.0, 1.0, 2.0, 1.0}) {
    filter->UpdateTimeStep(t);
    vtkUnstructuredGrid *out = filter->GetOutput();
    EXPECT_EQ(out->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), t);
    EXPECT_DOUBLE_EQ(out->GetPointData()->GetScalars()->GetRange()[1], 6 * (1 + t));
  }
  EXPECT_EQ(source->executions, 4);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(source->executions, 4) << "nothing changed";
  expect_silence();
}

TEST_F(Filter, SameBytesAsTheCommandLine) {
  const cli_test::Folder folder;
  Cube cube;
  cube.kind = Kind::hexahedron;
  cli_test::write_cube(folder / "in.vtk", cube);
  const auto tool = cli_test::run_tool({folder / "in.vtk", folder / "out.vtu", "--sigma", "0.4", "--rho", "0.05"});
  ASSERT_EQ(tool.status, 0) << tool.err;
  filter->SetInputData(cube_grid(cube));
  filter->SetSigma(0.4);
  filter->SetRho(0.05);
  EXPECT_EQ(bytes_of(updated()), cli_test::contents_of(folder / "out.vtu"));
}

}  // namespace
}  // namespace vtk_test
