/* A solver that makes its result smaller before it leaves memory.
 *
 * Steady heat conduction in a block with a hot spherical cavity, a cold wall and a heat source; then libtetlod, on the
 * solver's own arrays. Prints the paper's Table 2 and writes PREFIX.vtu and PREFIX_small.vtu.
 *
 *     heat_in_situ [SIZE [RATIO [PREFIX]]]        20 (288,000 tets), 0.05 of them, heat
 */
#define _POSIX_C_SOURCE 199309L

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cavity_mesh.h"
#include "heat_solver.h"
#include "table2.h"
#include "tetlod.h"
#include "write_vtu.h"

typedef struct arguments {
  int size;
  double ratio;
  const char *prefix;
} arguments;

typedef struct field {
  double *temperature, *source;
  uint8_t *fixed;
} field;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int complain(const char *what, const char *why) {
  fprintf(stderr, "heat_in_situ: %s: %s\n", what, why);
  return -1;
}

/* ---- The problem ---- */

static double heat_source(const double p[3]) {
  const double at[3] = {0.9, -0.45, 0.35};
  double r2 = 0;
  for (int a = 0; a < 3; a++) r2 += (p[a] - at[a]) * (p[a] - at[a]);
  return 60.0 * exp(-r2 / (2.0 * 0.18 * 0.18));
}

static int on_cavity(const cavity_mesh *mesh, int64_t i) { return i < mesh->shell; }

/* The surface's points were copied from the block, so its walls are met exactly. */
static int on_cold_wall(const cavity_mesh *mesh, int64_t i) {
  return i >= mesh->shell * mesh->layers && mesh->xyz[3 * i] == mesh->low[0];
}

static void pose(const cavity_mesh *mesh, field *f) {
  for (int64_t i = 0; i < mesh->points; i++) {
    f->source[i] = heat_source(mesh->xyz + 3 * i);
    f->fixed[i] = (uint8_t)(on_cavity(mesh, i) || on_cold_wall(mesh, i));
    f->temperature[i] = on_cavity(mesh, i) ? 1.0 : 0.0;
  }
}

static int field_make(const cavity_mesh *mesh, field *f) {
  size_t n = (size_t)mesh->points;
  f->temperature = malloc(n * sizeof *f->temperature);
  f->source = malloc(n * sizeof *f->source);
  f->fixed = malloc(n * sizeof *f->fixed);
  if (f->temperature == NULL || f->source == NULL || f->fixed == NULL) return complain("field", "no memory");
  pose(mesh, f);
  return 0;
}

static void field_free(field *f) {
  free(f->temperature);
  free(f->source);
  free(f->fixed);
}

static int solve(const cavity_mesh *mesh, field *f) {
  heat_problem problem = {mesh->points, mesh->tets, mesh->xyz, mesh->corners, f->fixed, f->source};
  int iterations = heat_solve(&problem, 1e-9, f->temperature);
  if (iterations < 0) return complain("solver", "no memory, or no convergence");
  printf("Solved: %lld unknowns, %lld tets, %d iterations\n", (long long)mesh->points, (long long)mesh->tets,
         iterations);
  return 0;
}

/* ---- tetlod ---- */

static int complain_lod(const tetlod_context *lod) {
  char message[512] = "";
  tetlod_last_message(lod, message, sizeof message);
  return complain("tetlod", message);
}

static tetlod_array array_of(int32_t type, int64_t tuples, int32_t components, void *data) {
  tetlod_array a = {sizeof a, type, tuples, components, 0, 0, 0, data};
  return a;
}

/* The solver's arrays are lent, not copied: they must stay as they are until tetlod_measure_error has returned. */
static int simplify(tetlod_context *lod, const arguments *args, const cavity_mesh *mesh, field *f) {
  tetlod_array points = array_of(TETLOD_FLOAT64, mesh->points, 3, mesh->xyz);
  tetlod_array tets = array_of(TETLOD_INT32, mesh->tets, 4, mesh->corners);
  tetlod_array values = array_of(TETLOD_FLOAT64, mesh->points, 1, f->temperature);
  if (tetlod_set_real(lod, TETLOD_OPT_TARGET_RATIO, args->ratio) != TETLOD_OK ||
      tetlod_set_int(lod, TETLOD_OPT_THREADS, 0) != TETLOD_OK || /* all cores */
      tetlod_submit_points(lod, &points) != TETLOD_OK || tetlod_submit_tets(lod, &tets, 0) != TETLOD_OK ||
      tetlod_submit_scalars(lod, "temperature", &values) != TETLOD_OK || tetlod_run(lod) != TETLOD_OK) {
    return complain_lod(lod);
  }
  return 0;
}

