#include "transfer.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace tetlod {

namespace {

constexpr std::size_t block = 1 << 13;

template <class From>
double mean(const unsigned char *const tuple[4], std::int64_t offset, const std::array<double, 4> &weights) {
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < 4; k++) {
    const double value = double(reinterpret_cast<const From *>(tuple[k] + offset)[0]);
    sum += weights[k] == 0 ? 0 : weights[k] * value;  // 0 times infinity is no number
    low = value < low ? value : low;
    high = value > high ? value : high;
  }
  return sum < low ? low : sum > high ? high : sum;
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

template <class From, class To>
void move_mean(const Stencil &stencil, std::size_t i, const StridedArray &from, const StridedArray &to) {
  const unsigned char *tuple[4];
  for (std::size_t k = 0; k < 4; k++) tuple[k] = from.data + stencil.ids[i][k] * from.tuple_stride;
  const std::array<double, 4> weights = stencil.weights[i];  // a copy, which what is written cannot change
  const bool itself = weights[0] == 1;                       // also when its value is not finite
  unsigned char *out = to.data + std::int64_t(i) * to.tuple_stride;
  const int components = to.components;
  const std::int64_t out_stride = to.component_stride, in_stride = from.component_stride;
  for (std::int64_t c = 0; c < components; c++, out += out_stride) {
    const double value = itself ? double(reinterpret_cast<const From *>(tuple[0] + c * in_stride)[0])
                                : mean<From>(tuple, c * in_stride, weights);
    reinterpret_cast<To *>(out)[0] = To(value);
  }
}

/// The vertex that counts most; of several the first.
std::int32_t heaviest(const Stencil &stencil, std::size_t i) {
  const std::array<double, 4> &weights = stencil.weights[i];
  return stencil.ids[i][std::size_t(std::max_element(weights.begin(), weights.end()) - weights.begin())];
}

/// Original vertices lie anywhere in memory: they are asked for some points ahead.
void prefetch(const Stencil &stencil, std::size_t i, const StridedArray &from) {
  constexpr std::size_t ahead = 12;
  if (i + ahead >= stencil.ids.size()) return;
  for (std::int32_t id : stencil.ids[i + ahead]) __builtin_prefetch(from.data + id * from.tuple_stride);
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
      for (std::size_t i = begin; i < end; i++) {
        prefetch(stencil, i, from);
        if constexpr (std::is_integral_v<From>)
          move_copy<From, To>(heaviest(stencil, i), i, from, to);
        else
          move_mean<From, To>(stencil, i, from, to);
      }
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
