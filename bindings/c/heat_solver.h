/* Steady heat conduction on a tetrahedral mesh: linear finite elements, conjugate gradients. */
#ifndef HEAT_SOLVER_H
#define HEAT_SOLVER_H

#include <stdint.h>

typedef struct heat_problem {
  int64_t points, tets;
  const double *xyz;      /* 3 a point */
  const int32_t *corners; /* 4 a tet */
  const uint8_t *fixed;   /* a point: its temperature is given */
  const double *source;   /* a point: heat put in, per volume */
} heat_problem;

/* `temperature` holds the given temperatures and the first guess of the others; the solution replaces it.
 * Returns the number of iterations, -1 when memory does not suffice or the iteration does not end. */
int heat_solve(const heat_problem *problem, double tolerance, double *temperature);

#endif
