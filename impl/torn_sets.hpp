// Sets of parts that stay apart, as some of their parts do, while others are joined.
#pragma once
#include <unordered_map>
#include <unordered_set>

#include "disjoint_sets.hpp"
#include "pipeline.hpp"

namespace tetlod {

class TornSets {
 public:
  /// parts: joined from here on by join() alone.
  TornSets(const Torn &torn, DisjointSets &parts, Memory &memory)
      : parts_(parts), name_(&memory), apart_from_(&memory) {
    for (const auto &[one, other] : torn) {
      const std::int32_t a = parts_.lowest(one), b = parts_.lowest(other);
      if (a == b) continue;
      const std::size_t of_a = name_of(a), of_b = name_of(b);
      apart_from_[of_a].insert(of_b);
      apart_from_[of_b].insert(of_a);
    }
  }

  /// The sets of a and b, unless they stay apart.
  void join(std::int32_t a, std::int32_t b) {
    a = parts_.lowest(a);
    b = parts_.lowest(b);
    if (a == b) return;
    const auto of_a = name_.find(a), of_b = name_.find(b);
    const bool both_are_named = of_a != name_.end() && of_b != name_.end();
    if (both_are_named && apart_from_[of_a->second].count(of_b->second) > 0) return;
    parts_.join(a, b);
    if (both_are_named)
      name_[std::min(a, b)] = unite(of_a->second, of_b->second);
    else if (of_a != name_.end() || of_b != name_.end())
      name_[std::min(a, b)] = (of_a != name_.end() ? of_a : of_b)->second;
  }

 private:
  std::size_t name_of(std::int32_t set) {
    const auto [at, is_new] = name_.try_emplace(set, apart_from_.size());
    if (is_new) apart_from_.emplace_back();
    return at->second;
  }

  /// The name of both: that of the one with more to stay apart from, so that few have to be told.
  std::size_t unite(std::size_t a, std::size_t b) {
    if (apart_from_[a].size() < apart_from_[b].size()) std::swap(a, b);
    for (const std::size_t other : apart_from_[b]) {
      apart_from_[other].erase(b);
      apart_from_[other].insert(a);
      apart_from_[a].insert(other);
    }
    apart_from_[b].clear();
    return a;
  }

  DisjointSets &parts_;
  std::pmr::unordered_map<std::int32_t, std::size_t> name_;  // of a set, by its lowest part; none: it may join any
  Array<std::pmr::unordered_set<std::size_t>> apart_from_;   // of each name, names
};

}  // namespace tetlod
