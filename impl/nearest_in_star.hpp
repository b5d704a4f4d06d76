// Where a vertex can go, among the tets around it.
#pragma once
#include "mesh.hpp"

namespace tetlod {

/// Takes p to about the nearest place to it where vertex v turns none of its tets over, by projections onto the planes
/// that v must not pass. False where that is not found, or farther from v than p was.
bool nearest_in_star(Span<const Tet> tets, std::int32_t v, Span<const Vec3> points, Vec3 &p);

}  // namespace tetlod
