/* Where the members of the public structs are: as programs were compiled that run today. Members are only added at the
 * ends; a line is added here then, and none is changed. Of 64-bit machines. */
#include <stddef.h>
#include <stdio.h>

#include "tetlod.h"

typedef struct place {
  const char *member;
  size_t now, once;
} place;

static const place places[] = {
    {"array.struct_size", offsetof(tetlod_array, struct_size), 0},
    {"array.type", offsetof(tetlod_array, type), 4},
    {"array.tuples", offsetof(tetlod_array, tuples), 8},
    {"array.components", offsetof(tetlod_array, components), 16},
    {"array.reserved", offsetof(tetlod_array, reserved), 20},
    {"array.tuple_stride", offsetof(tetlod_array, tuple_stride), 24},
    {"array.component_stride", offsetof(tetlod_array, component_stride), 32},
    {"array.data", offsetof(tetlod_array, data), 40},
    {"config.struct_size", offsetof(tetlod_config, struct_size), 0},
    {"config.api_version", offsetof(tetlod_config, api_version), 4},
    {"config.allocate", offsetof(tetlod_config, allocate), 8},
    {"config.release", offsetof(tetlod_config, release), 16},
    {"config.allocator_user", offsetof(tetlod_config, allocator_user), 24},
    {"config.memory_limit", offsetof(tetlod_config, memory_limit), 32},
    {"config.remesher", offsetof(tetlod_config, remesher), 40},
    {"run_report.struct_size", offsetof(tetlod_run_report, struct_size), 0},
    {"run_report.threads", offsetof(tetlod_run_report, threads), 4},
    {"run_report.points_in", offsetof(tetlod_run_report, points_in), 8},
    {"run_report.tets_in", offsetof(tetlod_run_report, tets_in), 16},
    {"run_report.merged_points", offsetof(tetlod_run_report, merged_points), 24},
    {"run_report.nonfinite_points", offsetof(tetlod_run_report, nonfinite_points), 32},
    {"run_report.dropped_tets", offsetof(tetlod_run_report, dropped_tets), 40},
    {"run_report.unused_points", offsetof(tetlod_run_report, unused_points), 48},
    {"run_report.interior_points_in", offsetof(tetlod_run_report, interior_points_in), 56},
    {"run_report.boundary_points_in", offsetof(tetlod_run_report, boundary_points_in), 64},
    {"run_report.boundary_edges_in", offsetof(tetlod_run_report, boundary_edges_in), 72},
    {"run_report.boundary_triangles_in", offsetof(tetlod_run_report, boundary_triangles_in), 80},
    {"run_report.components", offsetof(tetlod_run_report, components), 88},
    {"run_report.nonmanifold_edges", offsetof(tetlod_run_report, nonmanifold_edges), 96},
    {"run_report.nonmanifold_points", offsetof(tetlod_run_report, nonmanifold_points), 104},
    {"run_report.cleaned_edges", offsetof(tetlod_run_report, cleaned_edges), 112},
    {"run_report.boundary_points_out", offsetof(tetlod_run_report, boundary_points_out), 120},
    {"run_report.boundary_edges_out", offsetof(tetlod_run_report, boundary_edges_out), 128},
    {"run_report.boundary_triangles_out", offsetof(tetlod_run_report, boundary_triangles_out), 136},
    {"run_report.selected_samples", offsetof(tetlod_run_report, selected_samples), 144},
    {"run_report.samples_outside", offsetof(tetlod_run_report, samples_outside), 152},
    {"run_report.samples_too_near", offsetof(tetlod_run_report, samples_too_near), 160},
    {"run_report.samples", offsetof(tetlod_run_report, samples), 168},
    {"run_report.steiner_points", offsetof(tetlod_run_report, steiner_points), 176},
    {"run_report.points_out", offsetof(tetlod_run_report, points_out), 184},
    {"run_report.tets_out", offsetof(tetlod_run_report, tets_out), 192},
    {"run_report.remesh_attempts", offsetof(tetlod_run_report, remesh_attempts), 200},
    {"run_report.boundary_retries", offsetof(tetlod_run_report, boundary_retries), 208},
    {"run_report.seconds_prepare", offsetof(tetlod_run_report, seconds_prepare), 216},
    {"run_report.seconds_boundary", offsetof(tetlod_run_report, seconds_boundary), 224},
    {"run_report.seconds_decimate", offsetof(tetlod_run_report, seconds_decimate), 232},
    {"run_report.seconds_sample", offsetof(tetlod_run_report, seconds_sample), 240},
    {"run_report.seconds_cull", offsetof(tetlod_run_report, seconds_cull), 248},
    {"run_report.seconds_remesh", offsetof(tetlod_run_report, seconds_remesh), 256},
    {"run_report.seconds_values", offsetof(tetlod_run_report, seconds_values), 264},
    {"run_report.seconds_total", offsetof(tetlod_run_report, seconds_total), 272},
    {"run_report.peak_bytes", offsetof(tetlod_run_report, peak_bytes), 280},
    {"run_report.worker_peak_bytes", offsetof(tetlod_run_report, worker_peak_bytes), 288},
    {"run_report.hash", offsetof(tetlod_run_report, hash), 296},
    {"run_report.scalar_min", offsetof(tetlod_run_report, scalar_min), 304},
    {"run_report.scalar_max", offsetof(tetlod_run_report, scalar_max), 312},
    {"run_report.inserted_points", offsetof(tetlod_run_report, inserted_points), 320},
    {"run_report.max_error", offsetof(tetlod_run_report, max_error), 328},
    {"run_report.max_deviation", offsetof(tetlod_run_report, max_deviation), 336},
    {"run_report.reused_tets", offsetof(tetlod_run_report, reused_tets), 344},
    {"run_report.reused_triangles", offsetof(tetlod_run_report, reused_triangles), 352},
    {"run_report.reused_samples", offsetof(tetlod_run_report, reused_samples), 360},
    {"error_report.struct_size", offsetof(tetlod_error_report, struct_size), 0},
    {"error_report.samples_per_tet", offsetof(tetlod_error_report, samples_per_tet), 4},
    {"error_report.rms", offsetof(tetlod_error_report, rms), 8},
    {"error_report.max", offsetof(tetlod_error_report, max), 16},
    {"error_report.outside", offsetof(tetlod_error_report, outside), 24},
    {"error_report.rms_inner", offsetof(tetlod_error_report, rms_inner), 32},
    {"error_report.max_inner", offsetof(tetlod_error_report, max_inner), 40},
    {"error_report.outside_inner", offsetof(tetlod_error_report, outside_inner), 48},
    {"defect.count", offsetof(tetlod_defect, count), 0},
    {"defect.first", offsetof(tetlod_defect, first), 8},
    {"mesh_report.struct_size", offsetof(tetlod_mesh_report, struct_size), 0},
    {"mesh_report.status", offsetof(tetlod_mesh_report, status), 4},
    {"mesh_report.points", offsetof(tetlod_mesh_report, points), 8},
    {"mesh_report.tets", offsetof(tetlod_mesh_report, tets), 16},
    {"mesh_report.boundary_triangles", offsetof(tetlod_mesh_report, boundary_triangles), 24},
    {"mesh_report.components", offsetof(tetlod_mesh_report, components), 32},
    {"mesh_report.index", offsetof(tetlod_mesh_report, index), 40},
    {"mesh_report.repeated", offsetof(tetlod_mesh_report, repeated), 56},
    {"mesh_report.nonfinite_points", offsetof(tetlod_mesh_report, nonfinite_points), 72},
    {"mesh_report.nonfinite_values", offsetof(tetlod_mesh_report, nonfinite_values), 88},
    {"mesh_report.coincident", offsetof(tetlod_mesh_report, coincident), 104},
    {"mesh_report.flat", offsetof(tetlod_mesh_report, flat), 120},
    {"mesh_report.inverted", offsetof(tetlod_mesh_report, inverted), 136},
    {"mesh_report.duplicate", offsetof(tetlod_mesh_report, duplicate), 152},
    {"mesh_report.nonmanifold_faces", offsetof(tetlod_mesh_report, nonmanifold_faces), 168},
    {"mesh_report.overlapping", offsetof(tetlod_mesh_report, overlapping), 184},
    {"mesh_report.unused", offsetof(tetlod_mesh_report, unused), 200},
    {"mesh_report.nonmanifold_edges", offsetof(tetlod_mesh_report, nonmanifold_edges), 216},
    {"mesh_report.nonmanifold_points", offsetof(tetlod_mesh_report, nonmanifold_points), 232},
    {"bounds.struct_size", offsetof(tetlod_bounds, struct_size), 0},
    {"bounds.is_integer", offsetof(tetlod_bounds, is_integer), 4},
    {"bounds.least", offsetof(tetlod_bounds, least), 8},
    {"bounds.most", offsetof(tetlod_bounds, most), 16},
    {"bounds.preset", offsetof(tetlod_bounds, preset), 24},
};

int main(void) {
  int moved = 0;
  for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
    if (places[i].now == places[i].once) continue;
    printf("%s is at byte %zu, and was at %zu\n", places[i].member, places[i].now, places[i].once);
    moved = 1;
  }
  if (!moved) printf("ok: %zu members are where they were\n", sizeof places / sizeof *places);
  return moved;
}
