// What the distance from a plane of the boundary counts as, beside the same difference of values.
#pragma once
#include "solid_mesh.hpp"

namespace tetlod {

/// Of a mesh whose quadrics have no planes yet. Where walls are plane beside what the field does along them, or have
/// few of the vertices, to hold them costs next to nothing. Where they are as uneven as the field, or more, they give
/// way.
template <std::size_t m>
double weigh_planes(const SolidMesh<m> &mesh, Job &job);

/// Where that part of the tets is kept, of that. The more is left, the less of it a boundary takes that is held.
double planes_at_size(double kept);

}  // namespace tetlod
