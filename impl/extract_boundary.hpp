// 3.2  The boundary: faces that belong to a single tet, outward. Interior points: the others that tets use.
#pragma once
#include <cstdint>

#include "host_numbers.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

struct Boundary {
  explicit Boundary(Memory &memory) : triangles(&memory), tet_of(&memory), interior(&memory), excluded(&memory) {}
  Array<Triangle> triangles;     ///< original vertices, counter-clockwise seen from outside
  Array<std::int32_t> tet_of;    ///< of each triangle
  Array<std::int32_t> interior;  ///< vertices that tets use and the boundary does not, ascending
  Array<std::uint8_t> excluded;  ///< of each tet, whether it is one of the flat or duplicate ones; empty: none is
  std::int64_t unused_points = 0;
  std::int64_t flat_tets = 0;       ///< tets without volume that were peeled off the boundary
  std::int64_t duplicate_tets = 0;  ///< tets with the four vertices of an earlier one, left out
};

/// Throws Status::mesh_nonmanifold for a face with more than two tets, mesh_degenerate when no tet has a volume,
/// mesh_too_large.
/// numbers: of the mesh's tets.
void extract_boundary(const MeshView &mesh, Job &job, Boundary &boundary, const HostNumbers &numbers = {});

/// The triangles with points of their own, numbered by first use.
void make_surface(const MeshView &mesh, Span<const Triangle> triangles, Job &job, Surface &surface);

}  // namespace tetlod
