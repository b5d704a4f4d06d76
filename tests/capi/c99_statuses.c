/* Meshes that tetlod_run refuses: each with the status of the header, a message with index and value, and the previous
 * result still there. */
#include <math.h>

#include "c99_support.h"

/* A context with a good result, and a copy of its mesh to spoil. */
typedef struct patient {
  tetlod_context *context;
  cube mesh;
  result kept;
} patient;

static patient new_patient(void) {
  patient p;
  cube good = make_cube(4);
  p.context = new_run(&good);
  p.kept = fetch_result(p.context);
  free_cube(&good);
  p.mesh = make_cube(4);
  submit_cube(p.context, &p.mesh);
  return p;
}

static void free_patient(patient *p) {
  HAS_RESULT(p->context, &p->kept);
  tetlod_destroy(p->context);
  free_result(&p->kept);
  free_cube(&p->mesh);
}

static void empty(void) {
  patient p = new_patient();
  const tetlod_array none = array_of(TETLOD_INT32, 0, 4, NULL), no_points = array_of(TETLOD_FLOAT64, 0, 3, NULL),
                     no_values = array_of(TETLOD_FLOAT64, 0, 1, NULL), tets = tets_of(&p.mesh);
  int64_t i;
  OK(p.context, tetlod_submit_tets(p.context, &none, 0));
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_EMPTY, "tets");
  OK(p.context, tetlod_submit_points(p.context, &no_points));
  OK(p.context, tetlod_submit_scalars(p.context, NULL, &no_values));
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_EMPTY, "points");
  submit_cube(p.context, &p.mesh);
  for (i = 0; i < p.mesh.tets; i++) p.mesh.corners[4 * i + 1] = p.mesh.corners[4 * i]; /* none left after repair */
  OK(p.context, tetlod_submit_tets(p.context, &tets, 0));
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_EMPTY, "");
  free_patient(&p);
}

static void bad_indices(void) {
  patient p = new_patient();
  const tetlod_array tets = tets_of(&p.mesh);
  const int32_t good = p.mesh.corners[4 * 17 + 2];
  p.mesh.corners[4 * 17 + 2] = 125;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "17 125");
  p.mesh.corners[4 * 17 + 2] = -3;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "17 -3");
  p.mesh.corners[4 * 17 + 2] = INT32_MAX;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "17 2147483647");
  p.mesh.corners[4 * 17 + 2] = INT32_MIN;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "17 -2147483648");
  p.mesh.corners[4 * 17 + 2] = good;
  OK(p.context, tetlod_submit_tets(p.context, &tets, 1)); /* tet 0 names vertex 0, which is before the first */
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "0");
  free_patient(&p);
}

static void long_indices(void) {
  patient p = new_patient();
  int64_t *corners = malloc((size_t)p.mesh.tets * 4 * sizeof(int64_t)), i;
  const tetlod_array tets = array_of(TETLOD_INT64, p.mesh.tets, 4, corners);
  for (i = 0; i < 4 * p.mesh.tets; i++) corners[i] = p.mesh.corners[i];
  OK(p.context, tetlod_submit_tets(p.context, &tets, 0));
  corners[4 * 3 + 1] = ((int64_t)1 << 32) + corners[4 * 3 + 1]; /* the same when cut to 32 bits */
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "3 42949673");
  corners[4 * 3 + 1] = INT64_MIN;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "3 -9223372036854775808");
  OK(p.context, tetlod_submit_tets(p.context, &tets, 1)); /* INT64_MIN - 1 is no number */
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_INDEX, "");
  free_patient(&p);
  free(corners);
}

static void not_finite(void) {
  patient p = new_patient();
  p.mesh.xyz[3 * 5 + 1] = nan("");
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_NONFINITE, "5 nan");
  p.mesh.xyz[3 * 5 + 1] = -HUGE_VAL;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_NONFINITE, "5 -inf");
  p.mesh.xyz[3 * 5 + 1] = 0;
  p.mesh.values[7] = HUGE_VAL;
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_NONFINITE, "7 inf");
  p.mesh.values[7] = nan("");
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_NONFINITE, "7 nan");
  free_patient(&p);
}

static void no_volume(void) {
  patient p = new_patient();
  int64_t i;
  for (i = 0; i < p.mesh.points; i++) { /* onto a plane, no two points in one place */
    double *const at = p.mesh.xyz + 3 * i;
    at[0] += 0.125 * at[2], at[1] += 0.0625 * at[2], at[2] = 0.5;
  }
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_MESH_DEGENERATE, "");
  free_patient(&p);
}

