/* The README's function in C on a mesh of ours. */
#include "block.c"
#include "cube.h"

int main(void) {
  make_points();
  make_tets();
  return simplify(kPoints, xyz, kTets, corners, values) == TETLOD_OK ? 0 : 1;
}
