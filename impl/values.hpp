// The values of the fields that steer: the scalars, and up to three more. They lie side by side, a tuple a point, in
// arrays of numbers; where the work is, how many there are is known when it is compiled.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace tetlod {

constexpr std::size_t most_fields = 4;

template <std::size_t m>
using Values = std::array<double, m>;

/// The least and the greatest of some tuples, field by field.
template <std::size_t m>
struct ValueRange {
  Values<m> low, high;

  ValueRange() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  explicit ValueRange(const Values<m> &values) : low(values), high(values) {}
  void add(const Values<m> &values) {
    for (std::size_t i = 0; i < m; i++) {
      low[i] = std::min(low[i], values[i]);
      high[i] = std::max(high[i], values[i]);
    }
  }
  void add(const ValueRange &other) {
    for (std::size_t i = 0; i < m; i++) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  /// The least also for what is not a number: sums of the largest doubles may not be one.
  Values<m> clamp(Values<m> values) const {
    for (std::size_t i = 0; i < m; i++) values[i] = std::min(high[i], std::max(low[i], values[i]));
    return values;
  }
};

/// What a unit of each field counts as, beside one of the first, of which it is 1.
struct FieldScales {
  std::array<double, most_fields> relative{1, 1, 1, 1};  ///< as if all ranges were the first's
  std::array<double, most_fields> weighted{1, 1, 1, 1};  ///< the same times the field's weight
};

/// work(m), where m is the constant of that many fields.
template <class Work>
auto with_fields(std::size_t fields, const Work &work) {
  switch (fields) {
    case 2: return work(std::integral_constant<std::size_t, 2>());
    case 3: return work(std::integral_constant<std::size_t, 3>());
    case 4: return work(std::integral_constant<std::size_t, 4>());
    default: return work(std::integral_constant<std::size_t, 1>());
  }
}

}  // namespace tetlod
