/* Texts, versions, the life of a context, options. */
#include <math.h>
#include <stdio.h>

#include "c99_support.h"

static const tetlod_status every_status[] = {
    TETLOD_OK,
    TETLOD_ERR_INTERNAL,
    TETLOD_ERR_ARGUMENT,
    TETLOD_ERR_OPTION,
    TETLOD_ERR_STATE,
    TETLOD_ERR_STRUCT_SIZE,
    TETLOD_ERR_BUFFER_SIZE,
    TETLOD_ERR_MEMORY,
    TETLOD_ERR_MEMORY_LIMIT,
    TETLOD_ERR_CANCELLED,
    TETLOD_ERR_TIME_LIMIT,
    TETLOD_ERR_MESH_EMPTY,
    TETLOD_ERR_MESH_INDEX,
    TETLOD_ERR_MESH_NONFINITE,
    TETLOD_ERR_MESH_DEGENERATE,
    TETLOD_ERR_MESH_NONMANIFOLD,
    TETLOD_ERR_MESH_INTERSECTING,
    TETLOD_ERR_MESH_PARTITION,
    TETLOD_ERR_MESH_TOO_LARGE,
    TETLOD_ERR_REMESH,
    TETLOD_ERR_BACKEND_MISSING,
    TETLOD_ERR_MAX_ERROR,
};

static void check_status_texts(void) {
  const size_t count = sizeof every_status / sizeof *every_status;
  size_t i, k;
  for (i = 0; i < count; i++) {
    CHECK(strlen(tetlod_status_text(every_status[i])) > 0);
    for (k = 0; k < i; k++)
      CHECK(strcmp(tetlod_status_text(every_status[i]), tetlod_status_text(every_status[k])) != 0);
  }
  CHECK(tetlod_status_text(-1) != NULL);
  CHECK(tetlod_status_text(INT32_MAX) != NULL);
}

void test_texts(void) {
  int32_t major = -1, minor = -1, patch = -1;
  char version[32];
  tetlod_version(&major, &minor, &patch);
  CHECK(major == TETLOD_VERSION_MAJOR && minor == TETLOD_VERSION_MINOR && patch == TETLOD_VERSION_PATCH);
  tetlod_version(NULL, NULL, NULL);
  snprintf(version, sizeof version, "%d.%d.%d", (int)major, (int)minor, (int)patch);
  CHECK(strstr(tetlod_build_info(), version) != NULL);
  CHECK(strstr(tetlod_build_info(), "AGPL") != NULL);
  CHECK(strchr(tetlod_build_info(), '\n') == NULL);
  check_status_texts();
  CHECK(strcmp(tetlod_stage_name(1), "boundary") == 0);
  CHECK(strcmp(tetlod_stage_name(2), "decimate") == 0);
  CHECK(tetlod_stage_name(-1) != NULL && tetlod_stage_name(1000) != NULL);
}

/* ---- Contexts ---------------------------------------------------------------------------------------------------- */

static tetlod_config zero_config(void) {
  tetlod_config config;
  memset(&config, 0, sizeof config);
  config.struct_size = sizeof config;
  config.api_version = TETLOD_API_VERSION;
  return config;
}

/* C99 has no aligned malloc: the block that malloc gave is kept in front of the aligned part. */
static void *test_allocate(void *user, size_t bytes, size_t alignment) {
  unsigned char *block = malloc(bytes + alignment + sizeof(void *));
  uintptr_t aligned = (uintptr_t)block + sizeof(void *) + alignment - 1;
  (void)user;
  if (!block) return NULL;
  aligned -= aligned % alignment;
  memcpy((unsigned char *)aligned - sizeof(void *), &block, sizeof(void *));
  return (void *)aligned;
}

static void test_release(void *user, void *pointer, size_t bytes, size_t alignment) {
  void *block;
  (void)user, (void)bytes, (void)alignment;
  memcpy(&block, (unsigned char *)pointer - sizeof(void *), sizeof(void *));
  free(block);
}

