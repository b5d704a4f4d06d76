/* The result: what it is, how fetching it can be refused, the report, views, the error and the histogram. */
#include <math.h>

#include "c99_support.h"

/* ---- What a result is ----------------------------------------------------------------------------------------------
 */

static double volume_of(const result *r, const int32_t *q) {
  double e[3][3];
  int k, c;
  for (k = 0; k < 3; k++)
    for (c = 0; c < 3; c++) e[k][c] = r->xyz[3 * q[k + 1] + c] - r->xyz[3 * q[0] + c];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

/* Of the cone from the origin over a triangle: over a closed surface they add up to its volume. */
static double cone_of(const result *r, const int32_t *t) {
  const double *a = r->xyz + 3 * t[0], *b = r->xyz + 3 * t[1], *c = r->xyz + 3 * t[2];
  return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
          a[2] * (b[0] * c[1] - b[1] * c[0])) /
         6;
}

static void check_volumes(const result *r) {
  double inside = 0, enclosed = 0;
  int64_t i, flat = 0;
  for (i = 0; i < r->tets; i++) {
    const double volume = volume_of(r, r->corners + 4 * i);
    flat += !(volume > 0);
    inside += volume;
  }
  for (i = 0; i < r->triangles; i++) enclosed += cone_of(r, r->boundary + 3 * i);
  CHECK(flat == 0);
  CHECK(fabs(inside - enclosed) < 1e-12);
  CHECK(fabs(inside - 1) < 0.05);
}

static void check_range(const result *r) {
  int64_t i, wrong = 0;
  for (i = 0; i < r->points; i++) wrong += !(r->values[i] >= 1 && r->values[i] <= 8);
  CHECK(wrong == 0);
}

/* Where the boundary is kept, a linear field comes back as it was: at every vertex, and between them. A boundary vertex
 * that decimation places beside its edge does not have that: its value is the edge's [3.2]. */
static void check_linear(const cube *mesh) {
  tetlod_context *context = new_context();
  tetlod_error_report error = {.struct_size = sizeof error};
  result r;
  int64_t i, wrong = 0;
  submit_cube(context, mesh);
  OK(context, tetlod_set_sigma(context, 1));
  OK(context, tetlod_set_rho(context, 0.25));
  OK(context, tetlod_run(context));
  r = fetch_result(context);
  for (i = 0; i < r.points; i++) wrong += !(fabs(r.values[i] - linear_field(r.xyz + 3 * i)) <= 1e-12);
  CHECK(wrong == 0);
  OK(context, tetlod_measure_error(context, 4, &error));
  CHECK(error.max <= 1e-12 && error.max_inner <= 1e-12);
  CHECK(error.outside < 0.01 && error.outside_inner < 0.01);
  tetlod_destroy(context);
  free_result(&r);
}

static void check_report(const tetlod_context *context, const result *r, const cube *mesh) {
  tetlod_run_report report;
  memset(&report, 0xff, sizeof report);
  report.struct_size = sizeof report;
  OK(context, tetlod_fetch_report(context, &report));
  CHECK(report.struct_size == sizeof report);
  CHECK(report.points_in == mesh->points && report.tets_in == mesh->tets);
  CHECK(report.points_out == r->points && report.tets_out == r->tets);
  CHECK(report.boundary_triangles_out == r->triangles);
  CHECK(report.boundary_points_in == 98 && report.boundary_triangles_in == 192 && report.boundary_edges_in == 288);
  CHECK(report.interior_points_in == 27 && report.components == 1);
  CHECK(report.boundary_points_out + report.samples + report.steiner_points == report.points_out);
  CHECK(report.merged_points == 0 && report.dropped_tets == 0 && report.unused_points == 0);
  CHECK(report.scalar_min == 1 && report.scalar_max == 8);
  CHECK(report.threads == 1 && report.remesh_attempts >= 1);
  CHECK(report.peak_bytes > 0 && report.seconds_total > 0 && report.seconds_total < 60);
}

/* ---- Refusals ------------------------------------------------------------------------------------------------------
 */

