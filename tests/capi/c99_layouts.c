/* The same mesh in other types and layouts gives the same bytes; nothing but the described bytes is read or written. */
#include <stdio.h>

#include "c99_support.h"

/* Runs with one slot in another layout, and compares. */
static void same_with(const char *what, const cube *mesh, const result *wanted, const tetlod_array *points,
                      const tetlod_array *tets, int32_t base, const tetlod_array *values) {
  tetlod_context *context = new_context();
  const int before = checks_failed();
  submit_cube(context, mesh);
  if (points) OK(context, tetlod_submit_points(context, points));
  if (tets) OK(context, tetlod_submit_tets(context, tets, base));
  if (values) OK(context, tetlod_submit_scalars(context, NULL, values));
  if (OK(context, tetlod_run(context))) HAS_RESULT(context, wanted);
  if (checks_failed() != before) fprintf(stderr, "with %s\n", what);
  tetlod_destroy(context);
}

static void put(const tetlod_array *to, int64_t i, int c, double value) {
  char *at = (char *)to->data + i * to->tuple_stride + c * to->component_stride;
  if (to->type == TETLOD_FLOAT32) *(float *)(void *)at = (float)value;
  if (to->type == TETLOD_FLOAT64) *(double *)(void *)at = value;
  if (to->type == TETLOD_INT32) *(int32_t *)(void *)at = (int32_t)value;
  if (to->type == TETLOD_INT64) *(int64_t *)(void *)at = (int64_t)value;
}

static int64_t size_of(int32_t type) { return type == TETLOD_FLOAT32 || type == TETLOD_INT32 ? 4 : 8; }

enum { packed, padded, reversed, swapped, columns, layouts };
static const char *const layout_names[] = {"packed", "padded", "reversed tuples", "reversed components", "columns"};

/* An array of that shape inside guarded memory. */
static tetlod_array lay_out(int layout, int32_t type, int64_t tuples, int32_t components, const guarded *memory) {
  const int64_t size = size_of(type);
  tetlod_array array = array_of(type, tuples, components, guarded_data(memory));
  array.component_stride = size;
  array.tuple_stride = size * components;
  if (layout == padded) array.tuple_stride = size * (components + 2);
  if (layout == reversed) array.data = (char *)array.data + (tuples - 1) * array.tuple_stride, array.tuple_stride *= -1;
  if (layout == swapped) array.data = (char *)array.data + (components - 1) * size, array.component_stride = -size;
  if (layout == columns) array.tuple_stride = size, array.component_stride = size * tuples;
  return array;
}

static guarded room_for(int32_t type, int64_t tuples, int32_t components) {
  return new_guarded((size_t)(size_of(type) * (components + 2) * tuples));
}

static void points_in_every_layout(const cube *mesh, const result *wanted) {
  const int32_t types[2] = {TETLOD_FLOAT32, TETLOD_FLOAT64};
  int layout, t, c;
  for (layout = 0; layout < layouts; layout++)
    for (t = 0; t < 2; t++) {
      guarded memory = room_for(types[t], mesh->points, 3), copy;
      const tetlod_array array = lay_out(layout, types[t], mesh->points, 3, &memory);
      int64_t i;
      for (i = 0; i < mesh->points; i++)
        for (c = 0; c < 3; c++) put(&array, i, c, mesh->xyz[3 * i + c]);
      copy = new_guarded(memory.size);
      memcpy(guarded_data(&copy), guarded_data(&memory), memory.size);
      same_with(layout_names[layout], mesh, wanted, &array, NULL, 0, NULL);
      CHECK(margins_untouched(&memory));
      CHECK(memcmp(guarded_data(&copy), guarded_data(&memory), memory.size) == 0);
      free_guarded(&memory);
      free_guarded(&copy);
    }
}

static void tets_in_every_layout(const cube *mesh, const result *wanted) {
  const int32_t types[2] = {TETLOD_INT32, TETLOD_INT64};
  int layout, t, c;
  for (layout = 0; layout < layouts; layout++)
    for (t = 0; t < 2; t++) {
      guarded memory = room_for(types[t], mesh->tets, 4);
      const tetlod_array array = lay_out(layout, types[t], mesh->tets, 4, &memory);
      const int32_t base = (layout + t) % 2;
      int64_t i;
      for (i = 0; i < mesh->tets; i++)
        for (c = 0; c < 4; c++) put(&array, i, c, mesh->corners[4 * i + c] + base);
      same_with(layout_names[layout], mesh, wanted, NULL, &array, base, NULL);
      CHECK(margins_untouched(&memory));
      free_guarded(&memory);
    }
}

static void values_in_every_layout(const cube *mesh, const result *wanted) {
  const int32_t types[2] = {TETLOD_FLOAT32, TETLOD_FLOAT64};
  int layout, t;
  for (layout = 0; layout < layouts; layout++)
    for (t = 0; t < 2; t++) {
      guarded memory = room_for(types[t], mesh->points, 1);
      const tetlod_array array = lay_out(layout, types[t], mesh->points, 1, &memory);
      int64_t i;
      for (i = 0; i < mesh->points; i++) put(&array, i, 0, mesh->values[i]);
      same_with(layout_names[layout], mesh, wanted, NULL, NULL, 0, &array);
      CHECK(margins_untouched(&memory));
      free_guarded(&memory);
    }
}

