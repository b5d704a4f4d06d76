// What a report says of the boundary.
#pragma once
#include "pipeline.hpp"
#include "surface_topology.hpp"

namespace tetlod {

inline void describe_boundary(const SurfaceTopology &original, Report &report) {
  report.boundary_points_in = original.used_points;
  report.boundary_edges_in = original.edges;
  report.components = original.components;
  report.nonmanifold_edges = original.nonmanifold_edges;
  report.nonmanifold_points = original.nonmanifold_points;
}

inline void describe_simplified_boundary(const SurfaceTopology &simplified, Report &report) {
  report.boundary_points_out = simplified.used_points;
  report.boundary_edges_out = simplified.edges;
  report.boundary_triangles_out = std::int64_t(simplified.component.size());
}

/// Each, in a triangle or on an edge, brings three edges and two triangles.
inline void describe_insertions(std::int64_t vertices, Report &report) {
  report.boundary_points_out += vertices;
  report.boundary_edges_out += 3 * vertices;
  report.boundary_triangles_out += 2 * vertices;
}

}  // namespace tetlod
