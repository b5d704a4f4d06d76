// The host's arrays, in every type and layout that tetlod_array describes, with bytes around and between the elements
// that are nobody's business.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "bytes.hpp"
#include "tetlod.h"

namespace fuzz {

/// Where the elements of an array are.
struct Layout {
  std::int32_t type = TETLOD_FLOAT64;
  std::int64_t tuples = 0;
  std::int32_t components = 1;
  std::int64_t tuple_stride = 0, component_stride = 0;  ///< never 0

  std::int64_t element() const;  ///< bytes
  std::int64_t offset(std::int64_t tuple, std::int32_t component) const {
    return tuple * tuple_stride + component * component_stride;
  }
};

Layout packed(std::int32_t type, std::int64_t tuples, std::int32_t components);
/// Interleaved or separate, forward or backward, with gaps; no two elements overlap.
Layout decode_layout(std::int32_t type, std::int64_t tuples, std::int32_t components, Bytes &in);

/// An array in memory of just the size; what is not an element is filled with a pattern, and under AddressSanitizer
/// nobody may touch it.
class Block {
 public:
  explicit Block(const Layout &layout, bool say_packed = false);
  ~Block();
  Block(const Block &) = delete;
  Block &operator=(const Block &) = delete;

  const Layout &layout() const { return layout_; }
  /// As the library is told; its strides are 0 where say_packed.
  tetlod_array array() const { return array_; }

  void set(std::int64_t tuple, std::int32_t component, double value);
  void set_integer(std::int64_t tuple, std::int32_t component, std::int64_t value);
  double real(std::int64_t tuple, std::int32_t component) const;
  std::int64_t integer(std::int64_t tuple, std::int32_t component) const;

  /// Every byte outside of the elements of the first `tuples` tuples is as it was made.
  bool rest_untouched(std::int64_t tuples);
  /// All bytes, to be compared.
  std::vector<unsigned char> bytes();

 private:
  unsigned char *at(std::int64_t tuple, std::int32_t component) const {
    return data_ + layout_.offset(tuple, component);
  }
  void guard(bool on);

  Layout layout_;
  std::size_t size_ = 0;
  std::unique_ptr<unsigned char[]> memory_;
  unsigned char *data_ = nullptr;
  tetlod_array array_{};
};

}  // namespace fuzz
