/* A block with a spherical cavity, off its middle, as a tetrahedral mesh. */
#ifndef CAVITY_MESH_H
#define CAVITY_MESH_H

#include <stdint.h>

typedef struct cavity_mesh {
  int64_t points, tets;
  double *xyz;            /* 3 a point */
  int32_t *corners;       /* 4 a tet, positive winding */
  int64_t shell;          /* points on a closed layer around the cavity; points come layer by layer, */
  int64_t layers;         /* the first layer is the cavity's wall, the last one the block's surface */
  double low[3], high[3]; /* of the block */
} cavity_mesh;

/* `size` cells along each edge of the block, as many layers around the cavity: 36 size^3 tets, size 20 makes 288,000.
 * Returns 0, or -1 when memory does not suffice or size is not in 2 ... 200. */
int cavity_mesh_make(int size, cavity_mesh *mesh);
void cavity_mesh_free(cavity_mesh *mesh);

#endif
