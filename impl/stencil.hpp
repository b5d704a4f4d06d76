// 3.5  Points as weighted means of original vertices: what any field of the original becomes there.
#pragma once
#include <array>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Point i is the mean of the original vertices ids[i] with weights[i], which are not negative and add up to 1 within
/// rounding. An original vertex is itself, with weights 1, 0, 0, 0. Every id is a vertex, also one of weight 0.
struct Stencil {
  explicit Stencil(Memory &memory) : ids(&memory), weights(&memory) {}
  Array<std::array<std::int32_t, 4>> ids;
  Array<std::array<double, 4>> weights;
};

/// The vertices of the tet that holds a point, or of the triangle of `boundary` that is nearest to one outside of
/// every tet: three weights and a 0. solid, `leaf`: as locate() has them.
void find_stencils(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points,
                   Span<const std::int32_t> solid, std::int64_t leaf, Job &job, Stencil &stencil);

}  // namespace tetlod
