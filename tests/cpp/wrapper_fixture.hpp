// A cube of tets with a linear field, submitted through the wrapper.
#pragma once

#include <algorithm>
#include <tetlod.hpp>

namespace wrapper_test {

constexpr int size = 8, row = size + 1;

struct Cube {
  std::vector<double> xyz, values;
  std::vector<std::int32_t> corners;

  Cube() {
    for (int n = 0; n < row * row * row; n++) {
      const double p[3] = {double(n % row), double(n / row % row), double(n / (row * row))};
      xyz.insert(xyz.end(), p, p + 3);
      values.push_back(p[0] + 2 * p[1] - 3 * p[2]);
    }
    for (int cell = 0; cell < size * size * size; cell++)
      add_cell(cell % size, cell / size % size, cell / (size * size));
  }

  // Six tets around the cell's diagonal, one for each order of the axes.
  void add_cell(int i, int j, int k) {
    int order[3] = {0, 1, 2};
    do {
      int p[3] = {i, j, k};
      corners.push_back((p[2] * row + p[1]) * row + p[0]);
      for (int axis : order) {
        p[axis]++;
        corners.push_back((p[2] * row + p[1]) * row + p[0]);
      }
    } while (std::next_permutation(order, order + 3));
  }

  std::int64_t points() const { return std::int64_t(values.size()); }
  std::int64_t tets() const { return std::int64_t(corners.size() / 4); }

  tetlod::Context submitted(tetlod::Context lod = {}) const {
    lod.set_rho(0.2);
    lod.set_sigma(1);
    lod.submit_points({xyz.data(), points(), 3});
    lod.submit_tets({corners.data(), tets(), 4}, 0);
    lod.submit_scalars("linear", {values.data(), points()});
    return lod;
  }
};

}  // namespace wrapper_test