static void separate_coordinates(const cube *mesh, const result *wanted) {
  const int32_t types[3] = {TETLOD_FLOAT64, TETLOD_FLOAT32, TETLOD_FLOAT64};
  guarded memory[3];
  tetlod_array xyz[3];
  tetlod_context *context = new_context();
  int64_t i;
  int c;
  for (c = 0; c < 3; c++) {
    memory[c] = room_for(types[c], mesh->points, 1);
    xyz[c] = lay_out(c, types[c], mesh->points, 1, &memory[c]);
    for (i = 0; i < mesh->points; i++) put(&xyz[c], i, 0, mesh->xyz[3 * i + c]);
  }
  submit_cube(context, mesh);
  OK(context, tetlod_submit_points_xyz(context, &xyz[0], &xyz[1], &xyz[2]));
  OK(context, tetlod_run(context));
  HAS_RESULT(context, wanted);
  for (c = 0; c < 3; c++) free_guarded(&memory[c]);
  tetlod_destroy(context);
}

static void mixed_winding(const cube *mesh, const result *wanted) {
  const size_t bytes = (size_t)mesh->tets * 4 * sizeof(int32_t);
  int32_t *corners = memcpy(malloc(bytes), mesh->corners, bytes);
  const tetlod_array array = array_of(TETLOD_INT32, mesh->tets, 4, corners);
  int64_t t;
  for (t = 0; t < mesh->tets; t += 3) {
    const int32_t first = corners[4 * t];
    corners[4 * t] = corners[4 * t + 3];
    corners[4 * t + 3] = first;
  }
  same_with("mixed winding", mesh, wanted, NULL, &array, 0, NULL);
  free(corners);
}

/* ---- The way out ---------------------------------------------------------------------------------------------------
 */

static double get(const tetlod_array *from, int64_t i, int c) {
  const char *at = (const char *)from->data + i * from->tuple_stride + c * from->component_stride;
  if (from->type == TETLOD_FLOAT32) return *(const float *)(const void *)at;
  if (from->type == TETLOD_FLOAT64) return *(const double *)(const void *)at;
  if (from->type == TETLOD_INT32) return *(const int32_t *)(const void *)at;
  return (double)*(const int64_t *)(const void *)at;
}

/* `spare` tuples more than needed stay as they were. */
enum { spare = 2 };

static void check_points_out(const tetlod_context *context, const result *wanted, int layout, int32_t type) {
  const int64_t room = wanted->points + spare;
  guarded memory = room_for(type, room, 3);
  tetlod_array array = lay_out(layout, type, room, 3, &memory);
  int64_t i, different = 0;
  int c;
  const double before = get(&array, wanted->points, 0);
  OK(context, tetlod_fetch_points(context, &array));
  for (i = 0; i < wanted->points; i++)
    for (c = 0; c < 3; c++) {
      const double exact = wanted->xyz[3 * i + c];
      different += get(&array, i, c) != (type == TETLOD_FLOAT32 ? (double)(float)exact : exact);
    }
  CHECK(different == 0);
  CHECK(get(&array, wanted->points, 0) == before);
  CHECK(margins_untouched(&memory));
  free_guarded(&memory);
}

static void check_numbers_out(const tetlod_context *context, const result *wanted, int layout, int32_t type,
                              int32_t base, int boundary) {
  const int32_t *numbers = boundary ? wanted->boundary : wanted->corners;
  const int64_t tuples = boundary ? wanted->triangles : wanted->tets;
  const int components = boundary ? 3 : 4;
  guarded memory = room_for(type, tuples + spare, components);
  tetlod_array array = lay_out(layout, type, tuples + spare, components, &memory);
  int64_t i, different = 0;
  int c;
  if (boundary)
    OK(context, tetlod_fetch_boundary(context, base, &array));
  else
    OK(context, tetlod_fetch_tets(context, base, &array));
  for (i = 0; i < tuples; i++)
    for (c = 0; c < components; c++) different += get(&array, i, c) != (double)(numbers[components * i + c] + base);
  CHECK(different == 0);
  CHECK(margins_untouched(&memory));
  free_guarded(&memory);
}

static void fetch_in_every_layout(const tetlod_context *context, const result *wanted) {
  int layout;
  for (layout = 0; layout < layouts; layout++) {
    check_points_out(context, wanted, layout, TETLOD_FLOAT32);
    check_points_out(context, wanted, layout, TETLOD_FLOAT64);
    check_numbers_out(context, wanted, layout, TETLOD_INT32, 0, 0);
    check_numbers_out(context, wanted, layout, TETLOD_INT64, 1, 0);
    check_numbers_out(context, wanted, layout, TETLOD_INT32, 1, 1);
    check_numbers_out(context, wanted, layout, TETLOD_INT64, 0, 1);
  }
}

void test_layouts(void) {
  cube mesh = make_cube(4);
  tetlod_context *context = new_run(&mesh);
  result wanted = fetch_result(context);
  points_in_every_layout(&mesh, &wanted);
  tets_in_every_layout(&mesh, &wanted);
  values_in_every_layout(&mesh, &wanted);
  separate_coordinates(&mesh, &wanted);
  mixed_winding(&mesh, &wanted);
  fetch_in_every_layout(context, &wanted);
  tetlod_destroy(context);
  free_result(&wanted);
  free_cube(&mesh);
}
