// Copying a result into the caller's memory, in the caller's layout and type.
#pragma once
#include <cstddef>
#include <cstdint>

#include "strided.hpp"

namespace tetlod::capi {

template <class T, class Get>
void write_as(const StridedArray &to, std::size_t tuples, const Get &get) {
  for (std::size_t i = 0; i < tuples; i++) {
    unsigned char *const tuple = to.data + std::int64_t(i) * to.tuple_stride;
    for (int c = 0; c < to.components; c++) reinterpret_cast<T *>(tuple + c * to.component_stride)[0] = T(get(i, c));
  }
}

/// get(tuple, component), rounded to the type that the caller wants.
template <class Get>
void write(const StridedArray &to, std::size_t tuples, const Get &get) {
  switch (to.type) {
    case ElementType::int32: return write_as<std::int32_t>(to, tuples, get);
    case ElementType::int64: return write_as<std::int64_t>(to, tuples, get);
    case ElementType::float32: return write_as<float>(to, tuples, get);
    case ElementType::float64: return write_as<double>(to, tuples, get);
    case ElementType::uint8: return write_as<std::uint8_t>(to, tuples, get);
  }
}

}  // namespace tetlod::capi