static void refuse_config(tetlod_config config, tetlod_status status, const char *words) {
  tetlod_context *const untouched = (tetlod_context *)(uintptr_t)0x1230, *out = untouched;
  FAILS(NULL, tetlod_create(&config, &out), status, words);
  CHECK(out == untouched);
}

static void check_configs(void) {
  tetlod_config config = zero_config();
  tetlod_context *context = NULL;
  struct {
    tetlod_config config;
    char more[64];
  } newer;

  OK(NULL, tetlod_create(&config, &context));
  tetlod_destroy(context);

  memset(&newer, 0xff, sizeof newer);
  newer.config = zero_config();
  newer.config.struct_size = sizeof newer;
  OK(NULL, tetlod_create(&newer.config, &context));
  tetlod_destroy(context);

  config.struct_size = 0;
  refuse_config(config, TETLOD_ERR_STRUCT_SIZE, "config struct_size 0");
  config = zero_config(), config.struct_size = sizeof config - 8;
  refuse_config(config, TETLOD_ERR_STRUCT_SIZE, "config struct_size");
  config = zero_config(), config.api_version = 0;
  refuse_config(config, TETLOD_ERR_STRUCT_SIZE, "api_version 0");
  config.api_version = (TETLOD_VERSION_MAJOR + 1) * 10000;
  refuse_config(config, TETLOD_ERR_STRUCT_SIZE, "api_version 10000");
  config.api_version = TETLOD_API_VERSION + 100;
  refuse_config(config, TETLOD_ERR_STRUCT_SIZE, "api_version 0.2");
  config = zero_config(), config.allocate = test_allocate;
  refuse_config(config, TETLOD_ERR_ARGUMENT, "allocate release NULL");
  config = zero_config(), config.release = test_release;
  refuse_config(config, TETLOD_ERR_ARGUMENT, "allocate release NULL");
  config = zero_config(), config.remesher = "";
  refuse_config(config, TETLOD_ERR_ARGUMENT, "remesher empty");

  config = zero_config(), config.allocate = test_allocate, config.release = test_release;
  OK(NULL, tetlod_create(&config, &context));
  tetlod_destroy(context);
  FAILS(NULL, tetlod_create(NULL, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
}

/* A null context, a misaligned one, and something else: for every function that takes one. */
static void check_bad_handle(tetlod_context *bad, const char *words) {
  const double three[3] = {0, 0, 0};
  tetlod_array array = array_of(TETLOD_FLOAT64, 1, 3, three);
  tetlod_run_report report = {.struct_size = sizeof report};
  tetlod_error_report error = {.struct_size = sizeof error};
  tetlod_mesh_report mesh = {.struct_size = sizeof mesh};
  uint64_t bytes;
  double real;
  int64_t integer;
  char room[8] = "before";
#define BAD(call) FAILS(NULL, call, TETLOD_ERR_ARGUMENT, words)
  BAD(tetlod_set_log(bad, NULL, NULL, 0));
  BAD(tetlod_set_progress(bad, NULL, NULL));
  BAD(tetlod_set_rho(bad, 0.5));
  BAD(tetlod_set_sigma(bad, 0.5));
  BAD(tetlod_set_lambda(bad, 0.5));
  BAD(tetlod_set_min_distance(bad, 0.25));
  BAD(tetlod_set_preset(bad, TETLOD_PRESET_PAPER));
  BAD(tetlod_set_real(bad, TETLOD_OPT_RHO, 0.5));
  BAD(tetlod_set_int(bad, TETLOD_OPT_SEED, 1));
  BAD(tetlod_get_real(bad, TETLOD_OPT_RHO, &real));
  BAD(tetlod_get_int(bad, TETLOD_OPT_SEED, &integer));
  BAD(tetlod_submit_points(bad, &array));
  BAD(tetlod_submit_points_xyz(bad, &array, &array, &array));
  BAD(tetlod_submit_tets(bad, &array, 0));
  BAD(tetlod_submit_scalars(bad, NULL, &array));
  BAD(tetlod_submit_field(bad, "u", TETLOD_POINT_FIELD, &array));
  BAD(tetlod_submit_steering(bad, "u", 1, &array));
  BAD(tetlod_withdraw_field(bad, "u"));
  BAD(tetlod_submit_point_flags(bad, &array));
  BAD(tetlod_clear(bad));
  BAD(tetlod_check(bad, &mesh));
  BAD(tetlod_estimate_memory(bad, &bytes));
  BAD(tetlod_run(bad));
  BAD(tetlod_measure_error(bad, 0, &error));
  BAD(tetlod_histogram(bad, 0, 1, &integer));
  BAD(tetlod_fetch_counts(bad, NULL, NULL, NULL));
  BAD(tetlod_fetch_points(bad, &array));
  BAD(tetlod_fetch_tets(bad, 0, &array));
  BAD(tetlod_fetch_boundary(bad, 0, &array));
  BAD(tetlod_fetch_scalars(bad, &array));
  BAD(tetlod_fetch_report(bad, &report));
  BAD(tetlod_fetch_field(bad, "u", &array));
  BAD(tetlod_fetch_stencil(bad, 0, &array, &array));
  BAD(tetlod_transfer(bad, &array, &array));
  BAD(tetlod_view_points(bad, &array));
  BAD(tetlod_view_tets(bad, &array));
  BAD(tetlod_view_scalars(bad, &array));
#undef BAD
  tetlod_cancel(bad);
  CHECK(tetlod_last_message(bad, room, sizeof room) > 0);
  tetlod_destroy(bad);
}

static void check_messages(void) {
  tetlod_context *context = new_context();
  char message[256], cut[6] = "xxxxx", one[1] = {'x'};
  size_t length;
  CHECK(tetlod_last_message(context, message, sizeof message) == 0 && message[0] == 0);
  FAILS(context, tetlod_set_rho(context, 2), TETLOD_ERR_OPTION, "rho 2 [0, 1]");
  length = tetlod_last_message(context, message, sizeof message);
  CHECK(length == strlen(message) && length > 5);
  CHECK(tetlod_last_message(context, cut, sizeof cut) == length);
  CHECK(strlen(cut) == 5 && strncmp(cut, message, 5) == 0);
  CHECK(tetlod_last_message(context, one, 1) == length && one[0] == 0);
  CHECK(tetlod_last_message(context, NULL, 0) == length);
  CHECK(tetlod_last_message(context, NULL, 10) == length);
  OK(context, tetlod_set_rho(context, 0.5)); /* a success leaves the message of the last failure */
  CHECK(tetlod_last_message(context, NULL, 0) == length);
  tetlod_destroy(context);
}

void test_contexts(void) {
  unsigned char something[4096] = {0};
  const uintptr_t aligned = ((uintptr_t)something + 63) & ~(uintptr_t)63;
  check_configs();
  check_bad_handle(NULL, "context NULL");
  check_bad_handle((tetlod_context *)(aligned + 1), "context misaligned");
  check_bad_handle((tetlod_context *)aligned, "context not");
  tetlod_destroy(NULL);
  check_messages();
}

/* ---- Options ----------------------------------------------------------------------------------------------------- */

static tetlod_bounds bounds_of(int32_t option) {
  tetlod_bounds bounds = {.struct_size = sizeof bounds};
  OK(NULL, tetlod_option_bounds(option, &bounds));
  return bounds;
}

static void check_real(tetlod_context *context, int32_t option, const tetlod_bounds *bounds) {
  double value = -1, nan_value = nan("");
  int64_t integer = -1;
  OK(context, tetlod_get_real(context, option, &value));
  CHECK(value == bounds->preset);
  OK(context, tetlod_set_real(context, option, bounds->least));
  OK(context, tetlod_get_real(context, option, &value));
  CHECK(value == bounds->least);
  OK(context, tetlod_set_real(context, option, bounds->most));
  FAILS(context, tetlod_set_real(context, option, nextafter(bounds->least, -1e300)), TETLOD_ERR_OPTION,
        tetlod_option_name(option));
  FAILS(context, tetlod_set_real(context, option, nextafter(bounds->most, 1e300)), TETLOD_ERR_OPTION,
        tetlod_option_name(option));
  FAILS(context, tetlod_set_real(context, option, HUGE_VAL), TETLOD_ERR_OPTION, "inf");
  FAILS(context, tetlod_set_real(context, option, -HUGE_VAL), TETLOD_ERR_OPTION, "-inf");
  FAILS(context, tetlod_set_real(context, option, nan_value), TETLOD_ERR_OPTION, "nan");
  OK(context, tetlod_get_real(context, option, &value));
  CHECK(value == bounds->most);
  FAILS(context, tetlod_set_int(context, option, 0), TETLOD_ERR_OPTION, "real");
  FAILS(context, tetlod_get_int(context, option, &integer), TETLOD_ERR_OPTION, "real");
  CHECK(integer == -1);
  FAILS(context, tetlod_get_real(context, option, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
}

static void check_integer(tetlod_context *context, int32_t option, const tetlod_bounds *bounds) {
  const int64_t least = (int64_t)bounds->least, most = (int64_t)bounds->most;
  int64_t value = -1;
  double real = -1;
  OK(context, tetlod_get_int(context, option, &value));
  CHECK((double)value == bounds->preset);
  OK(context, tetlod_set_int(context, option, least));
  OK(context, tetlod_get_int(context, option, &value));
  CHECK(value == least);
  OK(context, tetlod_set_int(context, option, most));
  FAILS(context, tetlod_set_int(context, option, least - 1), TETLOD_ERR_OPTION, tetlod_option_name(option));
  FAILS(context, tetlod_set_int(context, option, most + 1), TETLOD_ERR_OPTION, tetlod_option_name(option));
  FAILS(context, tetlod_set_int(context, option, INT64_MIN), TETLOD_ERR_OPTION, "-9223372036854775808");
  FAILS(context, tetlod_set_int(context, option, INT64_MAX), TETLOD_ERR_OPTION, "9223372036854775807");
  OK(context, tetlod_get_int(context, option, &value));
  CHECK(value == most);
  FAILS(context, tetlod_set_real(context, option, 1), TETLOD_ERR_OPTION, "integer");
  FAILS(context, tetlod_get_real(context, option, &real), TETLOD_ERR_OPTION, "integer");
  CHECK(real == -1);
  FAILS(context, tetlod_get_int(context, option, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
}

static void check_every_option(void) {
  tetlod_context *context = new_context();
  int32_t option, found = 0;
  for (option = 1; option < 100; option++) {
    const char *name = tetlod_option_name(option);
    tetlod_bounds bounds;
    if (!name) continue;
    found++;
    CHECK(tetlod_option_from_name(name) == option);
    bounds = bounds_of(option);
    CHECK(bounds.struct_size == sizeof bounds && bounds.least < bounds.most);
    CHECK(bounds.preset >= bounds.least && bounds.preset <= bounds.most);
    if (bounds.is_integer)
      check_integer(context, option, &bounds);
    else
      check_real(context, option, &bounds);
  }
  CHECK(found == TETLOD_OPT_REMESH); /* the last one */
  tetlod_destroy(context);
}

static void check_unknown_options(void) {
  tetlod_context *context = new_context();
  tetlod_bounds bounds = {.struct_size = sizeof bounds}, before = bounds;
  double real = -1;
  int64_t integer = -1;
  CHECK(tetlod_option_name(0) == NULL && tetlod_option_name(-1) == NULL && tetlod_option_name(99) == NULL);
  CHECK(tetlod_option_from_name("no-such") == 0 && tetlod_option_from_name("") == 0);
  CHECK(tetlod_option_from_name(NULL) == 0);
  FAILS(context, tetlod_set_real(context, 99, 0), TETLOD_ERR_OPTION, "99");
  FAILS(context, tetlod_set_int(context, -3, 0), TETLOD_ERR_OPTION, "-3");
  FAILS(context, tetlod_get_real(context, 99, &real), TETLOD_ERR_OPTION, "99");
  FAILS(context, tetlod_get_int(context, 0, &integer), TETLOD_ERR_OPTION, "0");
  CHECK(real == -1 && integer == -1);
  FAILS(NULL, tetlod_option_bounds(99, &bounds), TETLOD_ERR_OPTION, "99");
  CHECK(memcmp(&bounds, &before, sizeof bounds) == 0);
  bounds.struct_size = 4, before = bounds;
  FAILS(NULL, tetlod_option_bounds(TETLOD_OPT_RHO, &bounds), TETLOD_ERR_STRUCT_SIZE, "struct_size 4");
  CHECK(memcmp(&bounds, &before, sizeof bounds) == 0);
  FAILS(NULL, tetlod_option_bounds(TETLOD_OPT_RHO, NULL), TETLOD_ERR_ARGUMENT, "out NULL");
  tetlod_destroy(context);
}

static void check_shorthands_and_preset(void) {
  tetlod_context *context = new_context();
  double value = 0;
  int64_t leaf = 0;
  OK(context, tetlod_set_rho(context, 0.5));
  OK(context, tetlod_set_sigma(context, 0.25));
  OK(context, tetlod_set_lambda(context, 0.75));
  OK(context, tetlod_set_min_distance(context, 0.125));
  OK(context, tetlod_set_int(context, TETLOD_OPT_TET_LEAF, 7));
  CHECK(tetlod_get_real(context, TETLOD_OPT_RHO, &value) == TETLOD_OK && value == 0.5);
  CHECK(tetlod_get_real(context, TETLOD_OPT_SIGMA, &value) == TETLOD_OK && value == 0.25);
  CHECK(tetlod_get_real(context, TETLOD_OPT_LAMBDA, &value) == TETLOD_OK && value == 0.75);
  CHECK(tetlod_get_real(context, TETLOD_OPT_MIN_DISTANCE, &value) == TETLOD_OK && value == 0.125);
  FAILS(context, tetlod_set_sigma(context, -0.5), TETLOD_ERR_OPTION, "sigma -0.5");
  FAILS(context, tetlod_set_lambda(context, -1), TETLOD_ERR_OPTION, "lambda -1");
  FAILS(context, tetlod_set_min_distance(context, 0.75), TETLOD_ERR_OPTION, "min-distance 0.75");
  FAILS(context, tetlod_set_preset(context, 77), TETLOD_ERR_OPTION, "77");
  CHECK(tetlod_get_real(context, TETLOD_OPT_LAMBDA, &value) == TETLOD_OK && value == 0.75);
  OK(context, tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, 0.5));
  OK(context, tetlod_set_real(context, TETLOD_OPT_MAX_ERROR, 0.5));
  OK(context, tetlod_set_real(context, TETLOD_OPT_MAX_DEVIATION, 0.5));
  OK(context, tetlod_set_preset(context, TETLOD_PRESET_PAPER));
  CHECK(tetlod_get_real(context, TETLOD_OPT_TARGET_RATIO, &value) == TETLOD_OK && value == 0);
  CHECK(tetlod_get_real(context, TETLOD_OPT_MAX_ERROR, &value) == TETLOD_OK && value == 0);
  CHECK(tetlod_get_real(context, TETLOD_OPT_MAX_DEVIATION, &value) == TETLOD_OK && value == 0);
  CHECK(tetlod_get_real(context, TETLOD_OPT_LAMBDA, &value) == TETLOD_OK && value == 0.1);
  CHECK(tetlod_get_real(context, TETLOD_OPT_MIN_DISTANCE, &value) == TETLOD_OK && value == 0.01);
  CHECK(tetlod_get_int(context, TETLOD_OPT_TET_LEAF, &leaf) == TETLOD_OK && leaf == 500);
  CHECK(tetlod_get_int(context, TETLOD_OPT_BOUNDARY_LEAF, &leaf) == TETLOD_OK && leaf == 200);
  CHECK(tetlod_get_real(context, TETLOD_OPT_RHO, &value) == TETLOD_OK && value == 0.5); /* not the preset's */
  tetlod_destroy(context);
}

void test_options(void) {
  check_every_option();
  check_unknown_options();
  check_shorthands_and_preset();
}
