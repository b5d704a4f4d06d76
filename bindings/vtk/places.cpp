#include "places.hpp"

#include <vtkMath.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tetlod_vtk {

std::array<double, 3> point(vtkUnstructuredGrid &grid, vtkIdType id) {
  std::array<double, 3> p{};
  grid.GetPoint(id, p.data());
  return p;
}

void orient(vtkUnstructuredGrid &grid, vtkIdType *tet) {
  const auto from = point(grid, tet[0]);
  std::array<double, 3> way[3];
  for (int k = 0; k < 3; k++) {
    way[k] = point(grid, tet[k + 1]);
    for (std::size_t i = 0; i < 3; i++) way[k][i] -= from[i];
  }
  if (vtkMath::Determinant3x3(way[0].data(), way[1].data(), way[2].data()) < 0) std::swap(tet[2], tet[3]);
}

Places::Places(vtkUnstructuredGrid &grid) {
  using Bits = std::array<std::uint64_t, 3>;  // ordered whatever the coordinates are
  std::vector<std::pair<Bits, vtkIdType>> points(std::size_t(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); i++) {
    std::array<double, 3> p = point(grid, vtkIdType(i));
    for (double &x : p) x += 0.0;  // -0 is 0
    std::memcpy(points[i].first.data(), p.data(), sizeof p);
    points[i].second = vtkIdType(i);
  }
  std::sort(points.begin(), points.end());
  lowest_.resize(points.size());
  bool any = false;
  for (std::size_t i = 0; i < points.size(); i++) {
    const bool again = i > 0 && points[i].first == points[i - 1].first;
    lowest_[std::size_t(points[i].second)] = again ? lowest_[std::size_t(points[i - 1].second)] : points[i].second;
    any = any || again;
  }
  if (!any) lowest_.clear();
}

void Places::begin_at_lowest(std::vector<vtkIdType> &face) const {
  const auto lower = [&](vtkIdType a, vtkIdType b) { return rank(a) < rank(b); };
  std::rotate(face.begin(), std::min_element(face.begin(), face.end(), lower), face.end());
}

}  // namespace tetlod_vtk
