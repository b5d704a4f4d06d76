#include "grid_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkGenericCell.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

namespace tetlod_vtk {
namespace {

using Counts = std::map<int, vtkIdType>;  // of cells, by type

// A cell that is taken by its corners, which VTK lists first.
struct Solid {
  int linear, corners;
};

const std::map<int, Solid> &solids() {
  constexpr Solid tet{VTK_TETRA, 4}, pyramid{VTK_PYRAMID, 5}, wedge{VTK_WEDGE, 6}, hexahedron{VTK_HEXAHEDRON, 8};
  static const std::map<int, Solid> table = {
      {VTK_TETRA, tet},
      {VTK_QUADRATIC_TETRA, tet},
      {VTK_LAGRANGE_TETRAHEDRON, tet},
      {VTK_BEZIER_TETRAHEDRON, tet},
      {VTK_PYRAMID, pyramid},
      {VTK_QUADRATIC_PYRAMID, pyramid},
      {VTK_LAGRANGE_PYRAMID, pyramid},
      {VTK_WEDGE, wedge},
      {VTK_QUADRATIC_WEDGE, wedge},
      {VTK_QUADRATIC_LINEAR_WEDGE, wedge},
      {VTK_BIQUADRATIC_QUADRATIC_WEDGE, wedge},
      {VTK_LAGRANGE_WEDGE, wedge},
      {VTK_BEZIER_WEDGE, wedge},
      {VTK_VOXEL, {VTK_VOXEL, 8}},
      {VTK_HEXAHEDRON, hexahedron},
      {VTK_QUADRATIC_HEXAHEDRON, hexahedron},
      {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, hexahedron},
      {VTK_TRIQUADRATIC_HEXAHEDRON, hexahedron},
      {VTK_LAGRANGE_HEXAHEDRON, hexahedron},
      {VTK_BEZIER_HEXAHEDRON, hexahedron},
  };
  return table;
}

bool is_solid(int type) { return solids().count(type) == 1; }

int dimension_of(int type) {
  const vtkSmartPointer<vtkCell> cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell == nullptr ? 3 : cell->GetCellDimension();
}

std::string named(int type, vtkIdType count) {
  const char *name = vtkCellTypes::GetClassNameFromTypeId(type);
  return std::to_string(count) + " cells of type " + std::to_string(type) + " (" + name + ")";
}

// Another part of the mesh has it, or nobody. VTK would remove such cells, too, but trusts the numbers of all cells
// then.
bool is_ghost(vtkUnsignedCharArray *ghosts, vtkIdType cell) {
  constexpr int marks = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  return ghosts != nullptr && (ghosts->GetValue(cell) & marks) != 0;
}

// Without ghosts.
Counts count_types(vtkUnstructuredGrid &grid) {
  Counts counts;
  vtkUnsignedCharArray *const ghosts = grid.GetCellGhostArray();
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++)
    if (!is_ghost(ghosts, c)) counts[grid.GetCellType(c)]++;
  return counts;
}

// Forgets the types that are left out. Throws for those that cannot be split.
Counts solid_types(Counts counts, std::vector<std::string> &notes) {
  vtkIdType flat = 0;
  for (auto at = counts.begin(); at != counts.end();) {
    const auto [type, count] = *at;
    const bool solid = is_solid(type);
    if (!solid && dimension_of(type) == 3) throw std::runtime_error(named(type, count) + " cannot be split into tets");
    if (!solid) flat += count;
    at = solid ? std::next(at) : counts.erase(at);
  }
  if (flat > 0) notes.push_back(std::to_string(flat) + " cells without a volume are left out");
  if (counts.empty()) throw std::runtime_error("there are no cells with a volume");
  return counts;
}

void note_curved(const Counts &counts, std::vector<std::string> &notes) {
  for (const auto &[type, count] : counts) {
    if (solids().at(type).linear != type) notes.push_back(named(type, count) + " are taken by their corners");
  }
}

// VTK's filters trust the numbers in a file; the library does not, but sees them only afterwards.
void check_cell(vtkIdType cell, vtkIdType size, const vtkIdType *ids, vtkIdType least_size, vtkIdType points) {
  if (size < least_size)
    throw std::runtime_error("cell " + std::to_string(cell) + " has " + std::to_string(size) + " points only");
  const auto bad = std::find_if(ids, ids + size, [points](vtkIdType id) { return id < 0 || id >= points; });
  if (bad == ids + size) return;
  throw std::runtime_error("cell " + std::to_string(cell) + " names point " + std::to_string(*bad) +
                           ", which the mesh does not have");
}

// Calls use(type, ids, cell) for each cell with a volume, ghosts apart.
template <class Use>
void for_each_solid(vtkUnstructuredGrid &grid, int corners_or_more, const Use &use) {
  vtkUnsignedCharArray *const ghosts = grid.GetCellGhostArray();
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) {
    const int type = grid.GetCellType(c);
    if (!is_solid(type) || is_ghost(ghosts, c)) continue;
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    grid.GetCells()->GetCellAtId(c, size, ids);
    check_cell(c, size, ids, std::max(corners_or_more, solids().at(type).corners), grid.GetNumberOfPoints());
    use(type, ids, c);
  }
}

