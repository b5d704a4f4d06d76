/* Every way in which an array can be refused, and that a refusal leaves what was submitted before. */
#include "c99_support.h"

typedef tetlod_status (*submit_fn)(tetlod_context *context, const tetlod_array *array);

static tetlod_status submit_tets_0(tetlod_context *context, const tetlod_array *array) {
  return tetlod_submit_tets(context, array, 0);
}

static tetlod_status submit_named(tetlod_context *context, const tetlod_array *array) {
  return tetlod_submit_scalars(context, "named", array);
}

/* `good` is an acceptable array for `submit`; each case spoils one thing. */
static void refuse_structs(tetlod_context *context, submit_fn submit, tetlod_array good) {
  tetlod_array bad = good;
  unsigned char shifted[sizeof bad + 8];
  FAILS(context, submit(context, NULL), TETLOD_ERR_ARGUMENT, "NULL");
  memcpy(shifted + 1, &good, sizeof good);
  if ((uintptr_t)shifted % 8 == 0)
    FAILS(context, submit(context, (const tetlod_array *)(uintptr_t)(shifted + 1)), TETLOD_ERR_ARGUMENT, "multiple");
  bad.struct_size = 0;
  FAILS(context, submit(context, &bad), TETLOD_ERR_STRUCT_SIZE, "struct_size 0");
  bad.struct_size = sizeof bad - 1;
  FAILS(context, submit(context, &bad), TETLOD_ERR_STRUCT_SIZE, "struct_size 47 48");
  bad = good, bad.struct_size = sizeof bad + 64; /* a newer header's, with members that we do not know */
  OK(context, submit(context, &bad));
  bad = good, bad.reserved = 9;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "reserved 9");
}

static void refuse_shapes(tetlod_context *context, submit_fn submit, tetlod_array good) {
  tetlod_array bad = good;
  const int real = good.type == TETLOD_FLOAT32 || good.type == TETLOD_FLOAT64;
  bad.type = 0;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "type 0");
  bad.type = real ? TETLOD_INT32 : TETLOD_FLOAT64;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "type");
  bad.type = TETLOD_UINT8;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "type 5");
  bad.type = -7;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "type -7");
  bad = good, bad.components = good.components + 1;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "components");
  bad.components = 0;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "0 components");
  bad.components = -2;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "-2 components");
  bad = good, bad.tuples = -1;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "-1 tuples");
  bad.tuples = INT64_MIN;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "-9223372036854775808 tuples");
  bad.tuples = (int64_t)1 << 29;
  FAILS(context, submit(context, &bad), TETLOD_ERR_MESH_TOO_LARGE, "536870912 536870911");
  bad.tuples = INT64_MAX;
  FAILS(context, submit(context, &bad), TETLOD_ERR_MESH_TOO_LARGE, "9223372036854775807");
}

static void refuse_layouts(tetlod_context *context, submit_fn submit, tetlod_array good) {
  tetlod_array bad = good;
  bad.data = NULL;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "data NULL tuples");
  bad.data = (char *)good.data + 1;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "data multiple");
  bad = good, bad.tuple_stride = 2;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "tuple_stride 2 multiple");
  bad = good, bad.component_stride = -3;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "component_stride -3 multiple");
  bad = good, bad.tuple_stride = INT64_MAX - 7;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "address space strides 9223372036854775800");
  bad.tuple_stride = INT64_MIN;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "address space");
  bad.tuple_stride = (int64_t)1 << 62;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "address space");
  bad = good, bad.data = (void *)(UINTPTR_MAX & ~(uintptr_t)7);
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "address space");
  bad.data = (void *)(uintptr_t)8, bad.tuple_stride = -64;
  FAILS(context, submit(context, &bad), TETLOD_ERR_ARGUMENT, "address space");
}

static void refuse_all(tetlod_context *context, submit_fn submit, tetlod_array good) {
  refuse_structs(context, submit, good);
  refuse_shapes(context, submit, good);
  refuse_layouts(context, submit, good);
}

