// Points by their exact places, so that those at one place lie side by side.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>

#include "geometry.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Of those at one place the lower comes first.
inline Array<std::int32_t> in_exact_order(Span<const Vec3> points, Job &job) {
  Array<std::int32_t> order(points.size(), &job.memory);
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](std::int32_t i) -> const Vec3 & { return points[std::size_t(i)]; };
  std::sort(order.begin(), order.end(), PollingLess(job, 0, [&](std::int32_t i, std::int32_t j) {
              return at(i) != at(j) ? is_before(at(i), at(j)) : i < j;
            }));
  return order;
}

}  // namespace tetlod
