// The README's function in C++ on a mesh of ours. It prints the values that are left.
#include "block.cpp"
#include "cube.h"

int main() {
  make_points();
  make_tets();
  simplify({xyz, xyz + 3 * kPoints}, {corners, corners + 4 * kTets}, {values, values + kPoints});
}
