#include "solid_cells.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace tetlod_vtk {
namespace {

struct Shape {
  int corners;
  std::vector<std::vector<int>> faces;
};

const std::map<int, Shape> &shapes() {
  static const std::map<int, Shape> table = {
      {VTK_TETRA, {4, {}}},  // nobody cuts it
      {VTK_PYRAMID, {5, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}},
      {VTK_WEDGE, {6, {{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
      {VTK_VOXEL, {8, {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}}},
      {VTK_HEXAHEDRON, {8, {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}},
      {VTK_PENTAGONAL_PRISM,
       {10, {{0, 1, 2, 3, 4}, {5, 6, 7, 8, 9}, {0, 1, 6, 5}, {1, 2, 7, 6}, {2, 3, 8, 7}, {3, 4, 9, 8}, {4, 0, 5, 9}}}},
      {VTK_HEXAGONAL_PRISM,
       {12,
        {{0, 1, 2, 3, 4, 5},
         {6, 7, 8, 9, 10, 11},
         {0, 1, 7, 6},
         {1, 2, 8, 7},
         {2, 3, 9, 8},
         {3, 4, 10, 9},
         {4, 5, 11, 10},
         {5, 0, 6, 11}}}},
      {VTK_POLYHEDRON, {4, {}}},  // each has its own
  };
  return table;
}

const std::map<int, int> &curved() {
  static const std::map<int, int> linear = {
      {VTK_QUADRATIC_TETRA, VTK_TETRA},
      {VTK_LAGRANGE_TETRAHEDRON, VTK_TETRA},
      {VTK_BEZIER_TETRAHEDRON, VTK_TETRA},
      {VTK_QUADRATIC_PYRAMID, VTK_PYRAMID},
      {VTK_LAGRANGE_PYRAMID, VTK_PYRAMID},
      {VTK_QUADRATIC_WEDGE, VTK_WEDGE},
      {VTK_QUADRATIC_LINEAR_WEDGE, VTK_WEDGE},
      {VTK_BIQUADRATIC_QUADRATIC_WEDGE, VTK_WEDGE},
      {VTK_LAGRANGE_WEDGE, VTK_WEDGE},
      {VTK_BEZIER_WEDGE, VTK_WEDGE},
      {VTK_QUADRATIC_HEXAHEDRON, VTK_HEXAHEDRON},
      {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, VTK_HEXAHEDRON},
      {VTK_TRIQUADRATIC_HEXAHEDRON, VTK_HEXAHEDRON},
      {VTK_LAGRANGE_HEXAHEDRON, VTK_HEXAHEDRON},
      {VTK_BEZIER_HEXAHEDRON, VTK_HEXAHEDRON},
  };
  return linear;
}

void check_points(vtkUnstructuredGrid &grid, vtkIdType cell, const vtkIdType *begin, const vtkIdType *end) {
  const vtkIdType points = grid.GetNumberOfPoints();
  const auto bad = std::find_if(begin, end, [points](vtkIdType id) { return id < 0 || id >= points; });
  if (bad != end)
    throw std::runtime_error("cell " + std::to_string(cell) + " names point " + std::to_string(*bad) +
                             ", which the mesh does not have");
}

// They follow one another in an array: how many, and of each how many points, and these.
void get_own_faces(vtkUnstructuredGrid &grid, vtkIdType cell, Faces &faces) {
  const auto broken = [cell] {
    return std::runtime_error("the faces of cell " + std::to_string(cell) + " are broken");
  };
  vtkIdTypeArray *const all = grid.GetFaces(), *const places = grid.GetFaceLocations();
  if (all == nullptr || places == nullptr || cell >= places->GetNumberOfValues()) throw broken();
  vtkIdType at = places->GetValue(cell);
  const vtkIdType end = all->GetNumberOfValues();
  const auto next = [&] {
    if (at < 0 || at >= end) throw broken();
    return all->GetValue(at++);
  };
  faces.clear();
  for (vtkIdType left = next(); left > 0; left--) {
    const vtkIdType size = next();
    if (size < 0 || size > end - at) throw broken();
    const vtkIdType *const first = all->GetPointer(at);
    check_points(grid, cell, first, first + size);
    faces.emplace_back(first, first + size);
    at += size;
  }
  if (faces.empty()) throw broken();
}

}  // namespace

int linear_type(int type) {
  const auto found = curved().find(type);
  return found == curved().end() ? type : found->second;
}

bool is_solid(int type) { return shapes().count(linear_type(type)) == 1; }

bool is_ghost(vtkUnstructuredGrid &grid, vtkIdType cell) {
  constexpr int marks = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  vtkUnsignedCharArray *const ghosts = grid.GetCellGhostArray();
  return ghosts != nullptr && (ghosts->GetValue(cell) & marks) != 0;
}

const vtkIdType *points_of(vtkUnstructuredGrid &grid, vtkIdType cell, int least) {
  vtkIdType size = 0;
  const vtkIdType *ids = nullptr;
  grid.GetCells()->GetCellAtId(cell, size, ids);
  if (size < least)
    throw std::runtime_error("cell " + std::to_string(cell) + " has " + std::to_string(size) + " points only");
  check_points(grid, cell, ids, ids + size);
  return ids;
}

void get_faces(vtkUnstructuredGrid &grid, vtkIdType cell, Faces &faces) {
  const int type = linear_type(grid.GetCellType(cell));
  if (type == VTK_POLYHEDRON) return get_own_faces(grid, cell, faces);
  const Shape &shape = shapes().at(type);
  const vtkIdType *const ids = points_of(grid, cell, shape.corners);
  faces.resize(shape.faces.size());
  for (std::size_t f = 0; f < faces.size(); f++) {
    faces[f].clear();
    for (const int corner : shape.faces[f]) faces[f].push_back(ids[corner]);
  }
}

}  // namespace tetlod_vtk
