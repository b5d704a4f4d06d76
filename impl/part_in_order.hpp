// Parting the vertices of a tree's cell.
#pragma once
#include <algorithm>
#include <cstdint>

#include "memory.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Puts those first for which that holds; all stay in their order, which no standard library decides. Returns how many
/// those are. `others` is for its use.
template <class Is>
std::size_t part_in_order(Span<std::int32_t> vertices, Array<std::int32_t> &others, const Is &is_first) {
  others.clear();
  std::size_t first = 0;
  for (std::int32_t v : vertices) {
    if (is_first(v))
      vertices[first++] = v;
    else
      others.push_back(v);
  }
  std::copy(others.begin(), others.end(), vertices.begin() + first);
  return first;
}

}  // namespace tetlod
