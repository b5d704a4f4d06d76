// 3.1, past the paper: samples where a linear field would be wrong.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// At most `target` of the vertices with is_interior[v] != 0: one for each leaf of a k-d tree over all `vertices`, the
/// interior one nearest the leaf's centroid. The leaf whose values linear functions of the position fit worst is
/// split first, at the middle of the axis that leaves least; thin leaves, which ruin a Delaunay mesh, are not made.
void sample_residual(const MeshView &mesh, Array<std::int32_t> &vertices, Span<const std::uint8_t> is_interior,
                     std::size_t target, Job &job, Array<std::int32_t> &samples);

}  // namespace tetlod
