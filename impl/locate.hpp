// 3.5  Where points lie in the original mesh: in which tet, or at which point of the boundary.
#pragma once
#include <array>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Either tet or triangle is not -1. Weights are not negative and add up to 1 within rounding; a point with the very
/// coordinates of a vertex has that vertex's weight 1 and all others 0.
struct Place {
  std::int32_t tet = -1;       ///< the tet that holds the point
  std::int32_t triangle = -1;  ///< of the boundary, for a point outside of every tet: where the nearest point lies
  std::array<double, 4> weights{};
};

/// Of each point the tet that holds it (within rounding), of several the one that holds it best, then the lowest; -1:
/// none. In its solid, solid[i], where the mesh says of several, else solid is empty. At most `leaf` tets go down the
/// tree of the points together.
Array<std::int32_t> find_tets(const MeshView &mesh, Span<const Vec3> points, Span<const std::int32_t> solid,
                              std::int64_t leaf, Job &job);

/// places[i]: of points[i], as above, or on the boundary.
void locate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points,
            Span<const std::int32_t> solid, std::int64_t leaf, Job &job, Array<Place> &places);

}  // namespace tetlod
