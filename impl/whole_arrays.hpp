// Steps over whole arrays by all threads, with the same outcome for any number of them. Of many millions of items each
// takes longer than a host is to wait, so that they poll.
#pragma once
#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// The items that one thread takes at a time.
constexpr std::size_t stretch = 1 << 12;

/// Room for so many items, which the system gives page by page when they are touched first: that takes longer than to
/// write to them, unless all threads touch some, each whole huge pages, which two at a time would both clear.
template <class T>
void reserve(Array<T> &array, std::size_t size, Job &job) {
  constexpr std::size_t page = 4096, huge_page = PageHeap::huge_page;
  array.reserve(size);
  const std::size_t begin = array.size() * sizeof(T), end = size * sizeof(T);
  if (job.parallel.threads() == 1 || end < begin + huge_page) return;
  auto *const bytes = reinterpret_cast<volatile unsigned char *>(array.data());
  const std::size_t before = reinterpret_cast<std::uintptr_t>(bytes + begin) % huge_page;
  job.parallel.for_blocks(end - begin + before, huge_page, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = std::max(first, before); i < last; i += page) bytes[begin + i - before] = 0;
    job.poll(0);
  });
}

/// As resize, some items at a time: to write to the room for all at once takes long.
template <class T, class... Value>
void grow(Array<T> &array, std::size_t size, Job &job, const Value &...value) {
  constexpr std::size_t some = (std::size_t(1) << 22) / sizeof(T);
  reserve(array, size, job);
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

/// visit(i) for each of `count`.
template <class Visit>
void for_each(std::size_t count, Job &job, const Visit &visit) {
  job.parallel.for_blocks(count, stretch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) visit(i);
    job.poll(0);
  });
}

/// Flags that some threads may set at the same time: all say the same.
inline void set_flag(std::uint8_t &flag) { __atomic_store_n(&flag, std::uint8_t(1), __ATOMIC_RELAXED); }

/// Of each point, whether a tet has it.
inline Array<std::uint8_t> find_used(Span<const Tet> tets, std::size_t points, Job &job) {
  Array<std::uint8_t> used(points, 0, &job.memory);
  for_each(tets.size(), job, [&](std::size_t t) {
    for (std::int32_t v : tets[t]) set_flag(used[std::size_t(v)]);
  });
  return used;
}

/// The same, where it is known, or in `room`.
inline Span<const std::uint8_t> used_points(const MeshView &mesh, Job &job, Array<std::uint8_t> &room) {
  if (!mesh.used.empty()) return mesh.used;
  room = find_used(mesh.tets, mesh.points.size(), job);
  return room;
}

/// The points that tets have, ascending. Others' coordinates and values may be no numbers.
inline Array<std::int32_t> used_vertices(const MeshView &mesh, Job &job) {
  Array<std::uint8_t> room(&job.memory);
  const Span<const std::uint8_t> used = used_points(mesh, job, room);
  Array<std::int32_t> vertices(&job.memory);
  vertices.reserve(used.size());
  for (std::size_t v = 0; v < used.size(); v++)
    if (used[v]) vertices.push_back(std::int32_t(v));
  return vertices;
}

/// What add(part, i) makes of the items of each stretch of `count`, from `none` on.
template <class T, class Add>
Array<T> parts_of(std::size_t count, const T &none, Job &job, const Add &add) {
  static_assert(std::is_trivially_copyable_v<T>, "copies of arrays would be nobody's memory");
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
