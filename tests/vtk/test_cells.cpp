// Cells of each kind become tets that fill them, and whose faces are the same as those of the cells beside them.
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "filter_fixture.hpp"
#include "tetlod.h"

namespace vtk_test {
namespace {

using cli_test::Cube;
using cli_test::Kind;

constexpr int size = 6;  // of the cube

Grid cube_of(Kind kind) {
  Cube cube;
  cube.kind = kind;
  return cube_grid(cube);
}

vtkIdType renamed_point(vtkUnstructuredGrid &from, vtkUnstructuredGrid &to, vtkIdType id, vtkIdType name) {
  to.GetPoints()->SetPoint(name, from.GetPoint(id));
  to.GetPointData()->GetScalars()->SetTuple1(name, from.GetPointData()->GetScalars()->GetTuple1(id));
  return name;
}

// The same, its points in random order; those cells that are_polyhedra(number) says of are given by their faces.
template <class ArePolyhedra>
Grid shuffled(vtkUnstructuredGrid &grid, unsigned seed, const ArePolyhedra &are_polyhedra) {
  std::vector<vtkIdType> name(std::size_t(grid.GetNumberOfPoints()));
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), std::mt19937(seed));
  auto other = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(grid.GetNumberOfPoints());
  other->SetPoints(points);
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  heat->SetNumberOfTuples(grid.GetNumberOfPoints());
  other->GetPointData()->SetScalars(heat);
  for (vtkIdType v = 0; v < grid.GetNumberOfPoints(); v++) renamed_point(grid, *other, v, name[std::size_t(v)]);
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    vtkCell *const cell = grid.GetCell(c);
    vtkNew<vtkIdList> ids;
    const auto add = [&](vtkIdList &of) {
      for (vtkIdType k = 0; k < of.GetNumberOfIds(); k++) ids->InsertNextId(name[std::size_t(of.GetId(k))]);
    };
    if (!are_polyhedra(c)) {
      add(*cell->GetPointIds());
      other->InsertNextCell(cell->GetCellType(), ids);
      continue;
    }
    ids->InsertNextId(cell->GetNumberOfFaces());
    for (int f = 0; f < cell->GetNumberOfFaces(); f++) {
      ids->InsertNextId(cell->GetFace(f)->GetNumberOfPoints());
      add(*cell->GetFace(f)->GetPointIds());
    }
    other->InsertNextCell(VTK_POLYHEDRON, ids);
  }
  return other;
}

// Two prisms on a polygon, one on the other; heat is the height.
Grid prisms(int sides, int type) {
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> heat;
  for (int layer = 0; layer < 3; layer++)
    for (int k = 0; k < sides; k++) {
      const double turn = 2 * std::acos(-1.0) * k / sides;
      points->InsertNextPoint(std::cos(turn), std::sin(turn), layer);
      heat->InsertNextValue(layer);
    }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(heat);
  for (int layer = 0; layer < 2; layer++) {
    std::vector<vtkIdType> ids(std::size_t(2 * sides));
    std::iota(ids.begin(), ids.end(), vtkIdType(layer * sides));
    grid->InsertNextCell(type, vtkIdType(ids.size()), ids.data());
  }
  return grid;
}

double volume_of(vtkUnstructuredGrid &grid) {
  double sum = 0;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    vtkIdType count = 0;
    const vtkIdType *ids = nullptr;
    grid.GetCells()->GetCellAtId(c, count, ids);
    double p[4][3], e[3][3];
    for (int k = 0; k < 4; k++) grid.GetPoint(ids[k], p[k]);
    for (int k = 0; k < 3; k++)
      for (int i = 0; i < 3; i++) e[k][i] = p[k + 1][i] - p[0][i];
    sum +=
        std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                 e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
        6;
  }
  return sum;
}