static void nothing_to_fetch(void) {
  tetlod_context *context = new_context();
  double room[3] = {7, 7, 7};
  tetlod_array array = array_of(TETLOD_FLOAT64, 1, 3, room), view = {.struct_size = sizeof view}, before = view;
  tetlod_run_report report = {.struct_size = sizeof report, .threads = 7};
  tetlod_error_report error = {.struct_size = sizeof error, .samples_per_tet = 7};
  int64_t n = 7;
  FAILS(context, tetlod_fetch_counts(context, &n, &n, &n), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_fetch_points(context, &array), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_fetch_tets(context, 0, &array), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_fetch_boundary(context, 0, &array), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_fetch_scalars(context, &array), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_fetch_report(context, &report), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_view_points(context, &view), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_view_tets(context, &view), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_view_scalars(context, &view), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_measure_error(context, 0, &error), TETLOD_ERR_STATE, "no result");
  FAILS(context, tetlod_histogram(context, 1, 1, &n), TETLOD_ERR_STATE, "no result");
  CHECK(n == 7 && room[0] == 7 && report.threads == 7 && error.samples_per_tet == 7);
  CHECK(memcmp(&view, &before, sizeof view) == 0);
  tetlod_destroy(context);
}

typedef tetlod_status (*fetch_fn)(const tetlod_context *context, tetlod_array *dst);

static tetlod_status fetch_tets_0(const tetlod_context *context, tetlod_array *dst) {
  return tetlod_fetch_tets(context, 0, dst);
}

static tetlod_status fetch_boundary_1(const tetlod_context *context, tetlod_array *dst) {
  return tetlod_fetch_boundary(context, 1, dst);
}

/* dst spoiled in one way after the other; it and the memory behind it stay as they are. */
static void refuse_destinations(const tetlod_context *context, fetch_fn fetch, int32_t type, int64_t tuples,
                                int32_t components) {
  guarded memory = new_guarded((size_t)(tuples * components * 8));
  const tetlod_array good = array_of(type, tuples, components, guarded_data(&memory));
  tetlod_array bad = good, before;
#define REFUSED(status, words) \
  before = bad;                \
  FAILS(context, fetch(context, &bad), status, words), CHECK(memcmp(&bad, &before, sizeof bad) == 0), bad = good
  FAILS(context, fetch(context, NULL), TETLOD_ERR_ARGUMENT, "NULL");
  bad.struct_size = 8;
  REFUSED(TETLOD_ERR_STRUCT_SIZE, "struct_size 8");
  bad.reserved = 1;
  REFUSED(TETLOD_ERR_ARGUMENT, "reserved 1");
  bad.type = TETLOD_UINT8;
  REFUSED(TETLOD_ERR_ARGUMENT, "type 5");
  bad.type = type == TETLOD_FLOAT64 ? TETLOD_INT64 : TETLOD_FLOAT64;
  REFUSED(TETLOD_ERR_ARGUMENT, "type");
  bad.components = 2;
  REFUSED(TETLOD_ERR_ARGUMENT, "2 components");
  bad.tuples = -5;
  REFUSED(TETLOD_ERR_ARGUMENT, "-5 tuples");
  bad.tuples = tuples - 1;
  REFUSED(TETLOD_ERR_BUFFER_SIZE, "room tuples");
  bad.tuples = 0;
  REFUSED(TETLOD_ERR_BUFFER_SIZE, "room 0 tuples");
  bad.data = NULL;
  REFUSED(TETLOD_ERR_ARGUMENT, "data NULL");
  bad.data = (char *)good.data + 2;
  REFUSED(TETLOD_ERR_ARGUMENT, "data multiple");
  bad.tuple_stride = 6;
  REFUSED(TETLOD_ERR_ARGUMENT, "tuple_stride 6");
  bad.component_stride = 6;
  REFUSED(TETLOD_ERR_ARGUMENT, "component_stride 6");
  bad.tuple_stride = INT64_MAX - 7;
  REFUSED(TETLOD_ERR_ARGUMENT, "address space");
  if (components > 1) {
    bad.tuple_stride = bad.component_stride = 8;
    REFUSED(TETLOD_ERR_ARGUMENT, "share memory");
  }
#undef REFUSED
  CHECK(whole_untouched(&memory));
  free_guarded(&memory);
}

