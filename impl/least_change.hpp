// Whether a field changes along all directions.
#pragma once
#include "mesh.hpp"

namespace tetlod {

/// The mean squared change of the fields that steer along the direction in which they change least, about, of that
/// along all; 0: along a plane or a line at most. Of some thousand tets.
double least_change(const MeshView &mesh);

}  // namespace tetlod
