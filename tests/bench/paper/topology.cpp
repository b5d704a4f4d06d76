#include "topology.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace bench {
namespace {

// Sets of vertices that hang together.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t(0)); }
  std::size_t root(std::size_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

std::int64_t edges_of(const std::vector<Triangle> &boundary) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const Triangle &t : boundary) {
    for (std::size_t k = 0; k < 3; k++) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      edges.push_back({a, b});
    }
  }
  std::sort(edges.begin(), edges.end());
  return std::unique(edges.begin(), edges.end()) - edges.begin();
}

}  // namespace

Topology topology_of(const std::vector<Triangle> &boundary) {
  std::int32_t most = -1;
  for (const Triangle &t : boundary) most = std::max(most, *std::max_element(t.begin(), t.end()));
  std::vector<char> used(std::size_t(most + 1), 0);
  Sets sets(used.size());
  for (const Triangle &t : boundary) {
    for (std::size_t k = 0; k < 3; k++) {
      used[std::size_t(t[k])] = 1;
      sets.join(std::size_t(t[0]), std::size_t(t[k]));
    }
  }
  Topology topology{0, 0};
  for (std::size_t v = 0; v < used.size(); v++) {
    if (!used[v]) continue;
    topology.euler++;
    if (sets.root(v) == v) topology.components++;
  }
  topology.euler += std::int64_t(boundary.size()) - edges_of(boundary);
  return topology;
}

}  // namespace bench
