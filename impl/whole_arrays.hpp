// Steps over whole arrays by all threads, with the same outcome for any number of them. Of many millions of items each
// takes longer than a host is to wait, so that they poll.
#pragma once
#include <algorithm>
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// The items that one thread takes at a time.
constexpr std::size_t stretch = 1 << 14;

/// As resize, some items at a time: to touch the room for all at once takes long.
template <class T, class... Value>
void grow(Array<T> &array, std::size_t size, Job &job, const Value &...value) {
  constexpr std::size_t some = (std::size_t(1) << 22) / sizeof(T);
  array.reserve(size);
  while (array.size() < size) {
    array.resize(std::min(size, array.size() + some), value...);
    job.poll(0);
  }
}

template <class T>
Array<T> array_of(std::size_t size, const T &value, Job &job) {
  Array<T> array(&job.memory);
  grow(array, size, job, value);
  return array;
}

/// Of each point, whether a tet has it.
inline Array<std::uint8_t> find_used(Span<const Tet> tets, std::size_t points, Job &job) {
  Array<std::uint8_t> used(points, 0, &job.memory);
  for (std::size_t t = 0; t < tets.size(); t++) {
    if (t % stretch == 0) job.poll(0);
    for (std::int32_t v : tets[t]) used[std::size_t(v)] = 1;
  }
  return used;
}

/// visit(i) for each of `count`.
template <class Visit>
void for_each(std::size_t count, Job &job, const Visit &visit) {
  job.parallel.for_blocks(count, stretch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) visit(i);
    job.poll(0);
  });
}

/// What add(part, i) makes of the items of each stretch of `count`, from `none` on.
template <class T, class Add>
Array<T> parts_of(std::size_t count, const T &none, Job &job, const Add &add) {
  Array<T> parts(count / stretch + 1, none, &job.memory);
  job.parallel.for_blocks(count, stretch, [&](std::size_t begin, std::size_t end) {
    T part = none;
    for (std::size_t i = begin; i < end; i++) add(part, i);
    parts[begin / stretch] = part;
    job.poll(0);
  });
  return parts;
}

/// Unlike shrink_to_fit, this fails where there is no memory.
template <class T>
void give_spare_back(Array<T> &items) {
  items = Array<T>(items, items.get_allocator());
}

/// Those items alone whose place i keep(i) says, in their order; in place, unless much room would be left over.
template <class T, class Keep>
void keep_where(Array<T> &items, Job &job, const Keep &keep) {
  Array<std::size_t> kept(items.size() / stretch + 1, 0, &job.memory);
  job.parallel.for_blocks(items.size(), stretch, [&](std::size_t begin, std::size_t end) {
    std::size_t to = begin;
    for (std::size_t i = begin; i < end; i++) {
      const bool kept_too = keep(i);
      items[to] = items[i];
      to += kept_too;
    }
    kept[begin / stretch] = to - begin;
    job.poll(0);
  });
  T *end = items.data() + kept[0];
  for (std::size_t i = 1; i < kept.size(); i++) {
    const T *const from = items.data() + i * stretch;
    end = std::copy(from, from + kept[i], end);
  }
  items.resize(std::size_t(end - items.data()));
  if (items.capacity() > 2 * items.size()) give_spare_back(items);
}

}  // namespace tetlod