static void refuse_fetches(tetlod_context *context, const result *kept) {
  tetlod_run_report report = {.struct_size = 4};
  tetlod_array array = array_of(TETLOD_INT32, kept->tets, 4, kept->corners), view = {.struct_size = 16};
  refuse_destinations(context, tetlod_fetch_points, TETLOD_FLOAT64, kept->points, 3);
  refuse_destinations(context, tetlod_fetch_scalars, TETLOD_FLOAT64, kept->points, 1);
  refuse_destinations(context, fetch_tets_0, TETLOD_INT64, kept->tets, 4);
  refuse_destinations(context, fetch_boundary_1, TETLOD_INT64, kept->triangles, 3);
  FAILS(context, tetlod_fetch_tets(context, 3, &array), TETLOD_ERR_ARGUMENT, "index_base 3");
  FAILS(context, tetlod_fetch_boundary(context, -1, &array), TETLOD_ERR_ARGUMENT, "index_base -1");
  FAILS(context, tetlod_fetch_report(context, &report), TETLOD_ERR_STRUCT_SIZE, "struct_size 4");
  FAILS(context, tetlod_fetch_report(context, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
  FAILS(context, tetlod_fetch_counts(context, (int64_t *)((uintptr_t)&report + 1), NULL, NULL), TETLOD_ERR_ARGUMENT,
        "points multiple");
  FAILS(context, tetlod_view_points(context, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
  FAILS(context, tetlod_view_tets(context, &view), TETLOD_ERR_STRUCT_SIZE, "struct_size 16");
  FAILS(context, tetlod_view_scalars(context, &view), TETLOD_ERR_STRUCT_SIZE, "struct_size 16");
  OK(context, tetlod_fetch_counts(context, NULL, NULL, NULL));
  HAS_RESULT(context, kept);
}

/* A struct of a newer header: what we do not know stays as it is. */
static void longer_structs(const tetlod_context *context) {
  struct {
    tetlod_run_report report;
    unsigned char more[32];
  } newer;
  size_t i, changed = 0;
  memset(&newer, 0x5A, sizeof newer);
  newer.report.struct_size = sizeof newer;
  OK(context, tetlod_fetch_report(context, &newer.report));
  for (i = 0; i < sizeof newer.more; i++) changed += newer.more[i] != 0x5A;
  CHECK(changed == 0 && newer.report.struct_size == sizeof newer && newer.report.tets_out > 0);
}

static void check_views(const tetlod_context *context, const result *r) {
  tetlod_array points = {.struct_size = sizeof points}, tets = {.struct_size = sizeof tets},
               values = {.struct_size = sizeof values};
  OK(context, tetlod_view_points(context, &points));
  OK(context, tetlod_view_tets(context, &tets));
  OK(context, tetlod_view_scalars(context, &values));
  CHECK(points.struct_size == sizeof points && points.type == TETLOD_FLOAT64 && points.components == 3);
  CHECK(points.tuples == r->points && points.tuple_stride == 24 && points.component_stride == 8);
  CHECK(tets.type == TETLOD_INT32 && tets.components == 4 && tets.tuples == r->tets && tets.reserved == 0);
  CHECK(tets.tuple_stride == 16 && tets.component_stride == 4);
  CHECK(values.type == TETLOD_FLOAT64 && values.components == 1 && values.tuples == r->points);
  CHECK(values.tuple_stride == 8 && values.component_stride == 8);
  CHECK(memcmp(points.data, r->xyz, (size_t)r->points * 24) == 0);
  CHECK(memcmp(tets.data, r->corners, (size_t)r->tets * 16) == 0);
  CHECK(memcmp(values.data, r->values, (size_t)r->points * 8) == 0);
}

void test_fetch(void) {
  cube mesh = make_cube(4);
  tetlod_context *context = new_run(&mesh);
  result kept = fetch_result(context);
  CHECK(kept.tets > 0 && kept.triangles >= 4);
  check_volumes(&kept);
  check_range(&kept);
  check_linear(&mesh);
  check_report(context, &kept, &mesh);
  nothing_to_fetch();
  refuse_fetches(context, &kept);
  longer_structs(context);
  check_views(context, &kept);
  OK(context, tetlod_clear(context)); /* the result does not need the input */
  HAS_RESULT(context, &kept);
  tetlod_destroy(context);
  free_result(&kept);
  free_cube(&mesh);
}

/* ---- The error and the histogram ------------------------------------------------------------------------------------
 */

static void check_error(tetlod_context *context) {
  tetlod_error_report error, before;
  memset(&error, 0xff, sizeof error);
  error.struct_size = sizeof error, before = error;
  FAILS(context, tetlod_measure_error(context, -1, &error), TETLOD_ERR_ARGUMENT, "samples_per_tet -1");
  FAILS(context, tetlod_measure_error(context, 101, &error), TETLOD_ERR_ARGUMENT, "samples_per_tet 101");
  FAILS(context, tetlod_measure_error(context, 1, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
  error.struct_size = 12;
  FAILS(context, tetlod_measure_error(context, 1, &error), TETLOD_ERR_STRUCT_SIZE, "struct_size 12");
  error.struct_size = sizeof error;
  CHECK(memcmp(&error, &before, sizeof error) == 0);
  OK(context, tetlod_measure_error(context, 4, &error));
  CHECK(error.struct_size == sizeof error && error.samples_per_tet == 4);
  CHECK(error.rms >= 0 && error.rms <= error.max && error.max < 0.25);
  CHECK(error.rms_inner >= 0 && error.rms_inner <= error.max_inner && error.max_inner < 0.25);
  CHECK(error.outside >= 0 && error.outside < 1 && error.outside_inner >= 0 && error.outside_inner < 0.5);
  OK(context, tetlod_measure_error(context, 0, &error));
  CHECK(error.samples_per_tet == 0);
}

static void check_histogram(tetlod_context *context, const cube *mesh, const result *r) {
  int64_t counts[8] = {-1, -1, -1, -1, -1, -1, -1, -1}, sum = 0, wanted[7] = {0}, i;
  int32_t side;
  FAILS(context, tetlod_histogram(context, 2, 7, counts), TETLOD_ERR_ARGUMENT, "side 2");
  FAILS(context, tetlod_histogram(context, 0, 0, counts), TETLOD_ERR_ARGUMENT, "0 bins");
  FAILS(context, tetlod_histogram(context, 0, (1 << 20) + 1, counts), TETLOD_ERR_ARGUMENT, "1048577 1048576");
  FAILS(context, tetlod_histogram(context, 0, 7, NULL), TETLOD_ERR_ARGUMENT, "counts NULL");
  CHECK(counts[0] == -1);
  for (side = 0; side < 2; side++) {
    OK(context, tetlod_histogram(context, side, 7, counts));
    for (i = sum = 0; i < 7; i++) sum += counts[i];
    CHECK(sum == (side ? r->points : mesh->points));
    CHECK(counts[7] == -1);
  }
  /* The field goes from 1 to 8: bin b has the values in [b + 1, b + 2), the last also 8. */
  for (i = 0; i < mesh->points; i++) wanted[mesh->values[i] >= 8 ? 6 : (int)mesh->values[i] - 1]++;
  OK(context, tetlod_histogram(context, 0, 7, counts));
  CHECK(memcmp(wanted, counts, sizeof wanted) == 0);
}

/* Both compare with the arrays of the run. */
static void other_arrays(tetlod_context *context, const cube *mesh) {
  tetlod_error_report error = {.struct_size = sizeof error, .samples_per_tet = 7};
  const tetlod_array values = values_of(mesh), others = array_of(TETLOD_FLOAT64, mesh->points, 1, mesh->xyz);
  int64_t count = 7;
  OK(context, tetlod_submit_scalars(context, "other", &others));
  FAILS(context, tetlod_measure_error(context, 1, &error), TETLOD_ERR_STATE, "last run");
  FAILS(context, tetlod_histogram(context, 0, 1, &count), TETLOD_ERR_STATE, "last run");
  CHECK(count == 7 && error.samples_per_tet == 7);
  OK(context, tetlod_histogram(context, 1, 1, &count));
  OK(context, tetlod_submit_scalars(context, "the same again", &values));
  OK(context, tetlod_measure_error(context, 1, &error));
  OK(context, tetlod_clear(context));
  FAILS(context, tetlod_measure_error(context, 1, &error), TETLOD_ERR_STATE, "points");
  FAILS(context, tetlod_histogram(context, 0, 1, &count), TETLOD_ERR_STATE, "points");
}

void test_error_and_histogram(void) {
  cube mesh = make_cube(4);
  tetlod_context *context = new_run(&mesh);
  result kept = fetch_result(context);
  check_error(context);
  check_histogram(context, &mesh, &kept);
  other_arrays(context, &mesh);
  HAS_RESULT(context, &kept);
  tetlod_destroy(context);
  free_result(&kept);
  free_cube(&mesh);
}
