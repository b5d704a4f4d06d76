// Which original vertices keep place and values: as the host's flags say, and those of the boundary that are restored
// because a bound does not hold without them.
#pragma once
#include "mesh.hpp"
#include "status.hpp"
#include "tet_complex.hpp"

namespace tetlod {

class KeptVertices {
 public:
  /// flags: of the host, for each of the original's vertices; empty: none.
  KeptVertices(const Array<std::uint8_t> &flags, Memory &memory) : flags_(flags), restored_(&memory) {}

  void restore(Span<const std::int32_t> some, std::size_t vertices) {
    restored_.resize(vertices, 0);
    for (std::int32_t v : some) restored_[std::size_t(v)] = held;
    restorations_++;
  }
  int restorations() const { return restorations_; }
  Span<const std::uint8_t> by_host() const { return flags_; }
  Span<const std::uint8_t> restored() const { return restored_; }

  /// Of the host's flags, if there are any: throws Status::remesh when one that was selected is not left. left: -1:
  /// none.
  void refuse_lost(Span<const std::int32_t> selected, Span<const std::int32_t> left, std::int32_t index_base,
                   Memory &memory) const {
    Array<std::uint8_t> lost(flags_, &memory);
    for (std::int32_t v : left)
      if (v >= 0) lost[std::size_t(v)] = 0;
    for (std::int32_t v : selected)
      if (lost[std::size_t(v)])
        fail(Status::remesh, "vertex %lld is to be kept, and is no vertex of the simplified solid",
             (long long)v + index_base);
  }

  /// Of points that are these original vertices, or, -1, none.
  Array<std::uint8_t> flags_of(Span<const std::int32_t> origin, Memory &memory) const {
    Array<std::uint8_t> flags(&memory);
    if (flags_.empty() && restored_.empty()) return flags;
    for (std::int32_t v : origin) flags.push_back(v < 0 ? 0 : at(flags_, v) | at(restored_, v));
    return flags;
  }

 private:
  static std::uint8_t at(Span<const std::uint8_t> flags, std::int32_t v) {
    return flags.empty() ? 0 : flags[std::size_t(v)];
  }

  const Array<std::uint8_t> &flags_;
  Array<std::uint8_t> restored_;
  int restorations_ = 0;
};

}  // namespace tetlod
