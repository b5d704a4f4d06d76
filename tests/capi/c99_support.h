/* What the C99 tests of the ABI share: checks, a mesh, a result kept for comparison. */
#ifndef C99_SUPPORT_H
#define C99_SUPPORT_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "tetlod.h"

/* ---- Checks ----------------------------------------------------------------------------------------------------- */

#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
/* The call succeeds; otherwise its message is printed. */
#define OK(context, call) check_ok(context, call, #call, __FILE__, __LINE__)
/* The call fails with `status` and a message with every word of `words` (separated by spaces). */
#define FAILS(context, call, status, words) check_failure(context, call, status, words, #call, __FILE__, __LINE__)

int check_that(int condition, const char *what, const char *file, int line);
int check_ok(const tetlod_context *context, tetlod_status got, const char *what, const char *file, int line);
void check_failure(const tetlod_context *context, tetlod_status got, tetlod_status wanted, const char *words,
                   const char *what, const char *file, int line);
int checks_made(void);
int checks_failed(void);

/* ---- Meshes ------------------------------------------------------------------------------------------------------ */

/* The unit cube as n x n x n cells of 6 tets, with the field 1 + x + 2 y + 4 z. For n a power of 2 all numbers are
 * floats. */
typedef struct cube {
  int64_t points, tets;
  double *xyz;
  int32_t *corners;
  double *values;
} cube;

cube make_cube(int n);
void free_cube(cube *mesh);
double linear_field(const double *p);

/* Packed arrays. */
tetlod_array array_of(int32_t type, int64_t tuples, int32_t components, const void *data);
tetlod_array points_of(const cube *mesh);
tetlod_array tets_of(const cube *mesh);
tetlod_array values_of(const cube *mesh);

tetlod_context *new_context(void);
void submit_cube(tetlod_context *context, const cube *mesh);
/* A context with the cube in it and run. */
tetlod_context *new_run(const cube *mesh);

/* ---- Results ----------------------------------------------------------------------------------------------------- */

typedef struct result {
  int64_t points, tets, triangles;
  double *xyz, *values;
  int32_t *corners, *boundary;
  uint64_t hash;
} result;

result fetch_result(const tetlod_context *context);
void free_result(result *kept);
int same_result(const result *a, const result *b);
/* The context still has this result. */
#define HAS_RESULT(context, kept) check_has_result(context, kept, __FILE__, __LINE__)
void check_has_result(const tetlod_context *context, const result *kept, const char *file, int line);

/* Memory with a margin on both sides that nobody may write to. */
typedef struct guarded {
  unsigned char *block;
  size_t size;
} guarded;

guarded new_guarded(size_t size);
void *guarded_data(const guarded *memory);
int margins_untouched(const guarded *memory);
int whole_untouched(const guarded *memory);
void free_guarded(guarded *memory);

/* ---- The tests, a file each ------------------------------------------------------------------------------------- */

void test_texts(void);
void test_names(void);
void test_contexts(void);
void test_options(void);
void test_submit(void);
void test_layouts(void);
void test_fetch(void);
void test_error_and_histogram(void);
void test_mesh_statuses(void);

#endif
