// What the distance from a plane of the boundary counts as, beside the same difference of values.
#pragma once
#include "solid_mesh.hpp"

namespace tetlod {

/// Of a mesh whose quadrics have no planes yet. Where walls are plane beside what the field does along them, or have
/// few of the vertices, to hold them costs next to nothing. Where they are as uneven as the field, or more, they give
/// way.
template <std::size_t m>
double weigh_planes(const SolidMesh<m> &mesh, Job &job);

/// How many times that to a size: where more than a tenth of the tets is kept, the more the larger that part is, as a
/// boundary that is held takes less of it.
double planes_at_size(double kept);

}  // namespace tetlod
