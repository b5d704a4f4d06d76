// The fuzzer's input, read piece by piece. Zeros follow its end, so that every input means something.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t *data, std::size_t size) : at_(data), end_(data + size) {}

  std::size_t left() const { return std::size_t(end_ - at_); }
  bool empty() const { return at_ == end_; }

  template <class T>
  T raw() {
    T value{};
    const std::size_t size = std::min(sizeof value, left());
    if (size) std::memcpy(&value, at_, size);
    at_ += size;
    return value;
  }
  std::uint8_t byte() { return raw<std::uint8_t>(); }

  /// In [0, count).
  std::size_t below(std::size_t count) {
    if (count < 2) return 0;
    return std::size_t(count <= 256 ? byte() : raw<std::uint16_t>()) % count;
  }
  /// In [least, most].
  std::int64_t between(std::int64_t least, std::int64_t most) {
    return least + std::int64_t(below(std::size_t(most - least + 1)));
  }
  /// Rare when the input is random, never at its end.
  bool one_in(std::size_t count) { return below(count) == count - 1; }

  /// In [0, 1], both included.
  double fraction() { return double(raw<std::uint16_t>()) / 65535; }

  /// Any double, the awkward ones often.
  double real() {
    constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::min();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    static const double awkward[] = {0,        -0.0,      1,           -1,    0.5,   1e-9,   least,
                                     -least,   5e-324,    most,        -most, 1e150, 1e-150, 4503599627370497.5,
                                     infinity, -infinity, std::nan("")};
    switch (below(8)) {
      case 0: return awkward[below(std::size(awkward))];
      case 1: return raw<double>();
      case 2: return std::pow(10.0, double(raw<std::int8_t>()));
      case 3: return -fraction();
      case 4: return double(raw<std::int8_t>());
      default: return fraction();
    }
  }

 private:
  const std::uint8_t *at_, *end_;
};

}  // namespace fuzz
