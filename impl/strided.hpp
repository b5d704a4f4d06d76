// Arrays of the caller, in whatever type and layout, read and written element by element.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "mesh.hpp"

namespace tetlod {

/// The numbers are those of the C ABI.
enum class ElementType : std::int32_t { int32 = 1, int64 = 2, float32 = 3, float64 = 4, uint8 = 5 };

constexpr std::size_t element_size(ElementType type) {
  switch (type) {
    case ElementType::uint8: return 1;
    case ElementType::int32:
    case ElementType::float32: return 4;
    case ElementType::int64:
    case ElementType::float64: return 8;
  }
  return 0;
}

constexpr bool is_integer(ElementType type) {
  return type == ElementType::int32 || type == ElementType::int64 || type == ElementType::uint8;
}

/// Component c of tuple i is at data + i * tuple_stride + c * component_stride (bytes). Checked before it gets here.
struct StridedArray {
  ElementType type = ElementType::float64;
  std::int64_t tuples = 0;
  int components = 0;
  std::int64_t tuple_stride = 0, component_stride = 0;
  unsigned char *data = nullptr;
  bool present = false;  ///< something was submitted

  bool packed_as(ElementType wanted) const {
    const auto size = std::int64_t(element_size(wanted));
    return type == wanted && (components == 1 || component_stride == size) && tuple_stride == components * size;
  }

  template <class T>
  T at(std::int64_t tuple, int component) const {
    return reinterpret_cast<const T *>(data + tuple * tuple_stride + component * component_stride)[0];
  }
  /// Of float32 or float64.
  double real(std::int64_t tuple, int component) const {
    return type == ElementType::float64 ? at<double>(tuple, component) : double(at<float>(tuple, component));
  }
  std::int64_t integer(std::int64_t tuple, int component) const {
    return type == ElementType::int64 ? at<std::int64_t>(tuple, component)
                                      : std::int64_t(at<std::int32_t>(tuple, component));
  }
};

/// An array of the library's own, of doubles or of integers of 64 bits.
template <class T>
StridedArray packed_array(const T *data, std::size_t tuples, int components) {
  static_assert(sizeof(T) == 8, "");
  StridedArray array;
  array.type = std::is_integral_v<T> ? ElementType::int64 : ElementType::float64;
  array.tuples = std::int64_t(tuples);
  array.components = components;
  array.component_stride = sizeof(T);
  array.tuple_stride = components * array.component_stride;
  array.data = reinterpret_cast<unsigned char *>(const_cast<T *>(data));
  array.present = true;
  return array;
}

}  // namespace tetlod
