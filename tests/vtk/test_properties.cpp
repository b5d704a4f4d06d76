// Each property is an option of the library, under VTK's name, and nothing else; what the filter tells of an execution.
#include <gtest/gtest.h>
#include <vtkPointData.h>

#include <map>
#include <set>
#include <sstream>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

struct Property {
  const char *option;
  void (*set)(vtkTetlodSimplify &, double);
  double (*get)(vtkTetlodSimplify &);
};

template <class Type, void (vtkTetlodSimplify::*Set)(Type), Type (vtkTetlodSimplify::*Get)()>
Property property(const char *option) {
  return {option, [](vtkTetlodSimplify &filter, double value) { (filter.*Set)(static_cast<Type>(value)); },
          [](vtkTetlodSimplify &filter) { return static_cast<double>((filter.*Get)()); }};
}

#define PROPERTY(Type, Name, option) \
  property<Type, &vtkTetlodSimplify::Set##Name, &vtkTetlodSimplify::Get##Name>(option)

const Property properties[] = {
    PROPERTY(double, Rho, "rho"),
    PROPERTY(double, Sigma, "sigma"),
    PROPERTY(double, Lambda, "lambda"),
    PROPERTY(double, MinDistance, "min-distance"),
    PROPERTY(double, MergeTolerance, "merge-tolerance"),
    PROPERTY(double, CleanEdges, "clean-edges"),
    PROPERTY(vtkTypeInt64, BoundaryLeaf, "boundary-leaf"),
    PROPERTY(vtkTypeInt64, TetLeaf, "tet-leaf"),
    PROPERTY(double, TargetRatio, "target-ratio"),
    PROPERTY(vtkTypeInt64, Effort, "effort"),
    PROPERTY(bool, Remesh, "remesh"),
    PROPERTY(double, MaxError, "max-error"),
    PROPERTY(double, MaxDeviation, "max-deviation"),
    PROPERTY(vtkTypeInt64, Threads, "threads"),
    PROPERTY(vtkTypeInt64, Seed, "seed"),
    PROPERTY(double, TimeLimit, "time-limit"),
    PROPERTY(bool, RepairCoincident, "on-coincident"),
    PROPERTY(bool, RepairRepeated, "on-repeated"),
    PROPERTY(bool, RepairFlat, "on-flat"),
    PROPERTY(bool, RepairInverted, "on-inverted"),
    PROPERTY(bool, RepairDuplicate, "on-duplicate"),
    PROPERTY(bool, RepairOverlap, "on-overlap"),
    PROPERTY(bool, RepairUnused, "on-unused"),
    PROPERTY(bool, RepairNonfinite, "on-nonfinite"),
};
#undef PROPERTY

std::map<std::string, double> options_of(vtkTetlodSimplify &filter) {
  std::map<std::string, double> values;
  for (int32_t option = 1; tetlod_option_name(option) != nullptr; option++)
    values[tetlod_option_name(option)] = filter.GetOption(tetlod_option_name(option));
  return values;
}

// Within the bounds of the option.
double other_value(const char *option, double value) {
  tetlod_bounds bounds{};
  bounds.struct_size = sizeof bounds;
  EXPECT_EQ(tetlod_option_bounds(tetlod_option_from_name(option), &bounds), TETLOD_OK) << option;
  if (bounds.is_integer != 0) return value == bounds.most ? value - 1 : value + 1;
  return (value + bounds.most) / 4;
}

TEST_F(Filter, EachPropertySetsItsOptionAlone) {
  for (const Property &property : properties) {
    const vtkNew<vtkTetlodSimplify> fresh;
    auto wanted = options_of(*fresh);
    const double value = other_value(property.option, wanted[property.option]);
    ASSERT_NE(value, wanted[property.option]) << property.option;
    wanted[property.option] = value;
    property.set(*fresh, value);
    EXPECT_EQ(options_of(*fresh), wanted) << property.option;
    EXPECT_EQ(property.get(*fresh), value) << property.option;
  }
}

// But for the warm start: the filter's context forgets its runs, as the arrays are others'.
TEST_F(Filter, EveryOptionIsAProperty) {
  std::set<std::string> all, with_property{"warm-start"};
  for (const auto &[option, value] : options_of(*filter)) all.insert(option);
  for (const Property &property : properties) with_property.insert(property.option);
  EXPECT_EQ(with_property, all);
}

TEST_F(Filter, PresetsAndEffortsHaveNames) {
  filter->SetPresetToAccurate();
  EXPECT_EQ(filter->GetEffort(), TETLOD_EFFORT_ACCURATE);
  EXPECT_EQ(filter->GetTargetRatio(), 0.1);
  filter->SetEffortToFast();
  EXPECT_EQ(filter->GetEffort(), TETLOD_EFFORT_FAST);
  filter->SetEffortToAccurate();
  EXPECT_EQ(filter->GetEffort(), TETLOD_EFFORT_ACCURATE);
  expect_silence();
}

TEST_F(Filter, AnOptionThatIsNotThereIsAnErrorToAskFor) {
  EXPECT_EQ(filter->GetOption("no-such-option"), 0);
  EXPECT_TRUE(listener.heard("no option 'no-such-option'"));
  filter->SetOption(nullptr, 1);
  EXPECT_TRUE(listener.heard("no option ''"));
}

TEST_F(Filter, WhatSteersIsNotAskedToTwice) {
  filter->AddSteeringArray("heat");
  expect_failure("field 'heat' steers already: it is the first", TETLOD_ERR_ARGUMENT);
}

