// Does a component of a surface lie in the material of another?
#pragma once
#include "job.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

class TreeOnDemand;

/// Throws Status::mesh_intersecting where one does: a solid in a solid. The surface does not cross itself. The face in
/// the message is numbered from `index_base`.
void refuse_nested_solids(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job);

/// Likewise, and where the surface crosses itself.
void refuse_intersections(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job);

}  // namespace tetlod
