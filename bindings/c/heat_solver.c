/* The stiffness matrix is never put together: it is applied tet by tet from the gradients of the shape functions, which
 * takes nine numbers a tet and no search for neighbours. */
#include "heat_solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct element {
  double g[3][3]; /* gradients at corners 1, 2, 3 times the root of the volume; at corner 0 minus their sum */
} element;

typedef struct solver {
  const heat_problem *problem;
  element *elements;
  double *diagonal, *right, *residual, *direction, *image;
} solver;

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Returns the tet's volume. */
static double make_element(const double *xyz, const int32_t c[4], element *e) {
  double edge[3][3];
  for (int k = 0; k < 3; k++) {
    for (int a = 0; a < 3; a++) edge[k][a] = xyz[3 * c[k + 1] + a] - xyz[3 * c[0] + a];
  }
  for (int k = 0; k < 3; k++) cross(edge[(k + 1) % 3], edge[(k + 2) % 3], e->g[k]);
  double six_volumes = dot3(edge[0], e->g[0]);
  double volume = fabs(six_volumes) / 6.0;
  double scale = sqrt(volume) / six_volumes;
  for (int k = 0; k < 3; k++) {
    for (int a = 0; a < 3; a++) e->g[k][a] *= scale;
  }
  return volume;
}

static void add_diagonal(const element *e, const int32_t c[4], double *diagonal) {
  double rest[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    diagonal[c[k + 1]] += dot3(e->g[k], e->g[k]);
    for (int a = 0; a < 3; a++) rest[a] += e->g[k][a];
  }
  diagonal[c[0]] += dot3(rest, rest);
}

/* A quarter of the tet's heat to each corner. */
static void add_source(const heat_problem *p, const int32_t c[4], double volume, double *right) {
  double mean = 0.25 * (p->source[c[0]] + p->source[c[1]] + p->source[c[2]] + p->source[c[3]]);
  for (int k = 0; k < 4; k++) right[c[k]] += 0.25 * volume * mean;
}

static void assemble(solver *s) {
  const heat_problem *p = s->problem;
  for (int64_t t = 0; t < p->tets; t++) {
    const int32_t *c = p->corners + 4 * t;
    double volume = make_element(p->xyz, c, &s->elements[t]);
    add_diagonal(&s->elements[t], c, s->diagonal);
    add_source(p, c, volume, s->right);
  }
}

/* out = K in. */
static void apply(const solver *s, const double *in, double *out) {
  const heat_problem *p = s->problem;
  memset(out, 0, (size_t)p->points * sizeof *out);
  for (int64_t t = 0; t < p->tets; t++) {
    const int32_t *c = p->corners + 4 * t;
    const element *e = &s->elements[t];
    double d[3] = {in[c[1]] - in[c[0]], in[c[2]] - in[c[0]], in[c[3]] - in[c[0]]};
    double flux[3];
    for (int a = 0; a < 3; a++) flux[a] = d[0] * e->g[0][a] + d[1] * e->g[1][a] + d[2] * e->g[2][a];
    double part[3];
    for (int k = 0; k < 3; k++) out[c[k + 1]] += part[k] = dot3(flux, e->g[k]);
    out[c[0]] -= part[0] + part[1] + part[2];
  }
}

/* A fixed temperature never changes: its residual counts as zero. */
static void start_residual(solver *s, const double *temperature) {
  const heat_problem *p = s->problem;
  apply(s, temperature, s->image);
  for (int64_t i = 0; i < p->points; i++) s->residual[i] = p->fixed[i] ? 0.0 : s->right[i] - s->image[i];
}

/* r' D^-1 r */
static double residual_norm(const solver *s) {
  double sum = 0;
  for (int64_t i = 0; i < s->problem->points; i++) sum += s->residual[i] * s->residual[i] / s->diagonal[i];
  return sum;
}

static void turn_direction(solver *s, double keep) {
  for (int64_t i = 0; i < s->problem->points; i++) {
    s->direction[i] = s->residual[i] / s->diagonal[i] + keep * s->direction[i];
  }
}

/* Goes along the direction to where the energy is least. */
static void step(solver *s, double norm, double *temperature) {
  const heat_problem *p = s->problem;
  apply(s, s->direction, s->image);
  double energy = 0;
  for (int64_t i = 0; i < p->points; i++) energy += s->direction[i] * s->image[i];
  double length = norm / energy;
  for (int64_t i = 0; i < p->points; i++) {
    temperature[i] += length * s->direction[i];
    if (!p->fixed[i]) s->residual[i] -= length * s->image[i];
  }
}

static int conjugate_gradients(solver *s, double tolerance, double *temperature) {
  const int most = 5000;
  start_residual(s, temperature);
  double norm = residual_norm(s), first = norm, keep = 0.0;
  for (int iteration = 0; iteration < most; iteration++) {
    if (norm <= tolerance * tolerance * first) return iteration;
    turn_direction(s, keep);
    step(s, norm, temperature);
    double next = residual_norm(s);
    keep = next / norm;
    norm = next;
  }
  return -1;
}

/* Five vectors in one block; points that no tet uses get a diagonal of one. */
static int allocate(solver *s) {
  const heat_problem *p = s->problem;
  size_t n = (size_t)p->points;
  s->elements = malloc((size_t)p->tets * sizeof *s->elements);
  s->diagonal = calloc(5 * n, sizeof *s->diagonal);
  if (s->elements == NULL || s->diagonal == NULL) return -1;
  s->right = s->diagonal + n;
  s->residual = s->diagonal + 2 * n;
  s->direction = s->diagonal + 3 * n;
  s->image = s->diagonal + 4 * n;
  return 0;
}

int heat_solve(const heat_problem *problem, double tolerance, double *temperature) {
  solver s = {problem, NULL, NULL, NULL, NULL, NULL, NULL};
  int iterations = allocate(&s);
  if (iterations == 0) {
    assemble(&s);
    for (int64_t i = 0; i < problem->points; i++) {
      if (s.diagonal[i] == 0.0) s.diagonal[i] = 1.0;
    }
    iterations = conjugate_gradients(&s, tolerance, temperature);
  }
  free(s.elements);
  free(s.diagonal);
  return iterations;
}
