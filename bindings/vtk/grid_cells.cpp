#include "grid_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkGenericCell.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <utility>

#include "places.hpp"
#include "solid_cells.hpp"

namespace tetlod_vtk {
namespace {

using Counts = std::map<int, vtkIdType>;  // of cells, by type

int dimension_of(int type) {
  const vtkSmartPointer<vtkCell> cell = vtk::TakeSmartPointer(vtkGenericCell::InstantiateCell(type));
  return cell == nullptr ? 3 : cell->GetCellDimension();
}

std::string named(int type, vtkIdType count) {
  const char *name = vtkCellTypes::GetClassNameFromTypeId(type);
  return std::to_string(count) + " cells of type " + std::to_string(type) + " (" + name + ")";
}

// Without ghosts.
Counts count_types(vtkUnstructuredGrid &grid) {
  Counts counts;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++)
    if (!is_ghost(grid, c)) counts[grid.GetCellType(c)]++;
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
    if (linear_type(type) != type) notes.push_back(named(type, count) + " are taken by their corners");
  }
}

// Calls use(cell) for each cell with a volume, ghosts apart.
template <class Use>
void for_each_solid(vtkUnstructuredGrid &grid, const Use &use) {
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++)
    if (is_solid(grid.GetCellType(c)) && !is_ghost(grid, c)) use(c);
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
  for_each_solid(grid, [&](vtkIdType cell) {
    cut_quadratic_tet(grid, points_of(grid, cell, 10), *corners);
    while (cells->GetNumberOfValues() < corners->GetNumberOfValues() / 4) cells->InsertNextValue(cell);
  });
  return {corners, cells};
}

bool holds_tets_alone(vtkUnstructuredGrid &grid) {
  const Counts counts = count_types(grid);
  const auto tets = counts.find(VTK_TETRA);
  return tets != counts.end() && tets->second == grid.GetNumberOfCells() && grid.GetCells()->IsHomogeneous() == 4;
}

// Cells become the tets from their first corner to the triangles of the faces that do not have it, and faces are cut
// from their first corner on, so that neighbours agree; the first is the one with the lowest number at its place.
class Pulling {
 public:
  explicit Pulling(vtkUnstructuredGrid &grid) : grid_(grid), places_(grid) {}

  Tets tets() {
    for_each_solid(grid_, [&](vtkIdType cell) {
      if (linear_type(grid_.GetCellType(cell)) == VTK_TETRA) return add(cell, points_of(grid_, cell, 4));
      get_faces(grid_, cell, faces_);
      pull(cell);
    });
    return {corners_, cells_};
  }

 private:
  void pull(vtkIdType cell) {
    vtkIdType apex = faces_[0][0];
    for (auto &face : faces_) {
      places_.begin_at_lowest(face);
      if (places_.rank(face[0]) < places_.rank(apex)) apex = face[0];
    }
    for (const auto &face : faces_)
      for (std::size_t k = 2; k < face.size(); k++) {
        vtkIdType tet[] = {apex, face[0], face[k - 1], face[k]};
        if (!are_different(tet)) continue;
        orient(grid_, tet);
        add(cell, tet);
      }
  }

  // They are not of the faces at the apex, nor of a cell whose corners are not all different.
  bool are_different(const vtkIdType *tet) const {
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < i; j++)
        if (places_.rank(tet[i]) == places_.rank(tet[j])) return false;
    return true;
  }

  void add(vtkIdType cell, const vtkIdType *tet) {
    for (int k = 0; k < 4; k++) corners_->InsertNextValue(tet[k]);
    cells_->InsertNextValue(cell);
  }

  vtkUnstructuredGrid &grid_;
  const Places places_;
  Faces faces_;
  vtkNew<vtkTypeInt64Array> corners_, cells_;
};

}  // namespace

Tets tets_of(vtkUnstructuredGrid &grid, std::vector<std::string> &notes) {
  if (holds_tets_alone(grid)) return {grid.GetCells()->GetConnectivityArray(), nullptr};
  const Counts types = solid_types(count_types(grid), notes);
  if (types.size() == 1 && types.count(VTK_QUADRATIC_TETRA) == 1) return cut_quadratic_tets(grid);
  note_curved(types, notes);
  return Pulling(grid).tets();
}

}  // namespace tetlod_vtk
