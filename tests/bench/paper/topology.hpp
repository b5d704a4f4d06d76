// What decimation must not change about a boundary.
#pragma once

#include <cstdint>
#include <vector>

#include "bench_mesh.hpp"

namespace bench {

struct Topology {
  std::int64_t components, euler;  // of the boundary: parts that hang together by vertices; V - E + F
};

inline bool operator==(const Topology &a, const Topology &b) {
  return a.components == b.components && a.euler == b.euler;
}

Topology topology_of(const std::vector<Triangle> &boundary);

}  // namespace bench
