// Triangles with a value a point, and the edges to draw over them.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <string>
#include <vector>

namespace cli {

using Vector = std::array<double, 3>;

inline double dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector &a, const Vector &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Shape {
  std::vector<Vector> points;
  std::vector<double> values;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;
};

// A mesh of the pictures: one field, no other arrays.
struct Sight {
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  vtkDataArray *values;
};
Sight sight_of(vtkUnstructuredGrid *grid, const std::string &field);

Shape surface_of(const Sight &sight);
// Where the coordinate has that value; edges are those of the cells cut.
Shape slice_of(const Sight &sight, int axis, double at);
// Without edges.
Shape isosurface_of(const Sight &sight, double value);

}  // namespace cli
