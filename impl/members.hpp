// What is in a list that grows: looked for one by one while they are few, in a table when they are many.
#pragma once
#include <algorithm>

#include "mesh.hpp"

namespace tetlod {

/// Of numbers that are not negative, each of them once.
class Members {
 public:
  explicit Members(Memory &memory) : table_(&memory) {}

  /// Whether the list has it. The list is that of the call before, or has grown since.
  bool has(Span<const std::int32_t> list, std::int32_t number) {
    constexpr std::size_t few = 64;
    if (list.size() <= few) return std::find(list.begin(), list.end(), number) != list.end();
    take_over(list);
    return table_[slot(number)] == number;
  }

 private:
  void take_over(Span<const std::int32_t> list) {
    if (2 * list.size() > table_.size()) {
      std::size_t size = 256;
      while (size < 4 * list.size()) size *= 2;
      table_.assign(size, -1);
      known_ = 0;
    }
    for (; known_ < list.size(); known_++) table_[slot(list[known_])] = list[known_];
  }

  /// Where it is, or would be.
  std::size_t slot(std::int32_t number) const {
    std::size_t at = std::size_t(std::uint32_t(number) * std::uint64_t(0x9e3779b97f4a7c15u) >> 32);
    for (at &= table_.size() - 1; table_[at] >= 0 && table_[at] != number;) at = (at + 1) & (table_.size() - 1);
    return at;
  }

  Array<std::int32_t> table_;  // twice as large as the list, or larger
  std::size_t known_ = 0;      // of the list, that are in the table
};

}  // namespace tetlod
