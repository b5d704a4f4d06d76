#include "sort_by_place.hpp"

#include <algorithm>
#include <functional>

namespace tetlod {

namespace {

/// The lower 21 bits, each followed by two zeros.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

std::uint64_t morton_code(const Vec3 &p, const Box &box) {
  const Vec3 extent = box.high - box.low;
  std::uint64_t code = 0;
  for (int k = 0; k < 3; k++) {
    const double share = extent[k] > 0 ? std::clamp((p[k] - box.low[k]) / extent[k], 0.0, 1.0) : 0.0;
    code |= spread(std::uint64_t(share * 0x1fffff)) << k;
  }
  return code;
}

}  // namespace

void sort_by_place(Span<const Vec3> points, Array<Tet> &tets, Job &job) {
  const Box box = box_of(points);
  Array<std::pair<std::uint64_t, std::int32_t>> order(&job.memory);
  order.reserve(tets.size());
  for (std::size_t t = 0; t < tets.size(); t++) {
    if (t % 65536 == 0) job.poll(0);
    Vec3 centroid(0);
    for (std::int32_t v : tets[t]) centroid += 0.25 * points[std::size_t(v)];
    order.push_back({morton_code(centroid, box), std::int32_t(t)});
  }
  std::sort(order.begin(), order.end(), PollingLess(job, 0, std::less<>()));
  Array<Tet> sorted(&job.memory);
  sorted.reserve(tets.size());
  for (const auto &[code, t] : order) sorted.push_back(tets[std::size_t(t)]);
  tets.swap(sorted);
}

}  // namespace tetlod
