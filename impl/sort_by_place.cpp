#include "sort_by_place.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Bits of a code for each axis, and those that one pass of the sort looks at.
constexpr int axis_bits = 16, digit_bits = 12;

struct Coded {
  std::uint64_t code;
  std::int32_t number;
};

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
    code |= spread(std::uint64_t(share * ((1 << axis_bits) - 1))) << k;
  }
  return code;
}

/// By the digit from bit `shift` on; what is equal in it keeps its order.
void sort_by_digit(const Array<Coded> &codes, int shift, Job &job, Array<Coded> &sorted) {
  const auto digit = [&](const Coded &of) { return std::size_t(of.code >> shift) & ((1 << digit_bits) - 1); };
  std::array<std::uint32_t, (1 << digit_bits) + 1> next{};
  for (const Coded &of : codes) next[digit(of) + 1]++;
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t i = 0; i < codes.size(); i++) {
    job.poll_at(i, 0);
    sorted[next[digit(codes[i])]++] = codes[i];
  }
}

/// Whether those side by side in memory are so in space, of a sample.
bool are_near(std::size_t count, const std::function<Vec3(std::size_t)> &place) {
  constexpr std::size_t enough = 1024;
  constexpr double near = 0.05;  // of the diagonal; places anywhere are 0.3 apart
  Box box;
  double way = 0;
  std::size_t looked_at = 0;
  for (std::size_t i = 1; i < count; i += count / enough + 1, looked_at++) {
    way += glm::distance(place(i - 1), place(i));
    box.add(place(i));
  }
  return way <= near * box.diagonal() * double(looked_at);
}

}  // namespace

Array<std::int32_t> order_by_place(std::size_t count, const std::function<Vec3(std::size_t)> &place, Job &job) {
  Box box;
  for (const Box &part : parts_of(count, Box(), job, [&](Box &of, std::size_t i) { of.add(place(i)); })) box.add(part);
  Array<Coded> codes(count, Coded{}, &job.memory), sorted(count, Coded{}, &job.memory);
  job.poll(0);
  job.parallel.for_blocks(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) codes[i] = {morton_code(place(i), box), std::int32_t(i)};
    job.poll(0);
  });
  for (int shift = 0; shift < 3 * axis_bits; shift += digit_bits) {
    sort_by_digit(codes, shift, job, sorted);
    codes.swap(sorted);
  }
  Array<std::int32_t> order(&job.memory);
  order.reserve(codes.size());
  for (const Coded &of : codes) order.push_back(of.number);
  return order;
}

Array<std::int32_t> order_in_space(std::size_t count, const std::function<Vec3(std::size_t)> &place, Job &job) {
  if (!are_near(count, place)) return order_by_place(count, place, job);
  Array<std::int32_t> order = array_of(count, 0, job);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

void sort_by_place(Span<const Vec3> points, Array<Tet> &tets, Job &job) {
  const auto centroid = [&](std::size_t t) {
    Vec3 sum(0);
    for (std::int32_t v : tets[t]) sum += 0.25 * points[std::size_t(v)];
    return sum;
  };
  Array<Tet> sorted(&job.memory);
  sorted.reserve(tets.size());
  for (std::int32_t t : order_by_place(tets.size(), centroid, job)) sorted.push_back(tets[std::size_t(t)]);
  tets.swap(sorted);
}

}  // namespace tetlod