std::array<double, 3> point(vtkUnstructuredGrid &grid, vtkIdType id) {
  std::array<double, 3> p{};
  grid.GetPoint(id, p.data());
  return p;
}

// Corners 0-3, then the middles of 01 12 02 03 13 23. A tet at each corner leaves an octahedron, which its shortest
// diagonal cuts in four; the cell's faces are cut in the same four triangles from both sides.
void cut_quadratic_tet(vtkUnstructuredGrid &grid, const vtkIdType *ids, vtkTypeInt64Array &tets) {
  constexpr int corner[4][4] = {{0, 4, 6, 7}, {1, 5, 4, 8}, {2, 6, 5, 9}, {3, 7, 9, 8}};
  constexpr int diagonal[3][2] = {{4, 9}, {5, 7}, {6, 8}};
  constexpr int ring[3][4] = {{5, 6, 7, 8}, {4, 6, 9, 8}, {4, 5, 9, 7}};
  const auto add = [&](int a, int b, int c, int d) {
    for (int k : {a, b, c, d}) tets.InsertNextValue(ids[k]);
  };
  for (const auto &c : corner) add(c[0], c[1], c[2], c[3]);
  double length[3];
  for (int k = 0; k < 3; k++) {
    const auto p = point(grid, ids[diagonal[k][0]]), q = point(grid, ids[diagonal[k][1]]);
    length[k] = vtkMath::Distance2BetweenPoints(p.data(), q.data());
  }
  const auto best = std::min_element(length, length + 3) - length;
  for (int k = 0; k < 4; k++) add(diagonal[best][0], diagonal[best][1], ring[best][k], ring[best][(k + 1) % 4]);
}

Tets cut_quadratic_tets(vtkUnstructuredGrid &grid) {
  vtkNew<vtkTypeInt64Array> corners, cells;
  for_each_solid(grid, 10, [&](int, const vtkIdType *ids, vtkIdType cell) {
    cut_quadratic_tet(grid, ids, *corners);
    while (cells->GetNumberOfValues() < corners->GetNumberOfValues() / 4) cells->InsertNextValue(cell);
  });
  return {corners, cells};
}

// Of each point, the lowest that is at its place; empty: no two are at one.
using Places = std::vector<vtkIdType>;

