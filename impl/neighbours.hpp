// The neighbours of a vertex, found from its star whenever they are asked for: lists of them would take as much memory
// as a sixth of all that collapses need, and as much time to keep.
#pragma once
#include <cstdint>

#include "mesh.hpp"

namespace tetlod {

/// Of one vertex after another, for one thread at a time.
class Neighbours {
 public:
  explicit Neighbours(Memory &memory) : room_(&memory), seen_(std::size_t(1) << bits, 0, &memory) {}

  /// star: the tets of v, those that are gone, whose first corner is -1, among them. Each neighbour is there, in the
  /// order of the tets; some, by chance, are there again.
  void find(std::int32_t v, Span<const std::int32_t> star, Span<const Tet> tets) {
    const std::size_t most = 3 * star.size();
    if (room_.size() < most + 1 + star.size()) room_.resize(most + 1 + star.size());
    std::int32_t *const left = room_.data() + most + 1, *const end_of_left = find_left(star, tets, left);
    time_ += std::uint64_t(1) << 32;
    std::size_t count = 0;
    for (const std::int32_t *t = left; t < end_of_left; t++)
      for (std::int32_t u : tets[std::size_t(*t)]) {  // without a branch: what was seen cannot be foreseen
        const std::uint64_t now = time_ | std::uint32_t(u);
        std::uint64_t &last = seen_[(std::uint32_t(u) * spread) >> (32 - bits)];
        room_[count] = u;
        count += (now != last) & (u != v);
        last = now;
      }
    count_ = count;
  }
  const std::int32_t *begin() const { return room_.data(); }
  const std::int32_t *end() const { return room_.data() + count_; }
  std::size_t size() const { return count_; }

 private:
  static constexpr int bits = 8;
  static constexpr std::uint32_t spread = 2654435769;  // 2^32 over the golden ratio

  static std::int32_t *find_left(Span<const std::int32_t> star, Span<const Tet> tets, std::int32_t *left) {
    for (std::int32_t t : star) {
      *left = t;
      left += tets[std::size_t(t)][0] >= 0;
    }
    return left;
  }

  Array<std::int32_t> room_;   // for the neighbours, and for the tets that are left
  Array<std::uint64_t> seen_;  // at its hash, what was found there last, and when
  std::uint64_t time_ = 0;
  std::size_t count_ = 0;
};

}  // namespace tetlod
