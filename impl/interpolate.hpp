// 3.5  Values of the original field at points of the simplified mesh.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// values: of each of `points` those of the fields of `mesh`, linear in the tet that holds the point. A point outside
/// of every tet takes the values at the nearest point of the boundary, so that all values are within their field's
/// range. At most `leaf` tets go down the tree of the points together.
void interpolate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points, std::int64_t leaf,
                 Job &job, Array<double> &values);

}  // namespace tetlod