Places places_of(vtkUnstructuredGrid &grid) {
  using Bits = std::array<std::uint64_t, 3>;  // ordered whatever the coordinates are
  std::vector<std::pair<Bits, vtkIdType>> points(std::size_t(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); i++) {
    std::array<double, 3> p = point(grid, vtkIdType(i));
    for (double &x : p) x += 0.0;  // -0 is 0
    std::memcpy(points[i].first.data(), p.data(), sizeof p);
    points[i].second = vtkIdType(i);
  }
  std::sort(points.begin(), points.end());
  Places places(points.size());
  bool any = false;
  for (std::size_t i = 0; i < points.size(); i++) {
    const bool again = i > 0 && points[i].first == points[i - 1].first;
    places[std::size_t(points[i].second)] = again ? places[std::size_t(points[i - 1].second)] : points[i].second;
    any = any || again;
  }
  return any ? places : Places();
}

constexpr char kCellNumbers[] = "tetlod cell numbers";

// The solids by their corners, as linear cells over the same points, with their numbers as cell data. With places, over
// the lowest points at these.
vtkSmartPointer<vtkUnstructuredGrid> corner_grid(vtkUnstructuredGrid &grid, const Places &places) {
  auto linear = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkTypeInt64Array> cells;
  cells->SetName(kCellNumbers);
  linear->SetPoints(grid.GetPoints());
  linear->Allocate(grid.GetNumberOfCells());
  for_each_solid(grid, 0, [&](int type, const vtkIdType *ids, vtkIdType cell) {
    const Solid &solid = solids().at(type);
    std::array<vtkIdType, 8> corners{};
    std::transform(ids, ids + solid.corners, corners.begin(),
                   [&](vtkIdType id) { return places.empty() ? id : places[std::size_t(id)]; });
    linear->InsertNextCell(solid.linear, solid.corners, corners.data());
    cells->InsertNextValue(cell);
  });
  linear->GetCellData()->AddArray(cells);
  return linear;
}

bool holds_tets_alone(vtkUnstructuredGrid &grid) {
  const Counts counts = count_types(grid);
  const auto tets = counts.find(VTK_TETRA);
  return tets != counts.end() && tets->second == grid.GetNumberOfCells() && grid.GetCells()->IsHomogeneous() == 4;
}

vtkDataArray *cell_numbers(vtkUnstructuredGrid &grid) { return grid.GetCellData()->GetArray(kCellNumbers); }

// In place of the lowest points at their places, those that their cells have there.
void take_own_points(vtkUnstructuredGrid &grid, const Places &places, const Tets &tets) {
  for (vtkIdType i = 0; i < tets.corners->GetNumberOfValues(); i++) {
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    grid.GetCells()->GetCellAtId(vtkIdType(tets.cells->GetComponent(i / 4, 0)), size, ids);
    const auto place = vtkIdType(tets.corners->GetComponent(i, 0));
    const auto own = std::find_if(ids, ids + size, [&](vtkIdType id) { return places[std::size_t(id)] == place; });
    tets.corners->SetComponent(i, 0, double(*own));
  }
}

// Diagonals of quadrilaterals follow the order of the point numbers, so that neighbours agree.
Tets split(vtkSmartPointer<vtkUnstructuredGrid> grid) {
  if (holds_tets_alone(*grid)) return {grid->GetCells()->GetConnectivityArray(), cell_numbers(*grid)};
  vtkNew<vtkDataSetTriangleFilter> filter;
  filter->TetrahedraOnlyOn();
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid &tets = *filter->GetOutput();
  return {tets.GetCells()->GetConnectivityArray(), cell_numbers(tets)};
}

}  // namespace

Tets tets_of(vtkUnstructuredGrid &grid, std::vector<std::string> &notes) {
  if (holds_tets_alone(grid)) return {grid.GetCells()->GetConnectivityArray(), nullptr};
  const Counts types = solid_types(count_types(grid), notes);
  if (types.size() == 1 && types.count(VTK_QUADRATIC_TETRA) == 1) return cut_quadratic_tets(grid);
  note_curved(types, notes);
  const Places places = places_of(grid);  // blocks of a grid may each have points of their own where they meet
  const Tets tets = split(corner_grid(grid, places));
  if (!places.empty()) take_own_points(grid, places, tets);
  return tets;
}

}  // namespace tetlod_vtk
