// How the triangles of a closed surface hang together, also where it touches itself at vertices and along edges.
#pragma once
#include <cstdint>

#include "host_numbers.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Of a point where the surface touches itself: it is an end of an edge with four triangles or more; the cut takes it
/// apart.
constexpr std::uint8_t at_nonmanifold_edge = 1, cut_apart = 2;

/// The surface cut apart where it touches itself. Half-edge 3 t + k runs from corner k of triangle t to corner k + 1.
struct SurfaceTopology {
  explicit SurfaceTopology(Memory &memory)
      : mate(&memory), sheet_vertex(&memory), vertex_of(&memory), touching(&memory), component(&memory) {}

  Array<std::int32_t> mate;  ///< of each half-edge: the one that runs the other way in the neighbouring triangle
  Array<std::int32_t> sheet_vertex;  ///< of each corner 3 t + k: the vertex of the cut surface that it is
  Array<std::int32_t> vertex_of;     ///< of each vertex of the cut surface: the surface's vertex
  Array<std::uint8_t> touching;      ///< of each point of the surface: how it touches itself there, or 0

  Array<std::int32_t> component;  ///< of each triangle: the number of its component

  std::int64_t edges = 0;  ///< of the surface as it is
  std::int64_t used_points = 0;
  std::int64_t components = 0;          ///< of the cut surface: solids that only touch, and cavities, count apart
  std::int64_t nonmanifold_edges = 0;   ///< with four triangles or more
  std::int64_t nonmanifold_points = 0;  ///< that the cut takes apart
};

/// At an edge with more than two triangles those that bound the same wedge of material are mates.
/// Throws Status::mesh_intersecting where the triangles around an edge do not bound wedges: the solid overlaps itself.
/// numbers: of the points.
void find_topology(Span<const Vec3> points, Span<const Triangle> triangles, Job &job, SurfaceTopology &topology,
                   const HostNumbers &numbers = {});

}  // namespace tetlod
