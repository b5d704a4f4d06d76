// What the host calls vertices and tets: messages name them so.
#pragma once
#include "mesh.hpp"

namespace tetlod {

struct HostNumbers {
  std::int64_t base = 0;                    ///< of the host's first vertex, and first tet
  Span<const std::int32_t> vertices, tets;  ///< of each here, which one it is of the host's; empty: the same

  long long vertex(std::int32_t v) const { return in(vertices, v) + base; }
  long long tet(std::size_t t) const { return in(tets, std::int32_t(t)) + base; }

 private:
  static long long in(Span<const std::int32_t> numbers, std::int32_t i) {
    return numbers.empty() ? i : numbers[std::size_t(i)];
  }
};

inline HostNumbers host_numbers(const Surface &surface, std::int64_t base) { return {base, surface.origin, {}}; }

}  // namespace tetlod
