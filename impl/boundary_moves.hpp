// What the boundary of a coarse mesh may lose where its vertices move after collapses, and which of them stay.
#pragma once
#include "mesh.hpp"
#include "surface_distance.hpp"

namespace tetlod {

/// What moves of a coarse boundary go by: the original and its tree; the original vertices that stay, empty: none; and
/// whether each of them is guarded against crossings, which takes longer. Else the boundary may come to cross itself:
/// to be looked at.
struct BoundaryMoves {
  const Surface &original;
  const TriangleTree &to_original;
  Span<const std::uint8_t> stays;
  bool are_guarded = false;
};

/// Of the flattest tet's shape before: no tet gets flatter.
constexpr double flattest_part = 0.2;
/// Of the original's volume, that the mesh may lack or have too much.
constexpr double most_volume = 0.005;

/// origin: what each point of the mesh was, see came_from.hpp. stays: of original vertices; empty: none.
inline bool stays_there(std::size_t v, Span<const std::int32_t> origin, Span<const std::uint8_t> stays) {
  return origin[v] >= 0 && !stays.empty() && stays[std::size_t(origin[v])];
}

}  // namespace tetlod
