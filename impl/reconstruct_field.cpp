#include "reconstruct_field.hpp"

#include <algorithm>

#include "interpolate.hpp"

namespace tetlod {

namespace {

/// Of the boundary, as decimation left them, and of samples, as they were.
void take_known_values(const MeshView &original, const Surface &surface, Span<const std::int32_t> samples,
                       Span<const std::int32_t> origin, Array<double> &scalars) {
  const std::size_t boundary = surface.points.size(), fields = original.fields;
  for (std::int32_t of : origin) {
    const auto i = std::size_t(of);
    const double *const values = i < boundary ? surface.scalars.data() + i * fields
                                              : original.scalars.data() + std::size_t(samples[i - boundary]) * fields;
    scalars.insert(scalars.end(), values, values + fields);
  }
}

std::int32_t original_vertex(const Surface &surface, Span<const std::int32_t> samples, std::int32_t origin) {
  const auto boundary = std::int32_t(surface.points.size());
  if (origin < 0) return -1;
  return origin < boundary ? surface.origin[std::size_t(origin)] : samples[std::size_t(origin - boundary)];
}

}  // namespace

Array<std::int32_t> original_vertices(const Remeshed &remeshed, Memory &memory) {
  Array<std::int32_t> origin(&memory);
  origin.reserve(remeshed.result.origin.size());
  for (std::int32_t of : remeshed.result.origin)
    origin.push_back(original_vertex(remeshed.surface, remeshed.samples, of));
  return origin;
}

void reconstruct_field(const MeshView &original, const Boundary &boundary, const Remeshed &remeshed, std::int64_t leaf,
                       Job &job, TetMesh &mesh, Array<std::int32_t> &origin) {
  const auto &[surface, samples, result] = remeshed;
  mesh.scalars.clear();
  mesh.scalars.reserve(original.fields * result.points.size());
  const auto known = std::size_t(std::find(result.origin.begin(), result.origin.end(), -1) - result.origin.begin());
  take_known_values(original, surface, samples, {result.origin.data(), known}, mesh.scalars);
  Array<double> values(&job.memory);
  const Span<const Vec3> steiner{result.points.data() + known, result.points.size() - known};
  interpolate(original, boundary.triangles, steiner, leaf, job, values);
  mesh.scalars.insert(mesh.scalars.end(), values.begin(), values.end());
  origin = original_vertices(remeshed, job.memory);
  mesh.points = std::move(result.points);
  mesh.tets = std::move(result.tets);
  mesh.boundary = std::move(surface.triangles);
}

}  // namespace tetlod
