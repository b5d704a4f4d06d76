// The filter of an installed tetlod in a program with VTK: a cube with a linear field comes back smaller, and exact.
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTetlodSimplify.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdio>

#include "../cube.h"

static vtkNew<vtkUnstructuredGrid> cube() {
  make_points();
  make_tets();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  for (int v = 0; v < kPoints; v++) {
    points->InsertNextPoint(xyz + 3 * v);
    heat->InsertNextValue(values[v]);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  for (int t = 0; t < kTets; t++) {
    const vtkIdType ids[4] = {corners[4 * t], corners[4 * t + 1], corners[4 * t + 2], corners[4 * t + 3]};
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  grid->GetPointData()->SetScalars(heat);
  return grid;
}

int main() {
  const auto grid = cube();
  vtkNew<vtkTetlodSimplify> simplify;
  simplify->SetInputData(grid);
  simplify->SetTargetRatio(0.1);
  simplify->Update();
  vtkUnstructuredGrid *const small = simplify->GetOutput();
  if (small->GetNumberOfCells() == 0 || 10 * small->GetNumberOfCells() > kTets + 10) return 1;
  for (vtkIdType v = 0; v < small->GetNumberOfPoints(); v++)
    if (std::abs(small->GetPointData()->GetScalars()->GetTuple1(v) - linear(small->GetPoint(v))) > 1e-9) return 1;
  std::printf("%lld of %d tets\n", static_cast<long long>(small->GetNumberOfCells()), static_cast<int>(kTets));
  return 0;
}
