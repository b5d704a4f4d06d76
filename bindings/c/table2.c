#include "table2.h"

#include <string.h>

enum { kLabelWidth = 30, kNumberWidth = 12 };

static void label(FILE *to, const char *text) { fprintf(to, "  %-*s", kLabelWidth, text); }

/* 1234567 as 1,234,567. */
static void grouped(int64_t n, char out[32]) {
  char digits[32];
  snprintf(digits, sizeof digits, "%lld", (long long)n);
  size_t length = strlen(digits), at = 0;
  for (size_t i = 0; i < length; i++) {
    if (i > 0 && (length - i) % 3 == 0 && digits[i - 1] != '-') out[at++] = ',';
    out[at++] = digits[i];
  }
  out[at] = '\0';
}

static void count_row(FILE *to, const char *text, int64_t n) {
  char number[32];
  grouped(n, number);
  label(to, text);
  fprintf(to, "%*s\n", kNumberWidth, number);
}

static double percent(double part, double whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

static void share_row(FILE *to, const char *text, int64_t n, int64_t whole, const char *of) {
  char number[32];
  grouped(n, number);
  label(to, text);
  fprintf(to, "%*s %8.2f %% of %s\n", kNumberWidth, number, percent((double)n, (double)whole), of);
}

static void real_row(FILE *to, const char *text, double value, const char *unit) {
  label(to, text);
  fprintf(to, "%*.3f%s%s\n", kNumberWidth, value, unit[0] != '\0' ? " " : "", unit);
}

/* Bounds may be very small. */
static void share_of(FILE *to, const char *text, double share, const char *of) {
  label(to, text);
  fprintf(to, "%*.4g %% of %s\n", kNumberWidth, 100.0 * share, of);
}

static void error_row(FILE *to, const char *text, double value) {
  label(to, text);
  fprintf(to, "%*.4f %%\n", kNumberWidth, 100.0 * value);
}

/* What a size or a bound goes by. */
static void target_parameters(FILE *to, const tetlod_context *context, double ratio, double bound) {
  double deviation = 0;
  int64_t effort = 0;
  tetlod_get_real(context, TETLOD_OPT_MAX_DEVIATION, &deviation);
  tetlod_get_int(context, TETLOD_OPT_EFFORT, &effort);
  if (ratio > 0) share_of(to, "target ratio", ratio, "the sound tets");
  if (bound > 0) share_of(to, "largest error allowed", bound, "range");
  if (deviation > 0) share_of(to, "largest deviation allowed", deviation, "diagonal");
  label(to, "effort");
  fprintf(to, "%*s\n", kNumberWidth, effort == TETLOD_EFFORT_FAST ? "fast" : "accurate");
}

static void published_parameters(FILE *to, const tetlod_context *context) {
  double sigma = 0, rho = 0, lambda = 0, distance = 0;
  tetlod_get_real(context, TETLOD_OPT_SIGMA, &sigma);
  tetlod_get_real(context, TETLOD_OPT_RHO, &rho);
  tetlod_get_real(context, TETLOD_OPT_LAMBDA, &lambda);
  tetlod_get_real(context, TETLOD_OPT_MIN_DISTANCE, &distance);
  share_of(to, "boundary LOD (sigma)", sigma, "edges");
  share_of(to, "clustering (rho)", rho, "range");
  real_row(to, "shape weight (lambda)", lambda, "");
  share_of(to, "minimum distance", distance, "diagonal");
}

/* Returns whether rho and sigma have no meaning. */
static int parameters(FILE *to, const tetlod_context *context) {
  double ratio = 0, bound = 0;
  tetlod_get_real(context, TETLOD_OPT_TARGET_RATIO, &ratio);
  tetlod_get_real(context, TETLOD_OPT_MAX_ERROR, &bound);
  fprintf(to, "Parameters\n");
  if (ratio > 0 || bound > 0)
    target_parameters(to, context, ratio, bound);
  else
    published_parameters(to, context);
  return ratio > 0 || bound > 0;
}

static void repairs(FILE *to, const tetlod_run_report *run) {
  if (run->merged_points > 0) count_row(to, "coincident points merged", run->merged_points);
  if (run->nonfinite_points > 0) count_row(to, "points without a value", run->nonfinite_points);
  if (run->dropped_tets > 0) count_row(to, "tets dropped", run->dropped_tets);
  if (run->divided_tets > 0) count_row(to, "tets divided", run->divided_tets);
  if (run->moved_points > 0) count_row(to, "points moved", run->moved_points);
  if (run->unused_points > 0) count_row(to, "unused points", run->unused_points);
}

static void counts(FILE *to, const tetlod_run_report *run) {
  fprintf(to, "Tetrahedra\n");
  count_row(to, "original", run->tets_in);
  share_row(to, "final", run->tets_out, run->tets_in, "original");
  fprintf(to, "Boundary edges\n");
  count_row(to, "original", run->boundary_edges_in);
  share_row(to, "final", run->boundary_edges_out, run->boundary_edges_in, "original");
  fprintf(to, "Vertices\n");
  count_row(to, "original", run->points_in);
  repairs(to, run);
  count_row(to, "selected samples", run->selected_samples);
  count_row(to, "  removed: outside", run->samples_outside);
  count_row(to, "  removed: too near", run->samples_too_near);
  count_row(to, "boundary vertices", run->boundary_points_out);
  count_row(to, "inserted vertices", run->inserted_points);
  share_row(to, "Steiner points", run->steiner_points, run->points_out, "final");
  share_row(to, "final", run->points_out, run->points_in, "original");
}

static void memory(FILE *to, const tetlod_run_report *run) {
  fprintf(to, "Memory\n");
  real_row(to, "tetlod, peak", (double)run->peak_bytes / 1e6, "MB");
  real_row(to, "tetlod-remesh, peak", (double)run->worker_peak_bytes / 1e6, "MB");
}

static void optional_seconds(FILE *to, const char *text, double seconds, double *total) {
  if (seconds < 0) return;
  real_row(to, text, seconds, "");
  *total += seconds;
}

/* The paper's names, but for a run that collapsed the edges of the solid. */
static void seconds(FILE *to, const tetlod_run_report *run, const table2_seconds *around, int collapsed) {
  double stages = run->seconds_prepare + run->seconds_boundary + run->seconds_decimate + run->seconds_sample +
                  run->seconds_cull + run->seconds_remesh + run->seconds_values;
  double total = run->seconds_total;
  fprintf(to, "Seconds (%d thread%s)\n", (int)run->threads, run->threads == 1 ? "" : "s");
  optional_seconds(to, "reading mesh", around->reading, &total);
  optional_seconds(to, "solving", around->solving, &total);
  real_row(to, "preparing", run->seconds_prepare, "");
  real_row(to, "extracting boundary", run->seconds_boundary, "");
  real_row(to, collapsed ? "collapsing edges" : "simplifying boundary", run->seconds_decimate, "");
  real_row(to, "sampling points", run->seconds_sample, "");
  real_row(to, "removing samples", run->seconds_cull, "");
  real_row(to, "CDT", run->seconds_remesh, "");
  real_row(to, collapsed ? "following the field" : "Steiner scalar field", run->seconds_values, "");
  real_row(to, "other", run->seconds_total - stages, "");
  optional_seconds(to, "writing mesh", around->writing, &total);
  real_row(to, "total (real)", total, "");
  real_row(to, "  of this, tetlod_run", run->seconds_total, "");
}

static void errors(FILE *to, const tetlod_error_report *error) {
  fprintf(to, "Field error, of the range\n");
  error_row(to, "RMS at original vertices", error->rms);
  error_row(to, "maximum", error->max);
  error_row(to, "vertices outside, ignored", error->outside);
  if (error->samples_per_tet == 0) return;
  error_row(to, "RMS inside the tets", error->rms_inner);
  error_row(to, "maximum inside", error->max_inner);
}

tetlod_status table2_print(FILE *to, const tetlod_context *context, const tetlod_error_report *error,
                           const table2_seconds *around) {
  tetlod_run_report run = {.struct_size = sizeof run};
  tetlod_status status = tetlod_fetch_report(context, &run);
  if (status != TETLOD_OK) return status;
  int sized = parameters(to, context);
  counts(to, &run);
  memory(to, &run);
  seconds(to, &run, around, sized && run.seconds_cull == 0);
  if (error != NULL) errors(to, error);
  return TETLOD_OK;
}
