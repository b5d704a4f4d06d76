// Two boxes, of which a tree asks the same at a time.
#pragma once
#include "mesh.hpp"

namespace tetlod {

struct BoxPair {
  /// A number of each: processors reckon with both at once.
  using Both = double __attribute__((vector_size(2 * sizeof(double))));

  Both low[3], high[3];

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static BoxPair empty() {
    BoxPair pair;
    for (int k = 0; k < 3; k++) pair.low[k] = Both{infinity, infinity}, pair.high[k] = -pair.low[k];
    return pair;
  }

  void set(int which, const Box &box) {
    for (int k = 0; k < 3; k++) low[k][which] = box.low[k], high[k][which] = box.high[k];
  }
  Box get(int which) const {
    return {{low[0][which], low[1][which], low[2][which]}, {high[0][which], high[1][which], high[2][which]}};
  }
  Box whole() const {
    Box box = get(0);
    box.add(get(1));
    return box;
  }

  /// From p, squared; without end from an empty one.
  Both distances2(const Vec3 &p) const {
    Both sum{};
    for (int k = 0; k < 3; k++) {
      const Both at{p[k], p[k]}, below = low[k] - at, above = at - high[k], out = below > above ? below : above,
                                 distance = out > Both{} ? out : Both{};
      sum += distance * distance;
    }
    return sum;
  }

  struct Which {
    bool first, second;
  };
  Which overlapping(const Box &box) const {
    auto all = (low[0] <= box.high[0]) & (high[0] >= box.low[0]);
    for (int k = 1; k < 3; k++) all &= (low[k] <= box.high[k]) & (high[k] >= box.low[k]);
    return {all[0] != 0, all[1] != 0};
  }
};

}  // namespace tetlod
