/* The least there is to call: the arrays of a mesh and of a field in, a smaller mesh and its field out. */
#include <stdio.h>
#include <stdlib.h>

#include "cavity_mesh.h"
#include "tetlod.h"

static tetlod_status simplify(int64_t n, double *xyz, int64_t m, int32_t *corners, double *density) {
  tetlod_array points = {sizeof points, TETLOD_FLOAT64, n, 3, 0, 0, 0, xyz};
  tetlod_array tets = {sizeof tets, TETLOD_INT32, m, 4, 0, 0, 0, corners};
  tetlod_array values = {sizeof values, TETLOD_FLOAT64, n, 1, 0, 0, 0, density};
  int64_t points_left = 0, tets_left = 0;
  char message[256] = "";
  tetlod_context *lod = NULL;
  tetlod_status status = tetlod_create(NULL, &lod);
  if (!status) status = tetlod_set_real(lod, TETLOD_OPT_TARGET_RATIO, 0.1); /* as published: tetlod_set_rho, _sigma */
  if (!status) status = tetlod_submit_points(lod, &points);
  if (!status) status = tetlod_submit_tets(lod, &tets, 0);
  if (!status) status = tetlod_submit_scalars(lod, "density", &values);
  if (!status) status = tetlod_run(lod);
  if (!status) status = tetlod_fetch_counts(lod, &points_left, &tets_left, NULL); /* then tetlod_fetch_points, ... */
  if (status) tetlod_last_message(lod, message, sizeof message);                  /* of the last call that failed */
  tetlod_destroy(lod);
  printf("%lld of %lld tets %s\n", (long long)tets_left, (long long)m, message);
  return status;
}

int main(void) {
  cavity_mesh mesh;
  if (cavity_mesh_make(8, &mesh) != 0) return EXIT_FAILURE;
  double *density = malloc((size_t)mesh.points * sizeof *density);
  if (density == NULL) return EXIT_FAILURE;
  for (int64_t i = 0; i < mesh.points; i++) density[i] = mesh.xyz[3 * i] * mesh.xyz[3 * i + 1];
  tetlod_status status = simplify(mesh.points, mesh.xyz, mesh.tets, mesh.corners, density);
  free(density);
  cavity_mesh_free(&mesh);
  return status == TETLOD_OK ? EXIT_SUCCESS : EXIT_FAILURE;
}
