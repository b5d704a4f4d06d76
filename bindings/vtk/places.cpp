#include "places.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace tetlod_vtk {

Places::Places(vtkUnstructuredGrid &grid) {
  using Bits = std::array<std::uint64_t, 3>;  // ordered whatever the coordinates are
  std::vector<std::pair<Bits, vtkIdType>> points(std::size_t(grid.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); i++) {
    std::array<double, 3> p{};
    grid.GetPoint(vtkIdType(i), p.data());
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

}  // namespace tetlod_vtk
