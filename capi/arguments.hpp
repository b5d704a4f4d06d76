// Checks of what the caller hands in: pointers, structs with their sizes, arrays with their shapes. Each throws Error
// with the name of the argument and the value.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "status.hpp"
#include "strided.hpp"
#include "tetlod.h"

namespace tetlod::capi {

/// Size of a public struct up to and with a member: what a caller's struct has at least.
#define TETLOD_SIZE_TO(type, member) (offsetof(type, member) + sizeof(type::member))

void require_address(const void *pointer, std::size_t alignment, const char *name);
void require_size(std::uint32_t struct_size, std::size_t least, const char *name);
void require_index_base(std::int32_t index_base);

template <class T>
void require_pointer(const T *pointer, const char *name) {
  require_address(pointer, alignof(T), name);
}

/// A public struct of at least `least` bytes; a longer one is of a newer version.
template <class Struct>
void require_struct(const Struct *pointer, const char *name, std::size_t least) {
  require_pointer(pointer, name);
  require_size(pointer->struct_size, least, name);
}

/// Writes as much of the struct as the caller has room for, but for its struct_size.
template <class Struct>
void copy_struct(const Struct &from, Struct *out) {
  const std::size_t size = std::min<std::size_t>(out->struct_size, sizeof from), head = sizeof from.struct_size;
  std::memcpy(reinterpret_cast<char *>(out) + head, reinterpret_cast<const char *>(&from) + head, size - head);
}

/// What an array has to be.
struct Shape {
  static constexpr int any_number = 0, most_components = 64;
  const char *name;
  int components;                                      ///< or any_number: 1 to most_components
  enum Kind { reals, integers, bytes, numbers } kind;  ///< numbers: any of these
};

/// An array to read from, with less than 2^29 tuples. Nothing of its contents is looked at.
StridedArray checked_source(const tetlod_array *array, const Shape &shape);
/// An array to write `tuples` tuples to.
StridedArray checked_destination(const tetlod_array *array, const Shape &shape, std::size_t tuples);
/// What is written to one is read from the other nowhere.
void require_memory_of_its_own(const StridedArray &to, const char *to_name, const StridedArray &from,
                               const char *from_name);
/// An array struct to fill in.
void require_view(const tetlod_array *array);

}  // namespace tetlod::capi
