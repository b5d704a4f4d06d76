/* Uses what an installed tetlod consists of: header, library, worker. A cube with a linear field, its boundary kept,
 * must come back with fewer tets and exact. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <tetlod.h>

enum { kSize = 8, kRow = kSize + 1, kPoints = kRow * kRow * kRow, kTets = 6 * kSize * kSize * kSize };

static double xyz[3 * kPoints], values[kPoints];
static int32_t corners[4 * kTets];

static double linear(const double *p) { return p[0] + 2.0 * p[1] - 3.0 * p[2]; }

static int32_t node(int i, int j, int k) { return (k * kRow + j) * kRow + i; }

static void make_points(void) {
  for (int n = 0; n < kPoints; n++) {
    double *p = xyz + 3 * n;
    p[0] = n % kRow, p[1] = n / kRow % kRow, p[2] = n / (kRow * kRow);
    values[n] = linear(p);
  }
}

/* Six tets around the diagonal of a cell, one for each order of the axes. */
static void make_tets(void) {
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  int32_t *at = corners;
  for (int cell = 0; cell < kSize * kSize * kSize; cell++) {
    for (int path = 0; path < 6; path++) {
      int p[3] = {cell % kSize, cell / kSize % kSize, cell / (kSize * kSize)};
      *at++ = node(p[0], p[1], p[2]);
      for (int step = 0; step < 3; step++) {
        p[order[path][step]]++;
        *at++ = node(p[0], p[1], p[2]);
      }
    }
  }
}

static int fail(const tetlod_context *lod, const char *what) {
  char message[512] = "";
  tetlod_last_message(lod, message, sizeof message);
  printf("%s: %s\n", what, message);
  return EXIT_FAILURE;
}

static int simplify(tetlod_context *lod) {
  tetlod_array points = {sizeof points, TETLOD_FLOAT64, kPoints, 3, 0, 0, 0, xyz};
  tetlod_array tets = {sizeof tets, TETLOD_INT32, kTets, 4, 0, 0, 0, corners};
  tetlod_array field = {sizeof field, TETLOD_FLOAT64, kPoints, 1, 0, 0, 0, values};
  if (tetlod_submit_points(lod, &points) || tetlod_submit_tets(lod, &tets, 0) ||
      tetlod_submit_scalars(lod, "linear", &field)) {
    return fail(lod, "submit");
  }
  if (tetlod_set_rho(lod, 0.2) || tetlod_set_sigma(lod, 1)) return fail(lod, "options");
  if (tetlod_run(lod)) return fail(lod, "run");
  return EXIT_SUCCESS;
}

static int check(const tetlod_context *lod) {
  tetlod_array points = {sizeof points, 0, 0, 0, 0, 0, 0, NULL}, tets = points, field = points;
  if (tetlod_view_points(lod, &points) || tetlod_view_tets(lod, &tets) || tetlod_view_scalars(lod, &field)) {
    return fail(lod, "view");
  }
  for (int64_t i = 0; i < points.tuples; i++) {
    double is = ((const double *)field.data)[i], should = linear((const double *)points.data + 3 * i);
    if (fabs(is - should) > 1e-9 * 6 * kSize) return fail(lod, "the field is not linear any more");
  }
  if (tets.tuples >= kTets) return fail(lod, "the mesh is not smaller");
  printf("%s: %d tets became %d\n", tetlod_build_info(), (int)kTets, (int)tets.tuples);
  return EXIT_SUCCESS;
}

int main(void) {
  tetlod_context *lod = NULL;
  make_points();
  make_tets();
  if (tetlod_create(NULL, &lod)) return fail(NULL, "create");
  int status = simplify(lod);
  if (status == EXIT_SUCCESS) status = check(lod);
  tetlod_destroy(lod);
  return status;
}
