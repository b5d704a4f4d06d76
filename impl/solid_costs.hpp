// What the edges of a solid cost to collapse, and its vertices to remove, as far as it is known.
#pragma once
#include <algorithm>

#include "solid_state.hpp"

namespace tetlod {

template <std::size_t m>
class SolidCosts {
 public:
  SolidCosts(const SolidMesh<m> &mesh, SolidProgress &progress) : mesh_(mesh), progress_(progress) {}

  /// Whether v is looked at as one that moves into a neighbour.
  bool may_be_removed(std::int32_t v) const { return progress_.removes() && !mesh_.on_boundary(v); }

  /// An edge is looked at from one end, the one that moved last; the removal of a vertex from itself.
  bool owns(std::int32_t v, std::int32_t u) const {
    if (may_be_removed(v)) return true;
    if (may_be_removed(u)) return false;
    const int at = progress_.moved[std::size_t(v)], other_at = progress_.moved[std::size_t(u)];
    return at != other_at ? at > other_at : v < u;
  }

  /// Its other end may have moved or gone since.
  bool is_known(const CheapestEdge &edge) const {
    if (edge.other < 0 || !mesh_.has_vertex(edge.other)) return false;
    return may_be_removed(edge.other) || progress_.moved[std::size_t(edge.other)] < edge.round;
  }

  BestOfEdge of_edge(std::int32_t v, std::int32_t u) const {
    return may_be_removed(v) ? BestOfEdge{0, mesh_.cost_of_removal(v, u)} : mesh_.cost(v, u);
  }

  /// Of those of v that cost more than that.
  void find_cheapest(std::int32_t v, Neighbours &neighbours, double more_than = -infinity) {
    CheapestEdge found;
    found.round = progress_.round;
    mesh_.find_neighbours(v, neighbours);
    if (!progress_.removes())
      for (std::int32_t u : neighbours) mesh_.prefetch_quadric(u);
    for (std::int32_t u : neighbours) {
      if (!owns(v, u)) continue;
      const BestOfEdge best = of_edge(v, u);
      const bool cheaper = (best.cost > more_than) & (best.cost < found.cost);
      found.cost = cheaper ? best.cost : found.cost;
      found.t = cheaper ? best.t : found.t;
      found.other = cheaper ? u : found.other;
    }
    progress_.cheapest[std::size_t(v)] = found;
  }

  /// The cheapest of each vertex whose edges cost something else than they did.
  void find_changed(Job &job) {
    const Array<std::int32_t> &changed = progress_.changed;
    job.parallel.for_blocks(changed.size(), 256, [&](std::size_t begin, std::size_t end) {
      Neighbours neighbours(job.memory);
      for (std::size_t i = begin; i < end; i++) {
        mesh_.prefetch_after(i, changed);
        if (i + mesh_.ahead < end) mesh_.prefetch_quadric(changed[i + mesh_.ahead]);
        find_cheapest(changed[i], neighbours);
      }
      job.poll(0);
    });
  }

  /// What the cheapest edges of so many of the vertices cost at most, about; infinite where none may collapse.
  double of_cheapest(std::size_t wanted, Span<const std::int32_t> vertices, Memory &memory) const {
    constexpr std::size_t enough = 4096;  // of a sample
    const double about = of_cheapest(wanted, vertices, wanted / enough + 1, memory);
    return about < infinity ? about : of_cheapest(wanted, vertices, 1, memory);
  }

 private:
  /// By every step-th of them.
  double of_cheapest(std::size_t wanted, Span<const std::int32_t> vertices, std::size_t step, Memory &memory) const {
    Array<double> costs(&memory);
    for (std::size_t i = 0; i < vertices.size(); i += step) {
      const double cost = progress_.cheapest[std::size_t(vertices[i])].cost;
      if (cost < infinity) costs.push_back(cost);
    }
    if (costs.empty()) return infinity;
    const auto last = costs.begin() + std::ptrdiff_t(std::min(wanted / step, costs.size() - 1));
    std::nth_element(costs.begin(), last, costs.end());
    return *last;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  const SolidMesh<m> &mesh_;
  SolidProgress &progress_;
};

}  // namespace tetlod
