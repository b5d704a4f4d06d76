/* Uses what an installed tetlod consists of: header, library, worker. A cube with a linear field, its boundary kept,
 * must come back with fewer tets and exact. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <tetlod.h>

#include "../cube.h"

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
