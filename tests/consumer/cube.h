/* A cube of 8 x 8 x 8 cells of six tets each, with a linear field. */
#ifndef TETLOD_CONSUMER_CUBE_H
#define TETLOD_CONSUMER_CUBE_H
#include <stdint.h>

enum { kSize = 8, kRow = kSize + 1, kPoints = kRow * kRow * kRow, kTets = 6 * kSize * kSize * kSize };

static double xyz[3 * kPoints], values[kPoints];
static int32_t corners[4 * kTets];

static double linear(const double *p) { return p[0] + 2.0 * p[1] - 3.0 * p[2]; }

static int32_t node(int i, int j, int k) { return (k * kRow + j) * kRow + i; }

static void make_points(void) {
  for (int n = 0; n < kPoints; n++) {
    double *p = xyz + 3 * n;
    p[0] = n % kRow, p[1] = n / kRow % kRow, p[2] = n / (kRow * kRow);
    values[n] = linear(p);
  }
}

/* Six tets around the diagonal of a cell, one for each order of the axes. */
static void make_tets(void) {
  static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  int32_t *at = corners;
  for (int cell = 0; cell < kSize * kSize * kSize; cell++) {
    for (int path = 0; path < 6; path++) {
      int p[3] = {cell % kSize, cell / kSize % kSize, cell / (kSize * kSize)};
      *at++ = node(p[0], p[1], p[2]);
      for (int step = 0; step < 3; step++) {
        p[order[path][step]]++;
        *at++ = node(p[0], p[1], p[2]);
      }
    }
  }
}

#endif
