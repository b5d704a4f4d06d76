// Point flags: what is flagged stays, and a further filter finds it flagged.
#include <gtest/gtest.h>
#include <vtkIdList.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

// All zero.
vtkSmartPointer<vtkUnsignedCharArray> flags_for(vtkUnstructuredGrid &grid) {
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("flags");
  flags->SetNumberOfValues(grid.GetNumberOfPoints());
  flags->FillValue(0);
  grid.GetPointData()->AddArray(flags);
  return flags;
}

// One of the cells there gets a point of its own, beside it by as little as doubles can be.
vtkIdType divide_point(vtkUnstructuredGrid &grid, vtkIdType point) {
  double p[3];
  grid.GetPoint(point, p);
  p[0] = std::nextafter(p[0], 1);
  const vtkIdType twin = grid.GetPoints()->InsertNextPoint(p);
  vtkPointData &data = *grid.GetPointData();
  for (int i = 0; i < data.GetNumberOfArrays(); i++) data.GetArray(i)->InsertNextTuple(point, data.GetArray(i));
  vtkNew<vtkIdList> cells, corners;
  grid.BuildLinks();
  grid.GetPointCells(point, cells);
  grid.GetCellPoints(cells->GetId(0), corners);
  for (vtkIdType k = 0; k < 4; k++)
    if (corners->GetId(k) == point) corners->SetId(k, twin);
  grid.ReplaceCell(cells->GetId(0), 4, corners->GetPointer(0));
  return twin;
}

TEST_F(Filter, FlaggedPointsSurvive) {
  const Grid grid = cube_grid();
  constexpr vtkIdType kept = 3 * 49 + 3 * 7 + 3;  // the cube's middle
  flags_for(*grid)->SetValue(kept, TETLOD_FLAG_KEEP);
  filter->SetInputData(grid);
  filter->SetRho(1);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flags");
  double middle[3] = {0.5, 0.5, 0.5}, found[3];
  const vtkIdType nearest = updated()->FindPoint(middle);
  ASSERT_GE(nearest, 0) << "no points";
  filter->GetOutput()->GetPoint(nearest, found);
  for (const double x : found) EXPECT_DOUBLE_EQ(x, 0.5);
  auto *const left = vtkUnsignedCharArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("flags"));
  ASSERT_NE(left, nullptr) << "another filter may take them";
  for (vtkIdType v = 0; v < left->GetNumberOfTuples(); v++)
    EXPECT_EQ(left->GetValue(v), v == nearest ? TETLOD_FLAG_KEEP : 0) << v;
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "heat");
  expect_failure("heat", TETLOD_ERR_ARGUMENT);
}

TEST_F(Filter, FlagsOfPointsThatBecameOneSurvive) {
  const Grid grid = cube_grid();
  const vtkIdType twin = divide_point(*grid, 3 * 49 + 3 * 7 + 3);
  double p[3];
  grid->GetPoint(twin, p);
  flags_for(*grid)->SetValue(twin, TETLOD_FLAG_LOCK);
  filter->SetInputData(grid);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flags");
  const vtkIdType found = updated()->FindPoint(p);
  expect_silence();
  double q[3];
  filter->GetOutput()->GetPoint(found, q);
  EXPECT_EQ(q[0], p[0]) << "the flagged one's place";
  auto *const left = vtkUnsignedCharArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("flags"));
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(left->GetValue(found), TETLOD_FLAG_LOCK);
}

}  // namespace
}  // namespace vtk_test