/* Runs a small mesh of its own in the patient's context. */
static void refuse_mesh(const double *xyz, int64_t points, const int32_t *corners, int64_t tets, tetlod_status status,
                        const char *words) {
  patient p = new_patient();
  const tetlod_array xyz_array = array_of(TETLOD_FLOAT64, points, 3, xyz),
                     tet_array = array_of(TETLOD_INT32, tets, 4, corners),
                     value_array = array_of(TETLOD_FLOAT64, points, 1, xyz);
  OK(p.context, tetlod_submit_points(p.context, &xyz_array));
  OK(p.context, tetlod_submit_tets(p.context, &tet_array, 0));
  OK(p.context, tetlod_submit_scalars(p.context, NULL, &value_array));
  FAILS(p.context, tetlod_run(p.context), status, words);
  free_patient(&p);
}

static void three_tets_on_a_face(void) {
  static const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 1, 0.3, 0.3, -1, 0.3, 0.3, 2};
  static const int32_t corners[] = {0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5};
  refuse_mesh(xyz, 6, corners, 3, TETLOD_ERR_MESH_NONMANIFOLD, "0 1 2");
}

/* Two tets through each other. */
static void overlapping(void) {
  static const double xyz[] = {0,   0,   0,   1,   0,   0,   0,   1,   0,   0,   0,   1,
                               0.2, 0.2, 0.2, 1.2, 0.2, 0.2, 0.2, 1.2, 0.2, 0.2, 0.2, 1.2};
  static const int32_t corners[] = {0, 1, 2, 3, 4, 5, 6, 7};
  refuse_mesh(xyz, 8, corners, 2, TETLOD_ERR_MESH_INTERSECTING, "");
}

/* ---- Limits --------------------------------------------------------------------------------------------------------
 */

static int32_t say_stop(void *user, int32_t stage, double fraction) {
  (void)stage, (void)fraction;
  ++*(int *)user;
  return 1;
}

static void limits(void) {
  patient p = new_patient();
  int calls = 0;
  OK(p.context, tetlod_set_real(p.context, TETLOD_OPT_TIME_LIMIT, 1e-9));
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_TIME_LIMIT, "1e-09");
  OK(p.context, tetlod_set_real(p.context, TETLOD_OPT_TIME_LIMIT, 0));
  OK(p.context, tetlod_set_progress(p.context, say_stop, &calls));
  FAILS(p.context, tetlod_run(p.context), TETLOD_ERR_CANCELLED, "progress");
  CHECK(calls == 1);
  OK(p.context, tetlod_set_progress(p.context, NULL, NULL));
  HAS_RESULT(p.context, &p.kept);
  tetlod_cancel(p.context); /* none under way: nothing happens, also not to the next */
  OK(p.context, tetlod_run(p.context));
  free_patient(&p);
}

static void configured(tetlod_config config, tetlod_status status, const char *words) {
  tetlod_context *context = NULL;
  cube mesh = make_cube(4);
  config.struct_size = sizeof config;
  config.api_version = TETLOD_API_VERSION;
  OK(NULL, tetlod_create(&config, &context));
  submit_cube(context, &mesh);
  FAILS(context, tetlod_run(context), status, words);
  FAILS(context, tetlod_fetch_counts(context, NULL, NULL, NULL), TETLOD_ERR_STATE, "no result");
  tetlod_destroy(context);
  free_cube(&mesh);
}

static void *no_memory(void *user, size_t bytes, size_t alignment) {
  (void)user, (void)bytes, (void)alignment;
  return NULL;
}

static void no_release(void *user, void *pointer, size_t bytes, size_t alignment) {
  (void)user, (void)pointer, (void)bytes, (void)alignment;
}

static void configurations(void) {
  tetlod_config limited, poor, alone;
  memset(&limited, 0, sizeof limited);
  poor = alone = limited;
  limited.memory_limit = 1000;
  configured(limited, TETLOD_ERR_MEMORY_LIMIT, "1000 bytes");
  poor.allocate = no_memory, poor.release = no_release;
  configured(poor, TETLOD_ERR_MEMORY, "bytes");
  alone.remesher = "/nonexistent/tetlod-remesh";
  configured(alone, TETLOD_ERR_BACKEND_MISSING, "/nonexistent/tetlod-remesh");
  alone.remesher = "/";
  configured(alone, TETLOD_ERR_BACKEND_MISSING, "/");
}

void test_mesh_statuses(void) {
  empty();
  bad_indices();
  long_indices();
  not_finite();
  no_volume();
  three_tets_on_a_face();
  overlapping();
  limits();
  configurations();
}
