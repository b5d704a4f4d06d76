/* Where the members of the public structs are, and how large: as programs were compiled that run today. Members are
 * only added at the ends; a line is added here then, and none is changed. Of 64-bit machines. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "tetlod.h"

typedef struct place {
  size_t at, size, once_at, once_size, structure_size;
  const char *structure, *member;
} place;

#define SIZE_OF(type, member) sizeof(((type *)0)->member)
#define PLACE(name, member, once_at, once_size)                                                                        \
  {                                                                                                                    \
    offsetof(tetlod_##name, member), SIZE_OF(tetlod_##name, member), once_at, once_size, sizeof(tetlod_##name), #name, \
        #member                                                                                                        \
  }

static const place places[] = {
    PLACE(array, struct_size, 0, 4),
    PLACE(array, type, 4, 4),
    PLACE(array, tuples, 8, 8),
    PLACE(array, components, 16, 4),
    PLACE(array, reserved, 20, 4),
    PLACE(array, tuple_stride, 24, 8),
    PLACE(array, component_stride, 32, 8),
    PLACE(array, data, 40, 8),
    PLACE(config, struct_size, 0, 4),
    PLACE(config, api_version, 4, 4),
    PLACE(config, allocate, 8, 8),
    PLACE(config, release, 16, 8),
    PLACE(config, allocator_user, 24, 8),
    PLACE(config, memory_limit, 32, 8),
    PLACE(config, remesher, 40, 8),
    PLACE(run_report, struct_size, 0, 4),
    PLACE(run_report, threads, 4, 4),
    PLACE(run_report, points_in, 8, 8),
    PLACE(run_report, tets_in, 16, 8),
    PLACE(run_report, merged_points, 24, 8),
    PLACE(run_report, nonfinite_points, 32, 8),
    PLACE(run_report, dropped_tets, 40, 8),
    PLACE(run_report, unused_points, 48, 8),
    PLACE(run_report, interior_points_in, 56, 8),
    PLACE(run_report, boundary_points_in, 64, 8),
    PLACE(run_report, boundary_edges_in, 72, 8),
    PLACE(run_report, boundary_triangles_in, 80, 8),
    PLACE(run_report, components, 88, 8),
    PLACE(run_report, nonmanifold_edges, 96, 8),
    PLACE(run_report, nonmanifold_points, 104, 8),
    PLACE(run_report, cleaned_edges, 112, 8),
    PLACE(run_report, boundary_points_out, 120, 8),
    PLACE(run_report, boundary_edges_out, 128, 8),
    PLACE(run_report, boundary_triangles_out, 136, 8),
    PLACE(run_report, selected_samples, 144, 8),
    PLACE(run_report, samples_outside, 152, 8),
    PLACE(run_report, samples_too_near, 160, 8),
    PLACE(run_report, samples, 168, 8),
    PLACE(run_report, steiner_points, 176, 8),
    PLACE(run_report, points_out, 184, 8),
    PLACE(run_report, tets_out, 192, 8),
    PLACE(run_report, remesh_attempts, 200, 8),
    PLACE(run_report, boundary_retries, 208, 8),
    PLACE(run_report, seconds_prepare, 216, 8),
    PLACE(run_report, seconds_boundary, 224, 8),
    PLACE(run_report, seconds_decimate, 232, 8),
    PLACE(run_report, seconds_sample, 240, 8),
    PLACE(run_report, seconds_cull, 248, 8),
    PLACE(run_report, seconds_remesh, 256, 8),
    PLACE(run_report, seconds_values, 264, 8),
    PLACE(run_report, seconds_total, 272, 8),
    PLACE(run_report, peak_bytes, 280, 8),
    PLACE(run_report, worker_peak_bytes, 288, 8),
    PLACE(run_report, hash, 296, 8),
    PLACE(run_report, scalar_min, 304, 8),
    PLACE(run_report, scalar_max, 312, 8),
    PLACE(run_report, inserted_points, 320, 8),
    PLACE(run_report, max_error, 328, 8),
    PLACE(run_report, max_deviation, 336, 8),
    PLACE(run_report, reused_tets, 344, 8),
    PLACE(run_report, reused_triangles, 352, 8),
    PLACE(run_report, reused_samples, 360, 8),
    PLACE(run_report, reused_collapses, 368, 8),
    PLACE(run_report, divided_tets, 376, 8),
    PLACE(run_report, moved_points, 384, 8),
    PLACE(error_report, struct_size, 0, 4),
    PLACE(error_report, samples_per_tet, 4, 4),
    PLACE(error_report, rms, 8, 8),
    PLACE(error_report, max, 16, 8),
    PLACE(error_report, outside, 24, 8),
    PLACE(error_report, rms_inner, 32, 8),
    PLACE(error_report, max_inner, 40, 8),
    PLACE(error_report, outside_inner, 48, 8),
    PLACE(defect, count, 0, 8),
    PLACE(defect, first, 8, 8),
    PLACE(mesh_report, struct_size, 0, 4),
    PLACE(mesh_report, status, 4, 4),
    PLACE(mesh_report, points, 8, 8),
    PLACE(mesh_report, tets, 16, 8),
    PLACE(mesh_report, boundary_triangles, 24, 8),
    PLACE(mesh_report, components, 32, 8),
    PLACE(mesh_report, index, 40, 16),
    PLACE(mesh_report, repeated, 56, 16),
    PLACE(mesh_report, nonfinite_points, 72, 16),
    PLACE(mesh_report, nonfinite_values, 88, 16),
    PLACE(mesh_report, coincident, 104, 16),
    PLACE(mesh_report, flat, 120, 16),
    PLACE(mesh_report, inverted, 136, 16),
    PLACE(mesh_report, duplicate, 152, 16),
    PLACE(mesh_report, nonmanifold_faces, 168, 16),
    PLACE(mesh_report, overlapping, 184, 16),
    PLACE(mesh_report, unused, 200, 16),
    PLACE(mesh_report, nonmanifold_edges, 216, 16),
    PLACE(mesh_report, nonmanifold_points, 232, 16),
    PLACE(bounds, struct_size, 0, 4),
    PLACE(bounds, is_integer, 4, 4),
    PLACE(bounds, least, 8, 8),
    PLACE(bounds, most, 16, 8),
    PLACE(bounds, preset, 24, 8),
};

enum { kPlaces = sizeof places / sizeof *places, kAlignment = 8 };

static int is_where_it_was(const place *of) {
  if (of->at == of->once_at && of->size == of->once_size) return 1;
  printf("%s.%s is %zu bytes at byte %zu, and was %zu at %zu\n", of->structure, of->member, of->size, of->at,
         of->once_size, of->once_at);
  return 0;
}

/* A struct ends with the last of its members that are listed, or one is missing here. */
static int is_complete(size_t i) {
  const place *last = places + i;
  if (i + 1 < kPlaces && strcmp(places[i + 1].structure, last->structure) == 0) return 1;
  const size_t end = (last->at + last->size + kAlignment - 1) / kAlignment * kAlignment;
  if (end == last->structure_size) return 1;
  printf("%s is %zu bytes, of which %zu are listed\n", last->structure, last->structure_size, end);
  return 0;
}

int main(void) {
  int wrong = 0;
  for (size_t i = 0; i < kPlaces; i++) wrong |= !is_where_it_was(places + i) | !is_complete(i);
  if (!wrong) printf("ok: %d members are where they were\n", (int)kPlaces);
  return wrong;
}
