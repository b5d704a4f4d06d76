// What is done of a solid's collapses in a round: by one block, and by all.
#pragma once
#include "solid_costs.hpp"
#include "solid_places.hpp"
#include "surface_distance.hpp"

namespace tetlod {

struct RoundSums {
  std::int64_t gone = 0;                     ///< tets
  std::size_t within_limit = 0, waited = 0;  ///< vertices, as far as is known
  std::size_t refused = 0, slivers = 0;      ///< vertices, in all and for such a triangle alone
  std::size_t collapses = 0;
  double cost = 0;

  void add(const RoundSums &o) {
    gone += o.gone;
    within_limit += o.within_limit;
    waited += o.waited;
    refused += o.refused;
    slivers += o.slivers;
    collapses += o.collapses;
    cost += o.cost;
  }
  bool most_waited() const { return waited * 8 > within_limit * 7; }
  bool outnumber_collapses(std::size_t vertices) const {
    constexpr std::size_t few = 100;  // they say nothing
    return vertices > collapses / 2 + few;
  }
};

template <std::size_t m>
struct SolidWork {
  explicit SolidWork(Memory &memory) : items(&memory), collapse(memory), edges(memory), samples(memory) {}
  Array<std::int32_t> items;
  SolidCollapse<m> collapse;
  EdgeCosts edges;
  SamplesOfStar samples;
  std::int64_t most = 0;  ///< tets that may go
  RoundSums done;
};

}  // namespace tetlod
