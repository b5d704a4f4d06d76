// 3.1  Sampling the interior points with a k-d tree whose leaves have bounded variation.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// One vertex for each leaf of the tree over `vertices`, in the order of the leaves. A node is split while the
/// variation of its values, of any field as it counts, exceeds `variation` (rho times the range of the first); the
/// sample of a leaf is the vertex whose values are nearest the leaf's means, the lowest numbered of equals. `vertices`
/// is reordered.
void sample_interior(const MeshView &mesh, Span<std::int32_t> vertices, double variation, Job &job,
                     Array<std::int32_t> &samples);

/// Vertices with flags[v] != 0 that are not among the samples join them, in the order of their numbers.
void add_flagged(Span<const std::uint8_t> flags, Span<const std::int32_t> vertices, Array<std::int32_t> &samples);

}  // namespace tetlod
