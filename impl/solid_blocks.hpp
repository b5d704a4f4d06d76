// Blocks of space whose insides collapse at the same time. Vertices with neighbours in another block wait for a round
// in which the cuts are elsewhere.
#pragma once
#include "solid_complex.hpp"

namespace tetlod {

class SolidBlocks {
 public:
  static constexpr std::size_t most = 8;

  SolidBlocks(std::size_t vertices, Memory &memory) : block_(vertices, 0, &memory), at_border_(vertices, 0, &memory) {}

  /// Anew in every round, of the vertices that are left; the more, the more blocks, at most so many. Depends on the
  /// mesh alone.
  void cut(const SolidComplex &mesh, Span<const std::int32_t> left, int round, std::size_t most_blocks, Job &job);

  std::size_t count() const { return count_; }
  std::size_t of(std::int32_t v) const { return count_ == 1 ? 0 : block_[std::size_t(v)]; }

  /// Whether all of its neighbours are in the same block.
  bool is_inside(std::int32_t v) const { return count_ == 1 || !at_border_[std::size_t(v)]; }
  /// Whether all of the tet's corners are in the block of v.
  bool holds(const Tet &t, std::int32_t v) const {
    return count_ == 1 || std::all_of(t.begin(), t.end(), [&](std::int32_t u) { return of(u) == of(v); });
  }

 private:
  void find_borders(const SolidComplex &mesh, Job &job);

  Array<std::uint8_t> block_, at_border_;
  std::size_t count_ = 1;
};

}  // namespace tetlod