TEST_F(Filter, ThreeArraysSteerBesideTheFirst) {
  const Grid grid = cube_grid();
  for (const char *name : {"a", "b", "c"}) {
    const auto copy = vtk::TakeSmartPointer(grid->GetPointData()->GetArray("other")->NewInstance());
    copy->DeepCopy(grid->GetPointData()->GetArray("other"));
    copy->SetName(name);
    grid->GetPointData()->AddArray(copy);
    filter->AddSteeringArray(name);
  }
  filter->SetInputData(grid);
  EXPECT_GT(updated()->GetNumberOfCells(), 0);
  expect_silence();
  filter->AddSteeringArray("other");
  EXPECT_EQ(listener.errors.size(), 1U) << "a fourth";
  EXPECT_GT(updated()->GetNumberOfCells(), 0) << "which is not there then";
}

TEST_F(Filter, AnArrayWithoutANameCannotBeAskedToSteer) {
  filter->AddSteeringArray(nullptr);
  EXPECT_TRUE(listener.heard("name is empty"));
}

TEST_F(Filter, NothingIsMeasuredUntilItIsAskedFor) {
  EXPECT_FALSE(filter->GetMeasureError());
  const vtkMTimeType then = filter->GetMTime();
  filter->MeasureErrorOn();
  EXPECT_TRUE(filter->GetMeasureError());
  EXPECT_GT(filter->GetMTime(), then) << "the filter runs again";
}

TEST_F(Filter, PrintsItsPropertiesAndWhatSteers) {
  filter->SetRho(0.375);
  filter->MeasureErrorOn();
  filter->AddSteeringArray("other", 2.5);
  std::ostringstream text;
  filter->Print(text);
  for (const char *line : {"  rho: 0.375\n", "  SteeringArray: other 2.5\n", "  MeasureError: on\n"})
    EXPECT_NE(text.str().find(line), std::string::npos) << text.str();
}

TEST_F(Filter, TheErrorsReportIsThatOfTheLastExecution) {
  EXPECT_EQ(filter->GetErrorReport().struct_size, 0U);
  filter->MeasureErrorOn();
  updated();
  const tetlod_error_report &report = filter->GetErrorReport();
  EXPECT_EQ(report.struct_size, sizeof report);
  EXPECT_EQ(report.samples_per_tet, 1);
  use_field("cold");
  updated();
  EXPECT_EQ(filter->GetErrorReport().struct_size, 0U) << "it failed";
  for (const double error : {filter->GetErrorRMS(), filter->GetErrorMaximum(), filter->GetErrorOutside()})
    EXPECT_EQ(error, -1);
}

// Of a ball, whose rim is cut off, with a field that is not linear: all of the report's numbers differ.
TEST_F(Filter, ErrorsAreNotTakenForEachOther) {
  const Grid grid = cube_grid(large_cube());
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); i++) {
    double p[3];
    grid->GetPoint(i, p);
    const double x = p[0] - 0.5, y = p[1] - 0.5, z = p[2] - 0.5;
    const double most = std::max({std::abs(x), std::abs(y), std::abs(z)}), length = std::sqrt(x * x + y * y + z * z);
    const double shrink = length > 0 ? most / length : 0;
    grid->GetPoints()->SetPoint(i, x * shrink, y * shrink, z * shrink);
    grid->GetPointData()->GetScalars()->SetTuple1(i, std::sin(9 * x) * std::cos(7 * y) + z);
  }
  filter->SetInputData(grid);
  filter->SetTargetRatio(0.05);
  filter->MeasureErrorOn();
  updated();
  const tetlod_error_report &report = filter->GetErrorReport();
  const std::set<double> all{report.rms,       report.max,       report.outside,
                             report.rms_inner, report.max_inner, report.outside_inner};
  ASSERT_EQ(all.size(), 6U) << "the test looks at nothing";
  EXPECT_EQ(filter->GetErrorRMS(), report.rms);
  EXPECT_EQ(filter->GetErrorMaximum(), report.max);
  EXPECT_EQ(filter->GetErrorOutside(), report.outside);
  expect_silence();
}

TEST_F(Filter, SecondsAreThoseOfTheLastExecution) {
  EXPECT_EQ(filter->GetSecondsOfRun(), 0);
  filter->MeasureErrorOn();
  updated();
  EXPECT_GT(filter->GetSecondsOfRun(), 0);
  EXPECT_GT(filter->GetSecondsOfMeasuring(), 0);
  filter->MeasureErrorOff();
  updated();
  EXPECT_GT(filter->GetSecondsOfRun(), 0);
  EXPECT_EQ(filter->GetSecondsOfMeasuring(), 0);
}

struct Stages {
  vtkTetlodSimplify *filter;
  std::set<std::string> heard;
  void on_progress(vtkObject *, unsigned long, void *) {
    if (filter->GetProgressText() != nullptr) heard.insert(filter->GetProgressText());
  }
};

TEST_F(Filter, TheTextOfProgressIsTheStage) {
  Stages stages{filter, {}};
  filter->AddObserver(vtkCommand::ProgressEvent, &stages, &Stages::on_progress);
  updated();
  for (const char *stage : {"boundary", "decimate", "values"}) EXPECT_EQ(stages.heard.count(stage), 1U) << stage;
}

}  // namespace
}  // namespace vtk_test
