// What is asked of a surface before TetGen sees it: each of these, left unasked, crashes TetGen or is altered silently.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

struct SurfaceFacts {
  explicit SurfaceFacts(Memory &memory) : component(&memory) {}
  Box box;
  std::int64_t components = 0;    ///< connected through edges of two triangles; more than one may mean a cavity
  Array<std::int32_t> component;  ///< of each triangle: the lowest triangle of its component
};

/// Throws the Status of the first rule that the surface breaks, with the index of the vertex or triangle.
SurfaceFacts check_surface(const Surface &surface, Job &job);

/// Throws Status::mesh_nonfinite.
void check_samples(Span<const Vec3> samples);

/// The volume that triangles enclose, positive when they face outward, and the rounding errors that it may have.
struct Volume {
  double value = 0;
  double uncertainty = 0;
};
Volume enclosed_volume(Span<const Vec3> points, Span<const Triangle> triangles);

}  // namespace tetlod
