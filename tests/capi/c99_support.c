#include "c99_support.h"

#include <stdio.h>

static int made, failed;

int checks_made(void) { return made; }
int checks_failed(void) { return failed; }

static void complain(const char *what, const char *file, int line) {
  failed++;
  fprintf(stderr, "%s:%d: failed: %s\n", file, line, what);
}

int check_that(int condition, const char *what, const char *file, int line) {
  made++;
  if (!condition) complain(what, file, line);
  return condition;
}

static void print_message(const tetlod_context *context, tetlod_status got) {
  char message[1024];
  tetlod_last_message(context, message, sizeof message);
  fprintf(stderr, "  status %d (%s): %s\n", (int)got, tetlod_status_text(got), message);
}

int check_ok(const tetlod_context *context, tetlod_status got, const char *what, const char *file, int line) {
  if (check_that(got == TETLOD_OK, what, file, line)) return 1;
  print_message(context, got);
  return 0;
}

static int has_words(const char *message, const char *words) {
  char copy[256], *word;
  strncpy(copy, words, sizeof copy - 1);
  copy[sizeof copy - 1] = 0;
  for (word = strtok(copy, " "); word; word = strtok(NULL, " "))
    if (!strstr(message, word)) return 0;
  return 1;
}

void check_failure(const tetlod_context *context, tetlod_status got, tetlod_status wanted, const char *words,
                   const char *what, const char *file, int line) {
  char message[1024];
  made++;
  tetlod_last_message(context, message, sizeof message);
  if (got == wanted && message[0] && has_words(message, words)) return;
  complain(what, file, line);
  print_message(context, got);
  fprintf(stderr, "  wanted: status %d, words \"%s\"\n", (int)wanted, words);
}

double linear_field(const double *p) { return 1 + p[0] + 2 * p[1] + 4 * p[2]; }

static int32_t point_number(int n, int x, int y, int z) { return (int32_t)((z * (n + 1) + y) * (n + 1) + x); }

/* Kuhn's six: from the least to the greatest corner along each order of the axes. */
static void split_cell(int n, int x, int y, int z, int32_t *corners) {
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  int t, k;
  for (t = 0; t < 6; t++) {
    int at[3];
    at[0] = x, at[1] = y, at[2] = z;
    corners[4 * t] = point_number(n, at[0], at[1], at[2]);
    for (k = 0; k < 3; k++) {
      at[order[t][k]]++;
      corners[4 * t + k + 1] = point_number(n, at[0], at[1], at[2]);
    }
  }
}

cube make_cube(int n) {
  cube mesh;
  int64_t i = 0, t = 0;
  int x, y, z;
  mesh.points = (int64_t)(n + 1) * (n + 1) * (n + 1);
  mesh.tets = (int64_t)6 * n * n * n;
  mesh.xyz = malloc((size_t)mesh.points * 3 * sizeof(double));
  mesh.values = malloc((size_t)mesh.points * sizeof(double));
  mesh.corners = malloc((size_t)mesh.tets * 4 * sizeof(int32_t));
  for (z = 0; z <= n; z++)
    for (y = 0; y <= n; y++)
      for (x = 0; x <= n; x++, i++) {
        double *p = mesh.xyz + 3 * i;
        p[0] = (double)x / n, p[1] = (double)y / n, p[2] = (double)z / n;
        mesh.values[i] = linear_field(p);
      }
  for (z = 0; z < n; z++)
    for (y = 0; y < n; y++)
      for (x = 0; x < n; x++, t += 6) split_cell(n, x, y, z, mesh.corners + 4 * t);
  return mesh;
}

void free_cube(cube *mesh) {
  free(mesh->xyz);
  free(mesh->corners);
  free(mesh->values);
}

tetlod_array array_of(int32_t type, int64_t tuples, int32_t components, const void *data) {
  tetlod_array array;
  memset(&array, 0, sizeof array);
  array.struct_size = sizeof array;
  array.type = type;
  array.tuples = tuples;
  array.components = components;
  array.data = (void *)(uintptr_t)data;
  return array;
}

