// Where the field of a simplified mesh is compared with the original's, and in which tet each such point lies.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// Gives `mesh`, which is connected and has values, its probes: every original vertex that a tet uses, and
/// random points in original tets, more of them where the field changes more: with vertices alone the mesh would be
/// fitted to them and go its own way in between. Vertices outside of the mesh are left out, or, with project_outside,
/// compared at the nearest point of its boundary; their number is returned.
std::int64_t place_probes(const MeshView &original, bool project_outside, Job &job, AdaptiveMesh &mesh);

}  // namespace tetlod