static void refuse_separate(tetlod_context *context, const cube *mesh) {
  tetlod_array x = array_of(TETLOD_FLOAT64, mesh->points, 1, mesh->xyz), y = x, z = x, bad;
  x.tuple_stride = y.tuple_stride = z.tuple_stride = 24;
  y.data = mesh->xyz + 1, z.data = mesh->xyz + 2;
  FAILS(context, tetlod_submit_points_xyz(context, NULL, &y, &z), TETLOD_ERR_ARGUMENT, "x NULL");
  FAILS(context, tetlod_submit_points_xyz(context, &x, NULL, &z), TETLOD_ERR_ARGUMENT, "y NULL");
  FAILS(context, tetlod_submit_points_xyz(context, &x, &y, NULL), TETLOD_ERR_ARGUMENT, "z NULL");
  bad = y, bad.tuples--;
  FAILS(context, tetlod_submit_points_xyz(context, &x, &bad, &z), TETLOD_ERR_ARGUMENT, "125 124 tuples");
  bad = z, bad.components = 3;
  FAILS(context, tetlod_submit_points_xyz(context, &x, &y, &bad), TETLOD_ERR_ARGUMENT, "z 3 components");
  bad = z, bad.struct_size = 1;
  FAILS(context, tetlod_submit_points_xyz(context, &x, &y, &bad), TETLOD_ERR_STRUCT_SIZE, "z struct_size 1");
  bad = x, bad.tuples = (int64_t)1 << 29;
  FAILS(context, tetlod_submit_points_xyz(context, &bad, &bad, &bad), TETLOD_ERR_MESH_TOO_LARGE, "x 536870912");
}

static void refuse_index_bases(tetlod_context *context, const cube *mesh) {
  const tetlod_array tets = tets_of(mesh);
  FAILS(context, tetlod_submit_tets(context, &tets, 2), TETLOD_ERR_ARGUMENT, "index_base 2");
  FAILS(context, tetlod_submit_tets(context, &tets, -1), TETLOD_ERR_ARGUMENT, "index_base -1");
}

static void check_order(const cube *mesh) {
  const tetlod_array points = points_of(mesh), tets = tets_of(mesh), values = values_of(mesh);
  tetlod_array few = values;
  tetlod_context *context = new_context();
  FAILS(context, tetlod_run(context), TETLOD_ERR_STATE, "points");
  OK(context, tetlod_submit_points(context, &points));
  FAILS(context, tetlod_run(context), TETLOD_ERR_STATE, "tets");
  OK(context, tetlod_submit_tets(context, &tets, 0));
  FAILS(context, tetlod_run(context), TETLOD_ERR_STATE, "scalars");
  few.tuples = 7;
  OK(context, tetlod_submit_scalars(context, "pressure", &few));
  FAILS(context, tetlod_run(context), TETLOD_ERR_ARGUMENT, "pressure 7 125");
  OK(context, tetlod_submit_scalars(context, NULL, &few));
  FAILS(context, tetlod_run(context), TETLOD_ERR_ARGUMENT, "scalars: 7 125");
  OK(context, tetlod_submit_scalars(context, NULL, &values));
  OK(context, tetlod_run(context));
  OK(context, tetlod_clear(context));
  FAILS(context, tetlod_run(context), TETLOD_ERR_STATE, "points");
  CHECK(tetlod_fetch_counts(context, NULL, NULL, NULL) == TETLOD_OK);
  tetlod_destroy(context);
}

void test_submit(void) {
  cube mesh = make_cube(4);
  tetlod_context *context = new_run(&mesh);
  result kept = fetch_result(context);
  refuse_all(context, tetlod_submit_points, points_of(&mesh));
  refuse_all(context, submit_tets_0, tets_of(&mesh));
  refuse_all(context, submit_named, values_of(&mesh));
  refuse_separate(context, &mesh);
  refuse_index_bases(context, &mesh);
  HAS_RESULT(context, &kept);
  OK(context, tetlod_run(context)); /* what was submitted before the refusals is still there */
  HAS_RESULT(context, &kept);
  check_order(&mesh);
  free_result(&kept);
  tetlod_destroy(context);
  free_cube(&mesh);
}