class Cells : public Filter {
 protected:
  // Every edge of the boundary is kept, so that the solid stays what it is.
  void expect_filled(vtkUnstructuredGrid *grid, double volume, std::int64_t boundary_triangles) {
    filter->SetInputData(grid);
    EXPECT_NEAR(volume_of(*updated()), volume, 1e-9);
    EXPECT_TRUE(listener.errors.empty()) << listener.errors.front();
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    ASSERT_EQ(tetlod_fetch_report(filter->GetContext(), &report), TETLOD_OK);
    EXPECT_EQ(report.boundary_triangles_in, boundary_triangles);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.divided_tets, 0);
    EXPECT_EQ(report.dropped_tets, 0);
    EXPECT_EQ(report.moved_points, 0);
  }
};

TEST_F(Cells, NeighboursFit) {
  for (const Kind kind : {Kind::tet, Kind::hexahedron, Kind::voxel, Kind::wedge, Kind::pyramid, Kind::polyhedron})
    for (const unsigned seed : {1U, 2U, 3U}) {
      const auto none = [](vtkIdType) { return false; };
      const auto all = [](vtkIdType) { return true; };
      const Grid cube = cube_of(kind);
      const Grid grid = kind == Kind::polyhedron ? shuffled(*cube, seed, all) : shuffled(*cube, seed, none);
      expect_filled(grid, 1, 6 * size * size * 2);
    }
}

TEST_F(Cells, PolyhedraFitOthers) {
  for (const Kind kind : {Kind::tet, Kind::hexahedron, Kind::wedge, Kind::pyramid})
    for (const unsigned seed : {1U, 2U, 3U}) {
      const auto third = [](vtkIdType c) { return c % 3 == 0; };
      expect_filled(shuffled(*cube_of(kind), seed, third), 1, 6 * size * size * 2);
    }
}

TEST_F(Cells, PrismsOfFiveAndSixSides) {
  const auto none = [](vtkIdType) { return false; };
  const auto second = [](vtkIdType c) { return c == 1; };
  for (const auto &[sides, type] : {std::pair(5, VTK_PENTAGONAL_PRISM), std::pair(6, VTK_HEXAGONAL_PRISM)}) {
    const double area = 0.5 * sides * std::sin(2 * std::acos(-1.0) / sides);
    const int triangles = 2 * sides + 2 * 2 * sides;
    for (const unsigned seed : {1U, 2U, 3U}) {
      const Grid grid = prisms(sides, type);
      expect_filled(shuffled(*grid, seed, none), 2 * area, triangles);
      expect_filled(shuffled(*grid, seed, second), 2 * area, triangles);
    }
  }
}

// Point data of middles are means, so that what is linear stays so, and they have no flags; cells keep their data.
TEST_F(Cells, PolyhedraKeepTheirData) {
  const auto all = [](vtkIdType) { return true; };
  const Grid grid = shuffled(*cube_of(Kind::hexahedron), 1, all);
  vtkNew<vtkDoubleArray> number;
  number->SetName("number");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); c++) number->InsertNextValue(double(c));
  grid->GetCellData()->AddArray(number);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("flags");
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); v++) flags->InsertNextValue(TETLOD_FLAG_KEEP);
  grid->GetPointData()->AddArray(flags);
  vtkNew<vtkDoubleArray> constant;
  constant->SetName("constant");
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); v++) constant->InsertNextValue(0.1);
  grid->GetPointData()->AddArray(constant);
  vtkNew<vtkIntArray> whole;  // numbers, whose means are none
  whole->SetName("whole");
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); v++)
    whole->InsertNextValue(int(std::lround(size * grid->GetPoint(v)[0])));
  grid->GetPointData()->AddArray(whole);
  filter->SetInputData(grid);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flags");
  filter->SetTargetRatio(0.9);
  filter->SetMaxError(1e-9);
  vtkUnstructuredGrid &out = *updated();
  EXPECT_TRUE(listener.errors.empty()) << listener.errors.front();
  EXPECT_GE(out.GetNumberOfPoints(), grid->GetNumberOfPoints()) << "those that are flagged";
  EXPECT_LT(out.GetNumberOfPoints(), grid->GetNumberOfPoints() + grid->GetNumberOfCells()) << "middles are not";
  ASSERT_NE(out.GetCellData()->GetArray("number"), nullptr);
  double range[2];
  out.GetCellData()->GetArray("number")->GetRange(range);
  EXPECT_EQ(range[0], 0);
  EXPECT_EQ(range[1], double(grid->GetNumberOfCells() - 1));
  for (vtkIdType v = 0; v < out.GetNumberOfPoints(); v++) {
    const double *const p = out.GetPoint(v);
    EXPECT_NEAR(out.GetPointData()->GetScalars()->GetTuple1(v), p[0] + 2 * p[1] + 3 * p[2], 1e-6);
    EXPECT_EQ(out.GetPointData()->GetArray("constant")->GetTuple1(v), 0.1);
    EXPECT_NEAR(out.GetPointData()->GetArray("whole")->GetTuple1(v), size * p[0], 1e-9);
  }
}

