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

Array<std::int32_t> order_by_place(Span<const Vec3> places, Job &job) {
  const Box box = box_of(places);
  Array<std::pair<std::uint64_t, std::int32_t>> codes(places.size(), &job.memory);
  job.parallel.for_blocks(places.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) codes[i] = {morton_code(places[i], box), std::int32_t(i)};
    job.poll(0);
  });
  std::sort(codes.begin(), codes.end(), PollingLess(job, 0, std::less<>()));
  Array<std::int32_t> order(&job.memory);
  order.reserve(codes.size());
  for (const auto &[code, i] : codes) order.push_back(i);
  return order;
}

void sort_by_place(Span<const Vec3> points, Array<Tet> &tets, Job &job) {
  Array<Vec3> centroids(tets.size(), Vec3(0), &job.memory);
  for (std::size_t t = 0; t < tets.size(); t++)
    for (std::int32_t v : tets[t]) centroids[t] += 0.25 * points[std::size_t(v)];
  Array<Tet> sorted(&job.memory);
  sorted.reserve(tets.size());
  for (std::int32_t t : order_by_place(centroids, job)) sorted.push_back(tets[std::size_t(t)]);
  tets.swap(sorted);
}

}  // namespace tetlod
