// Does a surface cross itself?
#pragma once
#include <cstdint>
#include <utility>

#include "contacts.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

class TreeOnDemand;

/// The first pair of triangles that share more than their common vertices, and may not; (-1, -1) when there is none.
/// tree: of them.
std::pair<std::int32_t, std::int32_t> find_crossing(const Surface &surface, TreeOnDemand &tree, Job &job,
                                                    const MayMeet &may_meet = {});

/// Throws Status::mesh_intersecting with the vertices of both triangles, numbered from `index_base`.
void refuse_crossing(const Surface &surface, TreeOnDemand &tree, std::int32_t index_base, Job &job,
                     const MayMeet &may_meet = {});

}  // namespace tetlod
