#include "decimate_solid_and_check.hpp"

#include <algorithm>

#include "deviation.hpp"
#include "find_crossing.hpp"
#include "geometry.hpp"
#include "predicates.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

constexpr double most_missed = 0.01, most_rounded = 1e-9;

Array<std::uint8_t> touching_vertices(const MeshView &original, const Surface &surface, const SurfaceTopology &topology,
                                      Job &job) {
  Array<std::uint8_t> touching(&job.memory);
  if (topology.nonmanifold_points == 0 && topology.nonmanifold_edges == 0) return touching;
  touching.resize(original.points.size(), 0);
  for (std::size_t p = 0; p < surface.points.size(); p++)
    if (topology.touching[p]) touching[std::size_t(surface.origin[p])] = 1;
  return touching;
}

bool all_positive(const TetMesh &mesh, Job &job) {
  const auto point = [&](std::int32_t v) { return mesh.points[std::size_t(v)]; };
  for (std::size_t t = 0; t < mesh.tets.size(); t++) {
    if (t % 4096 == 0) job.poll(1);
    const Tet &tet = mesh.tets[t];
    if (orientation(point(tet[0]), point(tet[1]), point(tet[2]), point(tet[3])) <= 0) return false;
  }
  return true;
}

/// Positive tets that fill what their boundary encloses, and no more, lie side by side.
bool fills_boundary(const TetMesh &mesh) {
  const auto point = [&](std::int32_t v) { return mesh.points[std::size_t(v)]; };
  const Vec3 middle = box_of(mesh.points).low;
  double filled = 0, enclosed = 0;
  for (const Tet &t : mesh.tets) filled += det(point(t[0]), point(t[1]), point(t[2]), point(t[3]));
  for (const Triangle &t : mesh.boundary) enclosed += det(middle, point(t[0]), point(t[1]), point(t[2]));
  return std::abs(filled - enclosed) <= most_rounded * filled;
}

bool same_topology(const SurfaceTopology &a, const SurfaceTopology &b) {
  return a.components == b.components && a.nonmanifold_edges == b.nonmanifold_edges &&
         a.nonmanifold_points == b.nonmanifold_points;
}

/// Its surface is closed and crosses itself nowhere, and none of its components lies in another's material.
bool has_sound_surface(const SurfaceTopology &topology, std::size_t fields, Job &job, CoarseSolid &coarse) {
  const TetMesh &mesh = coarse.mesh;
  make_surface({mesh.points, mesh.scalars, mesh.tets, fields}, mesh.boundary, job, coarse.surface);
  try {
    find_topology(coarse.surface.points, coarse.surface.triangles, job, coarse.topology);
    if (!same_topology(coarse.topology, topology) || find_crossing(coarse.surface, job).first >= 0) return false;
    if (topology.components > 1) refuse_nested_solids(coarse.surface, coarse.topology, 0, job);
    return true;
  } catch (const Error &error) {
    if (error.status() == Status::mesh_intersecting || error.status() == Status::mesh_nonmanifold) return false;
    throw;
  }
}

}  // namespace

bool decimate_solid_and_check(const MeshView &original, const Boundary &boundary, const Surface &surface,
                              const SurfaceTopology &topology, SolidOptions options, Job &job, CoarseSolid &coarse) {
  const Array<std::uint8_t> touching = touching_vertices(original, surface, topology, job);
  options.touching = touching;
  decimate_solid(original, boundary, surface, options, job, coarse.mesh, coarse.origin);
  if (double(coarse.mesh.tets.size()) > (1 + most_missed) * double(options.tets)) return false;
  if (!all_positive(coarse.mesh, job) || !fills_boundary(coarse.mesh)) return false;
  if (!has_sound_surface(topology, original.fields, job, coarse)) return false;
  coarse.deviation = largest_deviation(surface, coarse.surface, job);
  return true;
}

}  // namespace tetlod