static int write_mesh(const char *prefix, const char *suffix, const vtu_mesh *mesh) {
  char path[1024];
  int length = snprintf(path, sizeof path, "%s%s.vtu", prefix, suffix);
  if (length < 0 || (size_t)length >= sizeof path) return complain(prefix, "name too long");
  if (write_vtu(path, mesh) != 0) return complain(path, strerror(errno));
  printf("Wrote %s\n", path);
  return 0;
}

static int write_original(const char *prefix, const cavity_mesh *mesh, const field *f) {
  vtu_mesh all = {mesh->points, mesh->tets, mesh->xyz, mesh->corners, f->temperature, "temperature"};
  return write_mesh(prefix, "", &all);
}

/* Reads the library's own arrays. */
static int write_small(const char *prefix, const tetlod_context *lod) {
  tetlod_array points = array_of(0, 0, 0, NULL), tets = points, values = points;
  if (tetlod_view_points(lod, &points) != TETLOD_OK || tetlod_view_tets(lod, &tets) != TETLOD_OK ||
      tetlod_view_scalars(lod, &values) != TETLOD_OK) {
    return complain_lod(lod);
  }
  vtu_mesh small = {points.tuples, tets.tuples, points.data, tets.data, values.data, "temperature"};
  return write_mesh(prefix, "_small", &small);
}

static int print_table(tetlod_context *lod, double solving) {
  tetlod_error_report error = {.struct_size = sizeof error};
  if (tetlod_measure_error(lod, 1, &error) != TETLOD_OK) return complain_lod(lod);
  table2_seconds around = {-1.0, solving, -1.0};
  if (table2_print(stdout, lod, &error, &around) != TETLOD_OK) return complain_lod(lod);
  return 0;
}

/* ---- The program ---- */

static int solve_and_simplify(tetlod_context *lod, const arguments *args, const cavity_mesh *mesh, field *f) {
  double begin = now();
  if (solve(mesh, f) != 0) return -1;
  double solving = now() - begin;
  if (simplify(lod, args, mesh, f) != 0) return -1;
  if (print_table(lod, solving) != 0) return -1;
  if (write_original(args->prefix, mesh, f) != 0) return -1;
  return write_small(args->prefix, lod);
}

static int run(const arguments *args) {
  cavity_mesh mesh;
  field f = {NULL, NULL, NULL};
  tetlod_context *lod = NULL;
  if (cavity_mesh_make(args->size, &mesh) != 0) return complain("mesh", "no memory");
  int status = field_make(&mesh, &f);
  if (status == 0 && tetlod_create(NULL, &lod) != TETLOD_OK) status = complain_lod(NULL);
  if (status == 0) status = solve_and_simplify(lod, args, &mesh, &f);
  tetlod_destroy(lod);
  field_free(&f);
  cavity_mesh_free(&mesh);
  return status;
}

/* The whole text must be a number. */
static int read_number(const char *text, double *number) {
  char *end = NULL;
  *number = strtod(text, &end);
  return end != text && *end == '\0' ? 0 : -1;
}

static int read_arguments(int argc, char **argv, arguments *args) {
  double size = args->size;
  if (argc > 4) return -1;
  if (argc > 1 && read_number(argv[1], &size) != 0) return -1;
  if (argc > 2 && read_number(argv[2], &args->ratio) != 0) return -1;
  if (argc > 3) args->prefix = argv[3];
  args->size = size >= 2 && size <= 200 ? (int)size : 0;
  return args->size == 0 ? -1 : 0;
}

int main(int argc, char **argv) {
  arguments args = {20, 0.05, "heat"};
  if (read_arguments(argc, argv, &args) != 0) {
    fprintf(stderr, "usage: heat_in_situ [SIZE [RATIO [PREFIX]]], SIZE 2 to 200\n");
    return 2;
  }
  return run(&args) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
