// A list for every vertex, of the simplices that have it or of its neighbours, while vertices merge.
#pragma once
#include <algorithm>

#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

class StarLists {
 public:
  /// Empty lists, with room for so many entries.
  StarLists(std::size_t vertices, std::size_t room, Job &job)
      : first_(vertices, 0, &job.memory), count_(vertices, 0, &job.memory), items_(&job.memory) {
    items_.reserve(room);
  }

  /// The simplices of each vertex, but those that are gone, whose first corner is -1. room: as above, for more than
  /// what there is.
  template <std::size_t corners>
  StarLists(Span<const std::array<std::int32_t, corners>> simplices, std::size_t vertices, std::size_t room, Job &job)
      : StarLists(vertices, room, job) {
    job.poll(0);
    for (const auto &s : simplices)
      if (s[0] >= 0)
        for (std::int32_t v : s) count_[std::size_t(v)]++;
    std::size_t next = 0;
    for (std::size_t v = 0; v < vertices; v++) {
      first_[v] = next;
      next += count_[v];
      count_[v] = 0;
    }
    items_.resize(next);
    for (std::size_t i = 0; i < simplices.size(); i++) {
      if (i % 65536 == 0) job.poll(0);
      if (simplices[i][0] < 0) continue;
      for (std::int32_t v : simplices[i]) items_[first_[std::size_t(v)] + count_[std::size_t(v)]++] = std::int32_t(i);
    }
  }

  Span<const std::int32_t> of(std::int32_t v) const {
    return {items_.data() + first_[std::size_t(v)], count_[std::size_t(v)]};
  }

  /// `list` is none of these lists.
  void set(std::int32_t v, Span<const std::int32_t> list) {
    if (list.size() <= count_[std::size_t(v)]) {
      std::copy(list.begin(), list.end(), items_.begin() + std::ptrdiff_t(first_[std::size_t(v)]));
    } else {
      count_[std::size_t(v)] = 0;
      if (items_.size() + list.size() > items_.capacity()) compact(list.size());
      first_[std::size_t(v)] = items_.size();
      items_.insert(items_.end(), list.begin(), list.end());
    }
    count_[std::size_t(v)] = std::uint32_t(list.size());
  }

  /// An entry in the list of v becomes another.
  void replace(std::int32_t v, std::int32_t entry, std::int32_t by) { *find(v, entry) = by; }
  void remove(std::int32_t v, std::int32_t entry) {
    *find(v, entry) = items_[first_[std::size_t(v)] + count_[std::size_t(v)] - 1];
    count_[std::size_t(v)]--;
  }

 private:
  std::int32_t *find(std::int32_t v, std::int32_t entry) {
    std::int32_t *begin = items_.data() + first_[std::size_t(v)];
    return std::find(begin, begin + count_[std::size_t(v)], entry);
  }

  /// Leaves out what lists have left behind.
  void compact(std::size_t more) {
    std::size_t used = more;
    for (std::uint32_t count : count_) used += count;
    Array<std::int32_t> items(items_.get_allocator());
    items.reserve(used + used / 2);
    for (std::size_t v = 0; v < first_.size(); v++) {
      const auto begin = items_.begin() + std::ptrdiff_t(first_[v]);
      first_[v] = items.size();
      items.insert(items.end(), begin, begin + std::ptrdiff_t(count_[v]));
    }
    items_ = std::move(items);
  }

  Array<std::size_t> first_;
  Array<std::uint32_t> count_;
  Array<std::int32_t> items_;
};

}  // namespace tetlod