// Two prisms of any number of sides, as polyhedra with points of their own where they meet.
Grid apart(int sides, double jump) {
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("heat");
  for (const int layer : {0, 1, 1, 2})
    for (int k = 0; k < sides; k++) {
      const double turn = 2 * std::acos(-1.0) * k / sides;
      heat->InsertNextValue(layer +
                            (points->InsertNextPoint(std::cos(turn), std::sin(turn), layer) < 2 * sides ? 0 : jump));
    }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(heat);
  for (const int low : {0, 2 * sides}) {
    vtkNew<vtkIdList> faces;
    const auto add = [&](const std::vector<int> &face) {
      faces->InsertNextId(vtkIdType(face.size()));
      for (const int v : face) faces->InsertNextId(low + v);
    };
    const auto count = static_cast<std::size_t>(sides);
    std::vector<int> bottom(count), top(count);
    std::iota(bottom.begin(), bottom.end(), 0);
    std::iota(top.begin(), top.end(), sides);
    faces->InsertNextId(sides + 2);
    add(bottom);
    add(top);
    for (int k = 0; k < sides; k++) add({k, (k + 1) % sides, sides + (k + 1) % sides, sides + k});
    grid->InsertNextCell(VTK_POLYHEDRON, faces);
  }
  return grid;
}

// A field that jumps there has both values at the middles of their common face, too.
TEST_F(Cells, PolyhedraStayApartWhereAFieldJumps) {
  constexpr int sides = 40;
  filter->SetTargetRatio(0.9);
  for (const double jump : {0.0, 100.0}) {
    filter->SetInputData(apart(sides, jump));
    EXPECT_GT(updated()->GetNumberOfCells(), 0);
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    ASSERT_EQ(tetlod_fetch_report(filter->GetContext(), &report), TETLOD_OK);
    EXPECT_EQ(report.components, jump > 0 ? 2 : 1);
    EXPECT_EQ(report.merged_points, jump > 0 ? 0 : sides + 1);
    EXPECT_LT(report.max_error, 0.001);
  }
}

// A seam that is locked has its middles, too.
TEST_F(Cells, MiddlesOfFacesThatAreLockedAreLocked) {
  constexpr int sides = 40;
  const Grid grid = apart(sides, 0);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("flags");
  for (vtkIdType v = 0; v < grid->GetNumberOfPoints(); v++) flags->InsertNextValue(v < sides ? TETLOD_FLAG_LOCK : 0);
  grid->GetPointData()->AddArray(flags);
  filter->SetInputData(grid);
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flags");
  filter->SetTargetRatio(0.5);
  vtkUnstructuredGrid &out = *updated();
  int on_seam = 0, middles = 0;
  for (vtkIdType v = 0; v < out.GetNumberOfPoints(); v++) {
    const double *const p = out.GetPoint(v);
    on_seam += p[2] == 0;
    middles += p[2] == 0 && std::hypot(p[0], p[1]) < 1e-9;
  }
  EXPECT_EQ(on_seam, sides + 1);
  EXPECT_EQ(middles, 1);
  EXPECT_EQ(flags->GetNumberOfTuples(), 4 * sides) << "the input is as it was";
}

