// A short list on the stack, for what the neighbourhood of a vertex or an edge holds.
#pragma once
#include <algorithm>
#include <cstddef>

#include "mesh.hpp"

namespace tetlod {

template <class T, std::size_t capacity>
class Few {
 public:
  Few() = default;
  /// False, and nothing is done, when the list is full.
  bool push(const T &item) {
    if (size_ == capacity) return false;
    items_[size_++] = item;
    return true;
  }
  void pop() { size_--; }
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T &operator[](std::size_t i) { return items_[i]; }
  const T &operator[](std::size_t i) const { return items_[i]; }
  T *begin() { return items_; }
  T *end() { return items_ + size_; }
  const T *begin() const { return items_; }
  const T *end() const { return items_ + size_; }
  bool has(const T &item) const { return std::find(begin(), end(), item) != end(); }
  operator Span<const T>() const { return {items_, size_}; }

 private:
  std::size_t size_ = 0;
  T items_[capacity];
};

/// Tets around a vertex or an edge that are changed together, and those that fill their place.
constexpr std::size_t largest_cavity = 96;
using Cavity = Few<std::int32_t, largest_cavity>;
using Filling = Few<Tet, largest_cavity>;

}  // namespace tetlod
