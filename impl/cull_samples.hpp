// 3.3  Samples outside the simplified boundary, or too near to it, are removed.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

struct CullReport {
  std::int64_t outside = 0, too_near = 0;
  std::int64_t known = 0;  ///< samples whose place was known before
};

/// Keeps, in order, the samples (numbers of points) that are inside the surface and at least min_distance from it,
/// and never nearer than a small part of the nearest triangle's height, which TetGen needs. `topology` is the
/// surface's; at most `leaf` triangles are in a leaf of the k-d tree. Points with may_be_near[v] != 0 (empty: none) may
/// be as near as they are. `known`, of each point (empty: nobody wants it), is what earlier calls with the same
/// surface, distance and leaf found; 0: nothing yet.
CullReport cull_samples(Span<const Vec3> points, const Surface &surface, const SurfaceTopology &topology,
                        double min_distance, std::int64_t leaf, Job &job, Array<std::int32_t> &samples,
                        Span<const std::uint8_t> may_be_near = {}, Span<std::uint8_t> known = {});

}  // namespace tetlod
