#include "transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace tetlod {

namespace {

constexpr std::size_t block = 1 << 13;
constexpr std::size_t batch = 16;  // points whose values are asked for together, as they lie anywhere in memory

/// 0 times infinity is no number, and a NaN of weight 0 has no part. What is none of infinities alone has no sign.
double sum_of_those_with_weight(const std::array<double, 4> &values, const std::array<double, 4> &weights) {
  double sum = 0;
  bool any_nan = false;
  for (std::size_t k = 0; k < 4; k++) {
    sum += weights[k] == 0 ? 0 : weights[k] * values[k];
    any_nan |= weights[k] != 0 && std::isnan(values[k]);
  }
  return std::isnan(sum) && !any_nan ? std::numeric_limits<double>::quiet_NaN() : sum;
}

/// Without a branch that depends on the point, whose vertices may be one, three or four.
double mean(const std::array<double, 4> &values, const std::array<double, 4> &weights) {
  double low = values[0], high = low, sum = weights[0] * values[0];
  for (std::size_t k = 1; k < 4; k++) {
    sum += weights[k] * values[k];
    low = values[k] < low ? values[k] : low;
    high = values[k] > high ? values[k] : high;
  }
  if (std::isnan(sum)) sum = sum_of_those_with_weight(values, weights);
  sum = sum < low ? low : sum;
  return sum > high ? high : sum;
}

/// move(a From, a To), of the types of the two arrays; To is `Narrow` or `Wide`.
template <class From, class Narrow, class Wide, class Move>
void for_types_from(bool wide, const Move &move) {
  if (wide)
    move(From(), Wide());
  else
    move(From(), Narrow());
}

template <class Move>
void for_types(const StridedArray &from, const StridedArray &to, const Move &move) {
  const bool wide = element_size(to.type) == 8;
  switch (from.type) {
    case ElementType::uint8: return for_types_from<std::uint8_t, std::uint8_t, std::int64_t>(wide, move);
    case ElementType::int32: return for_types_from<std::int32_t, std::int32_t, std::int64_t>(wide, move);
    case ElementType::int64: return move(std::int64_t(), std::int64_t());
    case ElementType::float32: return for_types_from<float, float, double>(wide, move);
    case ElementType::float64: return for_types_from<double, float, double>(wide, move);
  }
}

/// Where the original values of each point begin.
using BatchTuples = std::array<std::array<const unsigned char *, 4>, batch>;

void find_tuples(const Stencil &stencil, std::size_t begin, std::size_t end, const StridedArray &from,
                 BatchTuples &tuples) {
  for (std::size_t i = begin; i < end; i++)
    for (std::size_t k = 0; k < 4; k++) {
      tuples[i - begin][k] = from.data + stencil.ids[i][k] * from.tuple_stride;
      __builtin_prefetch(tuples[i - begin][k]);
    }
}

template <class From, class To>
void move_mean(const std::array<const unsigned char *, 4> &tuple, std::array<double, 4> weights, std::int64_t in_stride,
               unsigned char *out, const StridedArray &to) {
  for (std::int64_t c = 0; c < to.components; c++, out += to.component_stride) {
    std::array<double, 4> values;
    for (std::size_t k = 0; k < 4; k++) values[k] = double(reinterpret_cast<const From *>(tuple[k] + c * in_stride)[0]);
    reinterpret_cast<To *>(out)[0] = To(mean(values, weights));
  }
}

template <class From, class To>
void move_means(const Stencil &stencil, std::size_t begin, std::size_t end, StridedArray from, StridedArray to) {
  BatchTuples tuples;
  for (std::size_t first = begin, last; first < end; first = last) {
    last = std::min(first + batch, end);
    find_tuples(stencil, first, last, from, tuples);
    for (std::size_t i = first; i < last; i++)
      move_mean<From, To>(tuples[i - first], stencil.weights[i], from.component_stride,
                          to.data + std::int64_t(i) * to.tuple_stride, to);
  }
}

/// The vertex that counts most; of several the first.
std::int32_t heaviest(const Stencil &stencil, std::size_t i) {
  const std::array<double, 4> &weights = stencil.weights[i];
  return stencil.ids[i][std::size_t(std::max_element(weights.begin(), weights.end()) - weights.begin())];
}

template <class From, class To>
void move_copy(std::int32_t id, std::size_t i, const StridedArray &from, const StridedArray &to) {
  const unsigned char *const in = from.data + id * from.tuple_stride;
  unsigned char *const out = to.data + std::int64_t(i) * to.tuple_stride;
  for (int c = 0; c < to.components; c++)
    reinterpret_cast<To *>(out + c * to.component_stride)[0] =
        To(reinterpret_cast<const From *>(in + c * from.component_stride)[0]);
}

}  // namespace

void transfer(const Stencil &stencil, const StridedArray &from, const StridedArray &to, Job &job) {
  for_types(from, to, [&](auto in, auto out) {
    using From = decltype(in);
    using To = decltype(out);
    job.parallel.for_blocks(stencil.ids.size(), block, [&](std::size_t begin, std::size_t end) {
      if constexpr (std::is_integral_v<From>)
        for (std::size_t i = begin; i < end; i++) move_copy<From, To>(heaviest(stencil, i), i, from, to);
      else
        move_means<From, To>(stencil, begin, end, from, to);
      job.poll(1);
    });
  });
}

void transfer(Span<const std::int32_t> ids, const StridedArray &from, const StridedArray &to, Job &job) {
  for_types(from, to, [&](auto in, auto out) {
    job.parallel.for_blocks(ids.size(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i++) move_copy<decltype(in), decltype(out)>(ids[i], i, from, to);
      job.poll(1);
    });
  });
}

}  // namespace tetlod
