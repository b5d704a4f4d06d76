// Does a surface cross itself?
#pragma once
#include <cstdint>
#include <utility>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

class TreeOnDemand;

/// The first pair of triangles that share more than their common vertices; (-1, -1) when there is none. tree: of them.
std::pair<std::int32_t, std::int32_t> find_crossing(const Surface &surface, TreeOnDemand &tree, Job &job);

/// Throws Status::mesh_intersecting with the vertices of both triangles, numbered from `index_base`.
void refuse_crossing(const Surface &surface, TreeOnDemand &tree, std::int32_t index_base, Job &job);

}  // namespace tetlod
