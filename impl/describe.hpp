// What a report says of a mesh, of its boundary, and of how it became coarse.
#pragma once
#include <algorithm>
#include <string>

#include "decimate_solid_and_check.hpp"
#include "pipeline.hpp"
#include "prepare.hpp"
#include "refine.hpp"
#include "remesh.hpp"
#include "status.hpp"
#include "surface_topology.hpp"

namespace tetlod {

inline void describe_input(const Input &input, const Original &original, Report &report) {
  report.points_in = input.xyz[0].tuples;
  report.tets_in = input.tets.tuples;
  report.merged_points = original.merged_points;
  report.nonfinite_points = original.nonfinite_points;
  report.dropped_tets = original.dropped_tets;
  report.divided_tets = std::int64_t(original.replaced.size());
  report.moved_points = std::int64_t(original.moves.upright.size());
  report.scalar_min = original.scalar_min;
  report.scalar_max = original.scalar_max;
  report.keeps_some =
      std::any_of(original.flags.begin(), original.flags.end(), [](std::uint8_t of) { return of != 0; });
}

/// After describe_input().
inline void describe_extraction(const Boundary &boundary, Report &report) {
  report.dropped_tets += boundary.flat_tets + boundary.duplicate_tets;
  report.unused_points = boundary.unused_points - report.merged_points - report.nonfinite_points;
  report.interior_points_in = std::int64_t(boundary.interior.size());
  report.boundary_triangles_in = std::int64_t(boundary.triangles.size());
}

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

inline void describe_remeshing(const RemeshReport &remeshed, std::size_t samples, Report &report) {
  report.samples = std::int64_t(samples) - remeshed.dropped_samples;
  report.steiner_points = remeshed.steiner_points;
  report.remesh_attempts = remeshed.attempts;
  report.reused_collapses = 0;
  report.worker_peak_bytes = remeshed.worker_peak_bytes;
}

/// By collapses alone, whatever was tried before.
inline void describe_collapses(const CoarseSolid &coarse, const Original &original, Report &report) {
  describe_simplified_boundary(coarse.topology, report);
  report.max_deviation = coarse.deviation / original.box.diagonal();
  report.reused_collapses = coarse.reused;
  const auto points = std::int64_t(coarse.mesh.points.size());
  report.samples = report.selected_samples = points - report.boundary_points_out;
  report.samples_outside = report.samples_too_near = report.steiner_points = report.reused_samples = 0;
  report.cleaned_edges = report.reused_triangles = report.boundary_retries = report.remesh_attempts = 0;
  report.worker_peak_bytes = 0;
}

inline void describe_size(const TetMesh &mesh, Report &report) {
  report.points_out = std::int64_t(mesh.points.size());
  report.tets_out = std::int64_t(mesh.tets.size());
}

/// At last: the boundary was moved before it was measured from.
inline void describe_moves(const Original &original, Report &report) {
  report.max_deviation += original.boundary_moved_by / original.box.diagonal();
}

/// What to say where a bound does not hold at these original vertices, whatever of the boundary is kept.
inline std::string failed_bound(double bound, Span<const std::int32_t> beyond, std::int32_t index_base,
                                const Report &report) {
  const std::string where =
      beyond.empty() ? "" : text(" at vertex %lld", static_cast<long long>(beyond[0]) + index_base);
  const std::string why = report.max_error > bound ? "the largest error is " + number(report.max_error)
                                                   : "it is just outside of a tet with other values";
  return "max-error " + number(bound) + " cannot be held" + where + ", with the whole boundary: " + why;
}

inline void describe_refinement(const RefineReport &refined, const Original &original, Report &report) {
  report.max_deviation = std::max(report.max_deviation, refined.deviation / original.box.diagonal());
  report.samples -= refined.removed_samples;
  report.steiner_points -= refined.removed_steiner;
  report.inserted_points = refined.inserted - refined.inserted_on_boundary;
  describe_insertions(refined.inserted_on_boundary, report);
  // What is constant stays so; and no value leaves its field's range, whatever rounding makes of ranges that are no
  // doubles, or far apart.
  const double error = refined.max_error + original.spread_error;
  report.max_error = original.range > 0 ? std::min(error / original.range, 1.0) : 0;
}

}  // namespace tetlod
