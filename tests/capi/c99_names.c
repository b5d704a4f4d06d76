/* The names and defaults that tetlod.h promises of stages and options. */
#include "c99_support.h"

static void check_stage_names(void) {
  static const char *const names[] = {"prepare", "boundary", "decimate", "sample", "cull", "remesh", "values"};
  const int32_t count = (int32_t)(sizeof names / sizeof *names);
  int32_t stage;
  for (stage = 0; stage < count; stage++) CHECK(strcmp(tetlod_stage_name(stage), names[stage]) == 0);
  CHECK(strcmp(tetlod_stage_name(count), "unknown") == 0);
}

static const struct {
  int32_t option;
  const char *name;
  int is_integer;
  double preset;
} rows[] = {
    {TETLOD_OPT_RHO, "rho", 0, 0.01},
    {TETLOD_OPT_SIGMA, "sigma", 0, 0.1},
    {TETLOD_OPT_LAMBDA, "lambda", 0, 0.1},
    {TETLOD_OPT_MIN_DISTANCE, "min-distance", 0, 0.01},
    {TETLOD_OPT_MERGE_TOLERANCE, "merge-tolerance", 0, 0},
    {TETLOD_OPT_CLEAN_EDGES, "clean-edges", 0, 0},
    {TETLOD_OPT_BOUNDARY_LEAF, "boundary-leaf", 1, 200},
    {TETLOD_OPT_TET_LEAF, "tet-leaf", 1, 500},
    {TETLOD_OPT_THREADS, "threads", 1, 1},
    {TETLOD_OPT_SEED, "seed", 1, 1},
    {TETLOD_OPT_TIME_LIMIT, "time-limit", 0, 0},
    {TETLOD_OPT_ON_COINCIDENT, "on-coincident", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_REPEATED, "on-repeated", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_FLAT, "on-flat", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_INVERTED, "on-inverted", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_DUPLICATE, "on-duplicate", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_OVERLAP, "on-overlap", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_UNUSED, "on-unused", 1, TETLOD_POLICY_REPAIR},
    {TETLOD_OPT_ON_NONFINITE, "on-nonfinite", 1, TETLOD_POLICY_ERROR},
    {TETLOD_OPT_TARGET_RATIO, "target-ratio", 0, 0},
    {TETLOD_OPT_EFFORT, "effort", 1, TETLOD_EFFORT_ACCURATE},
    {TETLOD_OPT_MAX_ERROR, "max-error", 0, 0},
    {TETLOD_OPT_MAX_DEVIATION, "max-deviation", 0, 0},
    {TETLOD_OPT_WARM_START, "warm-start", 0, 0},
    {TETLOD_OPT_REMESH, "remesh", 1, 1},
};

static void check_options(void) {
  size_t i;
  CHECK(sizeof rows / sizeof *rows == TETLOD_OPT_REMESH); /* the last one */
  for (i = 0; i < sizeof rows / sizeof *rows; i++) {
    tetlod_bounds bounds = {.struct_size = sizeof bounds};
    CHECK(tetlod_option_from_name(rows[i].name) == rows[i].option);
    OK(NULL, tetlod_option_bounds(rows[i].option, &bounds));
    CHECK(bounds.is_integer == rows[i].is_integer);
    CHECK(bounds.preset == rows[i].preset);
  }
}

void test_names(void) {
  check_stage_names();
  check_options();
}
