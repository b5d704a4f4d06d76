// Does a component of a surface lie in the material of another?
#pragma once
#include "contacts.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

class TreeOnDemand;

/// Throws Status::mesh_intersecting where one does: a solid in a solid. The surface crosses itself nowhere, but that
/// some components may meet, which are not looked at. The face in the message is numbered from `index_base`.
void refuse_nested_solids(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job, const MayMeet &may_meet = {});

/// Likewise, and where the surface crosses itself.
void refuse_intersections(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job, const MayMeet &may_meet = {});

/// Likewise, but that its solids may be in contact, with themselves, too, if the contacts have that.
void refuse_overlaps(const Surface &surface, const SurfaceTopology &topology, ContactsOnDemand &contacts,
                     TreeOnDemand &tree, std::int32_t index_base, Job &job);

enum class MayTouch { itself, in_contact, other_solids, nothing };

/// What find_topology() says of a mesh's boundary and, unless it may touch itself however much, one of these.
void refuse_unsound(const MeshView &mesh, Span<const Triangle> boundary, MayTouch may_touch, std::int32_t index_base,
                    Job &job);
bool is_sound(const MeshView &mesh, Span<const Triangle> boundary, MayTouch may_touch, Job &job);

}  // namespace tetlod
