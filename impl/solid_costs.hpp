// What the edges of a solid cost to collapse, and its vertices to remove, as far as it is known.
#pragma once
#include <algorithm>

#include "solid_state.hpp"

namespace tetlod {

/// The edges of one vertex after another, and what each costs; for one thread at a time, which keeps the room.
struct EdgeCosts {
  explicit EdgeCosts(Memory &memory) : neighbours(memory), costs(&memory) {}
  std::size_t size() const { return neighbours.size(); }
  Neighbours neighbours;
  Array<BestOfEdge> costs;  ///< of the edge to each of these; infinite where it may not go or is looked at from there
};

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

  /// Of the edges of v.
  void find_costs(std::int32_t v, EdgeCosts &edges) const {
    const Neighbours &neighbours = edges.neighbours;
    mesh_.find_neighbours(v, edges.neighbours);
    if (edges.costs.size() < edges.size()) edges.costs.resize(edges.size());
    BestOfEdge *next = edges.costs.data();
    if (may_be_removed(v)) {
      mesh_.for_removals(v, neighbours, [&](std::int32_t, double cost) { *next++ = {0, cost}; });
      return;
    }
    for (std::int32_t u : neighbours) mesh_.prefetch_quadric(u);
    for (std::int32_t u : neighbours) *next++ = owns(v, u) ? mesh_.cost(v, u) : BestOfEdge{0, infinity};
  }

  /// Of those of v that cost more than that.
  void find_cheapest(std::int32_t v, EdgeCosts &edges, double more_than = -infinity) {
    CheapestEdge found{infinity, 0, -1, progress_.round};
    find_costs(v, edges);
    const std::int32_t *u = edges.neighbours.begin();
    for (std::size_t i = 0; i < edges.size(); i++) {
      const BestOfEdge &best = edges.costs[i];
      const bool cheaper = (best.cost > more_than) & (best.cost < found.cost);
      found.cost = cheaper ? best.cost : found.cost;
      found.t = cheaper ? best.t : found.t;
      found.other = cheaper ? u[i] : found.other;
    }
    progress_.cheapest[std::size_t(v)] = found;
  }

  /// Where a cavity around v was filled, edges between its neighbours are gone.
  void forget_lost_edges(std::int32_t v, EdgeCosts &edges) {
    mesh_.find_neighbours(v, edges.neighbours);
    for (std::int32_t u : edges.neighbours) {
      CheapestEdge &cheapest = progress_.cheapest[std::size_t(u)];
      if (cheapest.other >= 0 && !mesh_.has_edge(u, cheapest.other)) cheapest = CheapestEdge();
    }
  }

  /// The cheapest of each of these vertices that is to be looked for.
  void find_missing(Span<const std::int32_t> vertices, Job &job) {
    job.parallel.for_blocks(vertices.size(), 256, [&](std::size_t begin, std::size_t end) {
      EdgeCosts edges(job.memory);
      for (std::size_t i = begin; i < end; i++) {
        mesh_.prefetch_after(i, vertices);
        if (i + mesh_.ahead < end) mesh_.prefetch_quadric(vertices[i + mesh_.ahead]);
        if (!progress_.cheapest[std::size_t(vertices[i])].is_found()) find_cheapest(vertices[i], edges);
      }
      job.poll(0);
    });
  }

  /// What the cheapest edges of so many of the vertices cost at most, of those that are found; infinite where none may
  /// collapse.
  double of_cheapest(std::size_t wanted, Span<const std::int32_t> vertices, Memory &memory) const {
    Array<double> costs(&memory);
    for (std::int32_t v : vertices) {
      const double cost = progress_.cheapest[std::size_t(v)].cost;
      if (cost < infinity) costs.push_back(cost);
    }
    if (costs.empty()) return infinity;
    const auto last = costs.begin() + std::ptrdiff_t(std::min(wanted, costs.size() - 1));
    std::nth_element(costs.begin(), last, costs.end());
    return *last;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  const SolidMesh<m> &mesh_;
  SolidProgress &progress_;
};

}  // namespace tetlod