tetlod_array points_of(const cube *mesh) { return array_of(TETLOD_FLOAT64, mesh->points, 3, mesh->xyz); }
tetlod_array tets_of(const cube *mesh) { return array_of(TETLOD_INT32, mesh->tets, 4, mesh->corners); }
tetlod_array values_of(const cube *mesh) { return array_of(TETLOD_FLOAT64, mesh->points, 1, mesh->values); }

tetlod_context *new_context(void) {
  tetlod_context *context = NULL;
  OK(NULL, tetlod_create(NULL, &context));
  return context;
}

void submit_cube(tetlod_context *context, const cube *mesh) {
  const tetlod_array points = points_of(mesh), tets = tets_of(mesh), values = values_of(mesh);
  OK(context, tetlod_submit_points(context, &points));
  OK(context, tetlod_submit_tets(context, &tets, 0));
  OK(context, tetlod_submit_scalars(context, "linear", &values));
}

tetlod_context *new_run(const cube *mesh) {
  tetlod_context *context = new_context();
  submit_cube(context, mesh);
  OK(context, tetlod_run(context));
  return context;
}

static uint64_t hash_of(const tetlod_context *context) {
  tetlod_run_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  OK(context, tetlod_fetch_report(context, &report));
  return report.hash;
}

result fetch_result(const tetlod_context *context) {
  result r;
  tetlod_array array;
  memset(&r, 0, sizeof r);
  OK(context, tetlod_fetch_counts(context, &r.points, &r.tets, &r.triangles));
  r.xyz = calloc((size_t)r.points + 1, 3 * sizeof(double));
  r.values = calloc((size_t)r.points + 1, sizeof(double));
  r.corners = calloc((size_t)r.tets + 1, 4 * sizeof(int32_t));
  r.boundary = calloc((size_t)r.triangles + 1, 3 * sizeof(int32_t));
  array = array_of(TETLOD_FLOAT64, r.points, 3, r.xyz);
  OK(context, tetlod_fetch_points(context, &array));
  array = array_of(TETLOD_FLOAT64, r.points, 1, r.values);
  OK(context, tetlod_fetch_scalars(context, &array));
  array = array_of(TETLOD_INT32, r.tets, 4, r.corners);
  OK(context, tetlod_fetch_tets(context, 0, &array));
  array = array_of(TETLOD_INT32, r.triangles, 3, r.boundary);
  OK(context, tetlod_fetch_boundary(context, 0, &array));
  r.hash = hash_of(context);
  return r;
}

void free_result(result *kept) {
  free(kept->xyz);
  free(kept->values);
  free(kept->corners);
  free(kept->boundary);
}

int same_result(const result *a, const result *b) {
  return a->points == b->points && a->tets == b->tets && a->triangles == b->triangles && a->hash == b->hash &&
         memcmp(a->xyz, b->xyz, (size_t)a->points * 3 * sizeof(double)) == 0 &&
         memcmp(a->values, b->values, (size_t)a->points * sizeof(double)) == 0 &&
         memcmp(a->corners, b->corners, (size_t)a->tets * 4 * sizeof(int32_t)) == 0 &&
         memcmp(a->boundary, b->boundary, (size_t)a->triangles * 3 * sizeof(int32_t)) == 0;
}

void check_has_result(const tetlod_context *context, const result *kept, const char *file, int line) {
  result now = fetch_result(context);
  check_that(same_result(&now, kept), "the previous result is as it was", file, line);
  free_result(&now);
}

enum { margin = 64, pattern = 0xA5 };

guarded new_guarded(size_t size) {
  guarded memory;
  memory.size = size;
  memory.block = malloc(size + 2 * margin);
  memset(memory.block, pattern, size + 2 * margin);
  return memory;
}

void *guarded_data(const guarded *memory) { return memory->block + margin; }

static int untouched(const unsigned char *bytes, size_t count) {
  size_t i;
  for (i = 0; i < count; i++)
    if (bytes[i] != pattern) return 0;
  return 1;
}

int margins_untouched(const guarded *memory) {
  return untouched(memory->block, margin) && untouched(memory->block + margin + memory->size, margin);
}

int whole_untouched(const guarded *memory) { return untouched(memory->block, memory->size + 2 * margin); }

void free_guarded(guarded *memory) { free(memory->block); }
