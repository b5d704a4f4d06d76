// The priority queue of the edge collapse: lowest cost first, ties to the lower edge, costs that change.
#pragma once
#include <cstdint>

#include "whole_arrays.hpp"

namespace tetlod {

/// A binary heap that knows where each edge is. No allocation after the constructor.
class EdgeQueue {
 public:
  EdgeQueue(std::size_t edges, Job &job)
      : heap_(&job.memory), place_(array_of(edges, absent, job)), cost_(array_of(edges, 0.0, job)) {
    heap_.reserve(edges);
  }

  bool empty() const { return heap_.empty(); }
  std::int32_t top() const { return heap_[0]; }
  double cost(std::int32_t edge) const { return cost_[std::size_t(edge)]; }

  /// Inserts the edge, or gives it another cost.
  void set(std::int32_t edge, double cost) {
    cost_[std::size_t(edge)] = cost;
    std::int32_t at = place_[std::size_t(edge)];
    if (at == absent) {
      at = std::int32_t(heap_.size());
      heap_.push_back(edge);
      place_[std::size_t(edge)] = at;
    }
    if (!sift_up(at)) sift_down(at);
  }

  void remove(std::int32_t edge) {
    const std::int32_t at = place_[std::size_t(edge)];
    if (at == absent) return;
    const std::int32_t last = heap_.back();
    heap_.pop_back();
    place_[std::size_t(edge)] = absent;
    if (last == edge) return;
    put(at, last);
    if (!sift_up(at)) sift_down(at);
  }

 private:
  static constexpr std::int32_t absent = -1;

  bool before(std::int32_t a, std::int32_t b) const {
    const double p = cost_[std::size_t(a)], q = cost_[std::size_t(b)];
    return p < q || (p == q && a < b);
  }
  void put(std::int32_t at, std::int32_t edge) {
    heap_[std::size_t(at)] = edge;
    place_[std::size_t(edge)] = at;
  }
  bool sift_up(std::int32_t at) {
    const std::int32_t edge = heap_[std::size_t(at)];
    const std::int32_t start = at;
    while (at > 0 && before(edge, heap_[std::size_t((at - 1) / 2)])) {
      put(at, heap_[std::size_t((at - 1) / 2)]);
      at = (at - 1) / 2;
    }
    put(at, edge);
    return at != start;
  }
  void sift_down(std::int32_t at) {
    const std::int32_t edge = heap_[std::size_t(at)], size = std::int32_t(heap_.size());
    for (std::int32_t child; (child = 2 * at + 1) < size; at = child) {
      if (child + 1 < size && before(heap_[std::size_t(child + 1)], heap_[std::size_t(child)])) child++;
      if (!before(heap_[std::size_t(child)], edge)) break;
      put(at, heap_[std::size_t(child)]);
    }
    put(at, edge);
  }

  Array<std::int32_t> heap_, place_;
  Array<double> cost_;
};

}  // namespace tetlod
