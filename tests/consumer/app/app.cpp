// The C++ wrapper of an installed tetlod: a cube of six tets with a linear field comes back exact; a failure is told.
#include <cmath>
#include <cstdio>
#include <tetlod.hpp>

// The library's exceptions stay inside, also where both are linked into one program.
static bool fails_as_told() {
  tetlod::Context lod;
  try {
    lod.run();
  } catch (const tetlod::Error &error) {
    return error.status() == TETLOD_ERR_STATE;
  }
  return false;
}

int main() {
  if (!fails_as_told()) return 1;
  try {
    double xyz[24], values[8];
    for (int v = 0; v < 8; v++) {
      for (int k = 0; k < 3; k++) xyz[3 * v + k] = v >> k & 1;
      values[v] = xyz[3 * v] + 2 * xyz[3 * v + 1] - 3 * xyz[3 * v + 2];
    }
    const int tets[24] = {0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7, 0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7};
    tetlod::Context lod;
    lod.set_sigma(1);
    lod.submit_points({xyz, 8, 3});
    lod.submit_tets({tets, 6, 4}, 0);
    lod.submit_scalars("linear", {values, 8});
    lod.run();
    int points = 0;
    double sum = 0;
    for (double value : lod.view_scalars()) points++, sum += value;
    std::printf("C++: %d points\n", points);
    return points == 8 && std::abs(sum) < 1e-12 ? 0 : 1;
  } catch (const tetlod::Error &error) {
    std::printf("%d: %s\n", int(error.status()), error.what());
    return 1;
  }
}