// A prism one of whose corners is there twice, on a hexahedron whose top is bent.
TEST_F(Cells, FacesWithARepeatedPointFit) {
  auto grid = Grid::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> heat;
  for (int layer = 0; layer < 3; layer++)
    for (const auto &[x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 1.0), std::pair(0.0, 1.0)}) {
      const double bent = layer == 1 && x + y == 2 ? 0.3 : 0;
      points->InsertNextPoint(x, y, layer + bent);
      heat->InsertNextValue(x + layer);
    }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(heat);
  const vtkIdType below[] = {0, 1, 2, 3, 4, 5, 6, 7}, above[] = {4, 5, 6, 7, 7, 8, 9, 10, 11, 11};
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, below);
  grid->InsertNextCell(VTK_PENTAGONAL_PRISM, 10, above);
  expect_filled(grid, 2, 20);
}

TEST_F(Cells, APolyhedronOfNoPointsIsNone) {
  const Grid grid = cube_of(Kind::polyhedron);
  grid->GetCellData()->Initialize();
  for (const auto &faces : {std::vector<vtkIdType>{1, 0}, {2, 1, 0, 2, 0, 1}}) {
    vtkNew<vtkIdList> ids;
    for (const vtkIdType id : faces) ids->InsertNextId(id);
    grid->InsertNextCell(VTK_POLYHEDRON, ids);
  }
  expect_filled(grid, 1, 6 * size * size * 2);
}

// Whichever piece has polyhedra.
TEST_F(Cells, PiecesWithPolyhedraAndWithout) {
  const cli_test::Folder folder;
  Cube shifted;
  shifted.kind = Kind::polyhedron;
  shifted.shift = 1;
  write_grid(cube_of(Kind::hexahedron), folder / "hexahedra.vtu");
  write_grid(cube_grid(shifted), folder / "polyhedra.vtu");
  for (const std::string pieces : {R"(<Piece Source="hexahedra.vtu"/><Piece Source="polyhedra.vtu"/>)",
                                   R"(<Piece Source="polyhedra.vtu"/><Piece Source="hexahedra.vtu"/>)"}) {
    std::ofstream(folder / "in.pvtu")
        << R"(<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid GhostLevel="0">
<PPointData Scalars="heat"><PDataArray type="Float64" Name="heat"/></PPointData>
<PPoints><PDataArray type="Float64" NumberOfComponents="3"/></PPoints>)"
        << pieces << "</PUnstructuredGrid></VTKFile>";
    const cli_test::Outcome said =
        cli_test::run_tool({folder / "in.pvtu", folder / "out.vtu", "--target-ratio", "0.5"});
    EXPECT_EQ(said.status, 0) << said.err;
  }
}

TEST_F(Cells, FacesThatAreBrokenAreRefused) {
  const auto with = [](vtkIdType place, vtkIdType value) {
    const Grid cube = cube_of(Kind::polyhedron);
    cube->GetFaces()->SetValue(place, value);
    return cube;
  };
  constexpr vtkIdType huge = vtkIdType(1) << 40;
  for (const auto &[place, value, message] :
       {std::tuple(vtkIdType(0), huge, "the faces of cell 0 are broken"),
        std::tuple(vtkIdType(0), vtkIdType(0), "are broken"), std::tuple(vtkIdType(1), huge, "are broken"),
        std::tuple(vtkIdType(1), vtkIdType(-3), "are broken"), std::tuple(vtkIdType(2), huge, "names point"),
        std::tuple(vtkIdType(2), vtkIdType(-1), "cell 0 names point -1")}) {
    filter->SetInputData(with(place, value));
    expect_failure(message, TETLOD_ERR_ARGUMENT);
  }
  const Grid cube = cube_of(Kind::polyhedron);
  cube->GetFaceLocations()->SetValue(7, huge);
  filter->SetInputData(cube);
  expect_failure("the faces of cell 7 are broken", TETLOD_ERR_ARGUMENT);
}

}  // namespace
}  // namespace vtk_test
