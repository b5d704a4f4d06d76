/* Prints what the paper's Table 2 prints of a run: counts, Steiner points, memory, seconds of each stage. */
#ifndef TABLE2_H
#define TABLE2_H

#include <stdio.h>

#include "tetlod.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Seconds that the caller spent around tetlod_run; a negative number is no row. */
typedef struct table2_seconds {
  double reading, solving, writing;
} table2_seconds;

/* The last result of `context`; `error` may be NULL. */
tetlod_status table2_print(FILE *to, const tetlod_context *context, const tetlod_error_report *error,
                           const table2_seconds *around);

#ifdef __cplusplus
}
#endif

#endif
