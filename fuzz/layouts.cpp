#include "layouts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FUZZ_ASAN
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define FUZZ_ASAN
#endif
#if defined(FUZZ_ASAN)
#include <sanitizer/asan_interface.h>
#endif

namespace fuzz {

namespace {

constexpr unsigned char pattern = 0xa7;

template <class T>
void put(unsigned char *place, T value) {
  std::memcpy(place, &value, sizeof value);
}

template <class T>
T got(const unsigned char *place) {
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

/// The lowest offset, and how many bytes there are from there.
struct Extent {
  std::int64_t low = 0, bytes = 0;
};

Extent extent_of(const Layout &layout) {
  if (layout.tuples == 0) return {};
  std::int64_t low = 0, high = 0;
  const auto add = [&](std::int64_t way) { (way < 0 ? low : high) += way; };
  add((layout.tuples - 1) * layout.tuple_stride);
  add((layout.components - 1) * layout.component_stride);
  return {low, high - low + layout.element()};
}

}  // namespace

std::int64_t Layout::element() const {
  return type == TETLOD_UINT8 ? 1 : type == TETLOD_INT32 || type == TETLOD_FLOAT32 ? 4 : 8;
}

Layout packed(std::int32_t type, std::int64_t tuples, std::int32_t components) {
  Layout layout{type, tuples, components, 0, 0};
  layout.component_stride = layout.element();
  layout.tuple_stride = components * layout.element();
  return layout;
}

Layout decode_layout(std::int32_t type, std::int64_t tuples, std::int32_t components, Bytes &in) {
  Layout layout = packed(type, tuples, components);
  const std::int64_t gap = std::int64_t(in.below(4)) * layout.element(), some = std::max<std::int64_t>(tuples, 1);
  if (in.one_in(2)) {
    layout.component_stride += gap;
    layout.tuple_stride = components * layout.component_stride + std::int64_t(in.below(3)) * layout.element();
  } else {
    layout.tuple_stride = layout.element() + gap;
    layout.component_stride = some * layout.tuple_stride + std::int64_t(in.below(3)) * layout.element();
  }
  if (in.one_in(2)) layout.tuple_stride = -layout.tuple_stride;
  if (in.one_in(2)) layout.component_stride = -layout.component_stride;
  return layout;
}

Block::Block(const Layout &layout, bool say_packed) : layout_(layout) {
  const Extent extent = extent_of(layout);
  size_ = std::size_t(extent.bytes);
  memory_ = std::make_unique<unsigned char[]>(std::max<std::size_t>(size_, 1));
  std::fill(memory_.get(), memory_.get() + size_, pattern);
  data_ = memory_.get() - extent.low;
  array_.struct_size = sizeof array_;
  array_.type = layout.type;
  array_.tuples = layout.tuples;
  array_.components = layout.components;
  array_.tuple_stride = say_packed ? 0 : layout.tuple_stride;
  array_.component_stride = say_packed ? 0 : layout.component_stride;
  array_.data = data_;
  guard(true);
}

Block::~Block() { guard(false); }

/// AddressSanitizer knows of eight bytes how many of the first may be touched: gaps before an element in the same eight
/// stay open.
void Block::guard(bool on) {
#if defined(FUZZ_ASAN)
  if (!on) {
    ASAN_UNPOISON_MEMORY_REGION(memory_.get(), size_);
    return;
  }
  ASAN_POISON_MEMORY_REGION(memory_.get(), size_);
  for (std::int64_t i = 0; i < layout_.tuples; i++)
    for (std::int32_t c = 0; c < layout_.components; c++)
      ASAN_UNPOISON_MEMORY_REGION(at(i, c), std::size_t(layout_.element()));
#else
  static_cast<void>(on);
#endif
}

void Block::set(std::int64_t tuple, std::int32_t component, double value) {
  if (layout_.type == TETLOD_FLOAT64)
    put(at(tuple, component), value);
  else
    put(at(tuple, component), std::abs(value) <= 3e38 || !std::isfinite(value) ? float(value) : HUGE_VALF);
}

void Block::set_integer(std::int64_t tuple, std::int32_t component, std::int64_t value) {
  if (layout_.type == TETLOD_INT64)
    put(at(tuple, component), value);
  else if (layout_.type == TETLOD_INT32)
    put(at(tuple, component), std::int32_t(value));
  else
    put(at(tuple, component), std::uint8_t(value));
}

double Block::real(std::int64_t tuple, std::int32_t component) const {
  return layout_.type == TETLOD_FLOAT64 ? got<double>(at(tuple, component)) : double(got<float>(at(tuple, component)));
}

std::int64_t Block::integer(std::int64_t tuple, std::int32_t component) const {
  switch (layout_.type) {
    case TETLOD_INT64: return got<std::int64_t>(at(tuple, component));
    case TETLOD_INT32: return got<std::int32_t>(at(tuple, component));
    default: return got<std::uint8_t>(at(tuple, component));
  }
}

std::vector<unsigned char> Block::bytes() {
  guard(false);
  std::vector<unsigned char> copy(memory_.get(), memory_.get() + size_);
  guard(true);
  return copy;
}

bool Block::rest_untouched(std::int64_t tuples) {
  std::vector<unsigned char> copy = bytes();
  const std::int64_t low = extent_of(layout_).low;
  for (std::int64_t i = 0; i < tuples; i++)
    for (std::int32_t c = 0; c < layout_.components; c++)
      std::fill_n(copy.begin() + std::ptrdiff_t(layout_.offset(i, c) - low), layout_.element(), pattern);
  return std::all_of(copy.begin(), copy.end(), [](unsigned char byte) { return byte == pattern; });
}

}  // namespace fuzz
