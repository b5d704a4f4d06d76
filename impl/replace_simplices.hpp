// Tets and triangles that have some vertices in common, and what comes in their place.
#pragma once
#include "few.hpp"
#include "mesh.hpp"
#include "star_lists.hpp"

namespace tetlod {

using FewVertices = Few<std::int32_t, 3>;

/// Those in the list of the first vertex that have all.
template <std::size_t corners>
void find_with(const FewVertices &vertices, const StarLists &lists,
               const Array<std::array<std::int32_t, corners>> &simplices, Array<std::int32_t> &found) {
  found.clear();
  for (std::int32_t s : lists.of(vertices[0]))
    if (has_all(simplices[std::size_t(s)], vertices)) found.push_back(s);
}

/// Each of `old` with `by` in the place of one of the vertices, for each of them.
template <std::size_t corners>
void replace_each(Span<const std::int32_t> old, const FewVertices &vertices, std::int32_t by,
                  const Array<std::array<std::int32_t, corners>> &simplices,
                  Array<std::array<std::int32_t, corners>> &fresh) {
  fresh.clear();
  for (std::int32_t s : old)
    for (std::int32_t v : vertices) {
      fresh.push_back(simplices[std::size_t(s)]);
      std::replace(fresh.back().begin(), fresh.back().end(), v, by);
    }
}

/// `fresh` take the places of `old`, and further ones.
template <std::size_t corners>
void put(Span<const std::int32_t> old, const Array<std::array<std::int32_t, corners>> &fresh,
         Array<std::array<std::int32_t, corners>> &simplices) {
  for (std::size_t i = 0; i < fresh.size(); i++) {
    if (i < old.size())
      simplices[std::size_t(old[i])] = fresh[i];
    else
      simplices.push_back(fresh[i]);
  }
}

}  // namespace tetlod
