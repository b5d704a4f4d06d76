// A judge of results that shares no code with the library.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "vtu_file.hpp"

namespace real_test {

/// Points of the same coordinates become one, tets without four different vertices or without volume go.
TetFile repaired(const TetFile &mesh);

struct Facts {
  double volume = 0;                   ///< of the tets, absolute
  std::int64_t not_positive = 0;       ///< tets that are inside out or flat
  std::int64_t over_shared = 0;        ///< faces of more than two tets
  std::int64_t folded = 0;             ///< faces whose two tets lie on the same side
  std::int64_t open_edges = 0;         ///< of the boundary, run through more often one way than the other
  std::int64_t nonmanifold_edges = 0;  ///< of the boundary, with more than two faces
  std::int64_t unused = 0;             ///< points of no tet
  std::int64_t components = 0, euler = 0, boundary_triangles = 0;
  double boundary_volume = 0;  ///< by the divergence theorem
};
Facts facts_of(const TetFile &mesh);

/// The share of the original's vertices that lie outside the result, and the root mean square of the error at the
/// others, over the range of the original's values.
struct FieldError {
  double rms = 0, outside = 0;
};
FieldError field_error(const TetFile &original, const TetFile &result);

}  // namespace real_test
