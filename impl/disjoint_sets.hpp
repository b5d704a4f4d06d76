// Things that are joined bit by bit into sets, each known by its lowest member.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>

#include "memory.hpp"

namespace tetlod {

class DisjointSets {
 public:
  DisjointSets(std::size_t count, Memory &memory) : parent_(count, &memory), count_(std::int64_t(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(std::int32_t a, std::int32_t b) {
    a = lowest(a);
    b = lowest(b);
    if (a == b) return;
    parent_[std::size_t(std::max(a, b))] = std::min(a, b);
    count_--;
  }
  std::int32_t lowest(std::int32_t i) {
    while (parent_[std::size_t(i)] != i) i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
    return i;
  }
  std::int64_t count() const { return count_; }

 private:
  Array<std::int32_t> parent_;
  std::int64_t count_;
};

}  // namespace tetlod
