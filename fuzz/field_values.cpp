#include "field_values.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "demand.hpp"

namespace fuzz {

namespace {

std::int32_t any_real(Bytes &in) { return in.one_in(3) ? TETLOD_FLOAT32 : TETLOD_FLOAT64; }

/// Not negative, and some with more bits than a double has.
void fill_integers(Block &block, Bytes &in) {
  const std::size_t kind = in.below(3);
  for (std::int64_t i = 0; i < block.layout().tuples; i++)
    for (std::int32_t c = 0; c < block.layout().components; c++) switch (kind) {
        case 0: block.set_integer(i, c, i % 5 + c); break;
        case 1: block.set_integer(i, c, in.raw<std::int8_t>() & 127); break;
        default:
          block.set_integer(i, c, (std::int64_t(1) << 60 | i) & (block.layout().type == TETLOD_INT64 ? -1 : 127));
      }
}

/// The values of a vertex are a mean of those of four, and never beyond them.
void check_mean(const Stencil &stencil, std::size_t i, std::int32_t component, double value, const Block &original) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < 4; k++) {
    const double of = original.real(stencil.ids[i][k], component);
    if (!std::isfinite(of)) return;
    low = std::min(low, of);
    high = std::max(high, of);
  }
  DEMAND(value >= low && value <= high, "a mean, %.17g of vertex %zu, is in [%.17g, %.17g]", value, i, low, high);
}

/// That of the vertex that counts most, the first of several.
void check_heaviest(const Stencil &stencil, std::size_t i, std::int32_t component, double value,
                    const Block &original) {
  const auto &weights = stencil.weights[i];
  const auto heaviest = std::size_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
  DEMAND(value == value_of(original, stencil.ids[i][heaviest], component), "the integer of vertex %zu is an original's",
         i);
}

}  // namespace

std::int32_t any_integer(Bytes &in) { return in.one_in(2) ? TETLOD_INT64 : TETLOD_INT32; }
std::int32_t any_components(Bytes &in) { return in.one_in(16) ? 64 : std::int32_t(1 + in.below(3)); }

Layout any_layout(std::int32_t type, std::int64_t tuples, std::int32_t components, Bytes &in) {
  return in.one_in(2) ? decode_layout(type, tuples, components, in) : packed(type, tuples, components);
}

Layout any_reals(std::int64_t tuples, std::int32_t components, Bytes &in) {
  return any_layout(any_real(in), tuples, components, in);
}

Layout any_numbers(std::int64_t tuples, std::int32_t components, Bytes &in) {
  if (!in.one_in(3)) return any_reals(tuples, components, in);
  return any_layout(in.one_in(3) ? TETLOD_UINT8 : any_integer(in), tuples, components, in);
}

bool is_integer(const Block &block) {
  return block.layout().type != TETLOD_FLOAT32 && block.layout().type != TETLOD_FLOAT64;
}

/// Some are all the same, some numbers of regions, some have holes.
void fill_field(Block &block, Bytes &in) {
  if (is_integer(block)) return fill_integers(block, in);
  const std::size_t kind = in.below(5);
  const double some = in.real();
  for (std::int64_t i = 0; i < block.layout().tuples; i++)
    for (std::int32_t c = 0; c < block.layout().components; c++) switch (kind) {
        case 0: block.set(i, c, some); break;
        case 1: block.set(i, c, double(i % 5 + c)); break;
        case 2: block.set(i, c, double(in.raw<std::int8_t>())); break;
        case 3: block.set(i, c, in.real()); break;
        default: block.set(i, c, i % 7 == 3 ? std::nan("") : double(i) - c);
      }
}

std::int32_t wide_type(const Block &block) { return is_integer(block) ? TETLOD_INT64 : TETLOD_FLOAT64; }

Layout any_room_for(const Block &values, std::int64_t tuples, std::int32_t components, Bytes &in) {
  if (!is_integer(values)) return any_reals(tuples, components, in);
  const std::int32_t type = in.one_in(8) ? TETLOD_FLOAT64 : in.one_in(2) ? TETLOD_INT64 : values.layout().type;
  return any_layout(type, tuples, components, in);
}

double value_of(const Block &block, std::int64_t tuple, std::int32_t component) {
  if (!is_integer(block)) return block.real(tuple, component);
  const std::int64_t integer = block.integer(tuple, component);
  double value;
  std::memcpy(&value, &integer, sizeof value);
  return value;
}

std::vector<double> values_of(const Block &block) {
  std::vector<double> values;
  for (std::int64_t i = 0; i < block.layout().tuples; i++)
    for (std::int32_t c = 0; c < block.layout().components; c++) values.push_back(value_of(block, i, c));
  return values;
}

void check_moved(const Stencil &stencil, std::size_t i, std::int32_t component, double value, const Block &original) {
  if (is_integer(original))
    check_heaviest(stencil, i, component, value, original);
  else
    check_mean(stencil, i, component, value, original);
}

}  // namespace fuzz
