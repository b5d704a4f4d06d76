/* A tetrahedral mesh with a field as a .vtu file (VTK's XML unstructured grid, raw appended data). */
#ifndef WRITE_VTU_H
#define WRITE_VTU_H

#include <stdint.h>

typedef struct vtu_mesh {
  int64_t points, tets;
  const double *xyz;      /* 3 a point */
  const int32_t *corners; /* 4 a tet */
  const double *values;   /* 1 a point */
  const char *name;       /* of the values; no characters that XML treats as its own */
} vtu_mesh;

/* Returns 0, or -1 with errno set; a file that could not be written whole is removed. */
int write_vtu(const char *path, const vtu_mesh *mesh);

#endif
