// Fetching the result: counts, copies in the caller's layout, the report, views.
#include "arguments.hpp"
#include "context.hpp"
#include "write_array.hpp"

namespace tetlod::capi {

namespace {

/// A view of packed memory of the library.
template <class T>
void show(const Array<T> &array, std::int32_t type, std::int32_t components, tetlod_array *out) {
  tetlod_array view{};
  view.type = type;
  view.tuples = std::int64_t(array.size());
  view.components = components;
  view.tuple_stride = sizeof(T);
  view.component_stride = std::int64_t(sizeof(T)) / components;
  view.data = const_cast<T *>(array.data());
  copy_struct(view, out);
}

template <class T>
void set_count(std::int64_t *out, const Array<T> &array) {
  if (out) *out = std::int64_t(array.size());
}

void require_aligned(const std::int64_t *out, const char *name) {
  if (out) require_pointer(out, name);
}

/// Their corners, counted from the base.
template <std::size_t corners>
void fetch_simplices(const Array<std::array<std::int32_t, corners>> &simplices, const char *name, int32_t index_base,
                     tetlod_array *dst) {
  require_index_base(index_base);
  const StridedArray to = checked_destination(dst, {name, int(corners), Shape::integers}, simplices.size());
  write(to, simplices.size(), [&](std::size_t i, int c) { return simplices[i][std::size_t(c)] + index_base; });
}

const TetMesh &last_mesh(const tetlod_context &context) { return last_outcome(context).result.mesh; }

tetlod_run_report report_of(const Outcome &outcome) {
  const Report &from = outcome.result.report;
  const auto seconds = [&](Stage stage) { return from.seconds[std::size_t(stage)]; };
  tetlod_run_report to{};
  to.threads = outcome.threads;
  to.points_in = from.points_in;
  to.tets_in = from.tets_in;
  to.merged_points = from.merged_points;
  to.nonfinite_points = from.nonfinite_points;
  to.dropped_tets = from.dropped_tets;
  to.divided_tets = from.divided_tets;
  to.moved_points = from.moved_points;
  to.unused_points = from.unused_points;
  to.interior_points_in = from.interior_points_in;
  to.boundary_points_in = from.boundary_points_in;
  to.boundary_edges_in = from.boundary_edges_in;
  to.boundary_triangles_in = from.boundary_triangles_in;
  to.components = from.components;
  to.nonmanifold_edges = from.nonmanifold_edges;
  to.nonmanifold_points = from.nonmanifold_points;
  to.cleaned_edges = from.cleaned_edges;
  to.boundary_points_out = from.boundary_points_out;
  to.boundary_edges_out = from.boundary_edges_out;
  to.boundary_triangles_out = from.boundary_triangles_out;
  to.selected_samples = from.selected_samples;
  to.samples_outside = from.samples_outside;
  to.samples_too_near = from.samples_too_near;
  to.samples = from.samples;
  to.steiner_points = from.steiner_points;
  to.inserted_points = from.inserted_points;
  to.max_error = from.max_error;
  to.max_deviation = from.max_deviation;
  to.points_out = from.points_out;
  to.tets_out = from.tets_out;
  to.remesh_attempts = from.remesh_attempts;
  to.boundary_retries = from.boundary_retries;
  to.seconds_prepare = seconds(Stage::prepare);
  to.seconds_boundary = seconds(Stage::boundary);
  to.seconds_decimate = seconds(Stage::decimate);
  to.seconds_sample = seconds(Stage::sample);
  to.seconds_cull = seconds(Stage::cull);
  to.seconds_remesh = seconds(Stage::remesh);
  to.seconds_values = seconds(Stage::values);
  to.seconds_total = from.seconds_total;
  to.peak_bytes = from.peak_bytes;
  to.worker_peak_bytes = from.worker_peak_bytes;
  to.hash = from.hash;
  to.scalar_min = from.scalar_min;
  to.scalar_max = from.scalar_max;
  to.reused_tets = from.reused_tets;
  to.reused_triangles = from.reused_triangles;
  to.reused_samples = from.reused_samples;
  to.reused_collapses = from.reused_collapses;
  return to;
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_fetch_counts(const tetlod_context *handle, int64_t *points, int64_t *tets,
                                  int64_t *boundary_triangles) {
  return entry(handle, [&](const tetlod_context &context) {
    require_aligned(points, "points");
    require_aligned(tets, "tets");
    require_aligned(boundary_triangles, "boundary_triangles");
    const TetMesh &mesh = last_mesh(context);
    set_count(points, mesh.points);
    set_count(tets, mesh.tets);
    set_count(boundary_triangles, mesh.boundary);
  });
}

tetlod_status tetlod_fetch_points(const tetlod_context *handle, tetlod_array *dst) {
  return entry(handle, [&](const tetlod_context &context) {
    const Array<Vec3> &points = last_mesh(context).points;
    const StridedArray to = checked_destination(dst, {"points", 3, Shape::reals}, points.size());
    write(to, points.size(), [&](std::size_t i, int c) { return points[i][c]; });
  });
}

tetlod_status tetlod_fetch_tets(const tetlod_context *handle, int32_t index_base, tetlod_array *dst) {
  return entry(handle, [&](const tetlod_context &context) {
    fetch_simplices(last_mesh(context).tets, "tets", index_base, dst);
  });
}

tetlod_status tetlod_fetch_boundary(const tetlod_context *handle, int32_t index_base, tetlod_array *dst) {
  return entry(handle, [&](const tetlod_context &context) {
    fetch_simplices(last_mesh(context).boundary, "boundary", index_base, dst);
  });
}

tetlod_status tetlod_fetch_scalars(const tetlod_context *handle, tetlod_array *dst) {
  return entry(handle, [&](const tetlod_context &context) {
    const Array<double> &scalars = last_mesh(context).scalars;
    const StridedArray to = checked_destination(dst, {"scalars", 1, Shape::reals}, scalars.size());
    write(to, scalars.size(), [&](std::size_t i, int) { return scalars[i]; });
  });
}

tetlod_status tetlod_fetch_report(const tetlod_context *handle, tetlod_run_report *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_struct(out, "out", TETLOD_SIZE_TO(tetlod_run_report, scalar_max));
    copy_struct(report_of(last_outcome(context)), out);
  });
}

tetlod_status tetlod_view_points(const tetlod_context *handle, tetlod_array *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_view(out);
    show(last_mesh(context).points, TETLOD_FLOAT64, 3, out);
  });
}

tetlod_status tetlod_view_tets(const tetlod_context *handle, tetlod_array *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_view(out);
    show(last_mesh(context).tets, TETLOD_INT32, 4, out);
  });
}

tetlod_status tetlod_view_scalars(const tetlod_context *handle, tetlod_array *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_view(out);
    show(last_mesh(context).scalars, TETLOD_FLOAT64, 1, out);
  });
}
