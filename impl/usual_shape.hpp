// How flat the tets of a mesh usually are.
#pragma once
#include <algorithm>

#include "tet_frame.hpp"

namespace tetlod {

/// shape2(), the median of some thousand tets'. Of a squeezed mesh all are flat.
inline double usual_shape2(Span<const Vec3> points, Span<const Tet> tets, Memory &memory) {
  constexpr std::size_t enough = 4096;
  const auto at = [&](std::int32_t v) { return points[std::size_t(v)]; };
  Array<double> shapes(&memory);
  for (std::size_t i = 0; i < tets.size(); i += tets.size() / enough + 1) {
    const Tet &t = tets[i];
    shapes.push_back(shape2(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
  }
  const auto middle = shapes.begin() + std::ptrdiff_t(shapes.size() / 2);
  std::nth_element(shapes.begin(), middle, shapes.end());
  return *middle;
}

}  // namespace tetlod
