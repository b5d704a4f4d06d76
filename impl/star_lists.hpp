// A list for every vertex, of the simplices that have it or of its neighbours, while vertices merge.
#pragma once
#include <algorithm>

#include "whole_arrays.hpp"

namespace tetlod {

/// Room for lists that grow, for one thread at a time.
class ListRoom {
 public:
  explicit ListRoom(Memory &memory) : pieces_(&memory) {}

  std::int32_t *take(std::size_t entries) {
    constexpr std::size_t usual = 4096;
    if (pieces_.empty() || used_ + entries > pieces_.back().size()) {
      pieces_.emplace_back(std::max(entries, usual));
      used_ = 0;
    }
    taken_ += entries;
    used_ += entries;
    return pieces_.back().data() + used_ - entries;
  }
  std::size_t taken() const { return taken_; }
  void clear() {
    pieces_.clear();
    taken_ = 0;
  }

 private:
  Array<Array<std::int32_t>> pieces_;
  std::size_t used_ = 0, taken_ = 0;
};

class StarLists {
 public:
  /// Empty lists.
  StarLists(std::size_t vertices, Job &job)
      : begin_(vertices, nullptr, &job.memory), count_(vertices, 0, &job.memory), items_(&job.memory) {}
  StarLists(StarLists &&) = default;
  StarLists &operator=(StarLists &&) = default;

  /// Lists with room for so many entries, to be set.
  StarLists(Array<std::uint32_t> &&entries, Job &job)
      : begin_(entries.size(), nullptr, &job.memory), count_(std::move(entries)), items_(&job.memory) {
    give_room(job);
  }

  /// The simplices of each vertex, but those that are gone, whose first corner is -1.
  template <std::size_t corners>
  StarLists(Span<const std::array<std::int32_t, corners>> simplices, std::size_t vertices, Job &job)
      : StarLists(vertices, job) {
    for_corners(simplices, job, [&](std::int32_t v, std::int32_t) { count_[std::size_t(v)]++; });
    give_room(job);
    std::fill(count_.begin(), count_.end(), 0);
    for_corners(simplices, job, [&](std::int32_t v, std::int32_t simplex) {
      begin_[std::size_t(v)][count_[std::size_t(v)]++] = simplex;
    });
  }

  Span<const std::int32_t> of(std::int32_t v) const { return {begin_[std::size_t(v)], count_[std::size_t(v)]}; }

  /// `list` is none of these lists.
  void set(std::int32_t v, Span<const std::int32_t> list, ListRoom &room) {
    if (list.size() > count_[std::size_t(v)]) begin_[std::size_t(v)] = room.take(list.size());
    std::copy(list.begin(), list.end(), begin_[std::size_t(v)]);
    count_[std::size_t(v)] = std::uint32_t(list.size());
  }
  void clear(std::int32_t v) { count_[std::size_t(v)] = 0; }

  /// An entry in the list of v becomes another.
  void replace(std::int32_t v, std::int32_t entry, std::int32_t by) { *find(v, entry) = by; }
  void remove(std::int32_t v, std::int32_t entry) {
    *find(v, entry) = begin_[std::size_t(v)][count_[std::size_t(v)] - 1];
    count_[std::size_t(v)]--;
  }

  /// Of the lists that lie side by side.
  std::size_t room() const { return items_.size(); }

  /// Side by side again; what lists have taken of a room is given back by who cleared it.
  void compact(Job &job) {
    const Array<std::size_t> places = beginnings(job);
    Array<std::int32_t> items(&job.memory);
    grow(items, places.back(), job);
    for_lists(places, job, [&](std::size_t v, std::size_t place) {
      begin_[v] = std::copy(begin_[v], begin_[v] + count_[v], items.data() + place) - count_[v];
    });
    items_ = std::move(items);
  }

 private:
  /// visit(vertex, simplex) for every corner: of one vertex one after another, of several at the same time.
  template <std::size_t corners, class Visit>
  void for_corners(Span<const std::array<std::int32_t, corners>> simplices, Job &job, const Visit &visit) const {
    job.parallel.for_parts(count_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = 0; i < simplices.size(); i++) {
        if (i % 65536 == 0) job.poll(0);
        if (simplices[i][0] < 0) continue;
        for (std::int32_t v : simplices[i])
          if (std::size_t(v) - begin < end - begin) visit(v, std::int32_t(i));
      }
    });
  }

  void give_room(Job &job) {
    const Array<std::size_t> places = beginnings(job);
    grow(items_, places.back(), job);
    for_lists(places, job, [&](std::size_t v, std::size_t place) { begin_[v] = items_.data() + place; });
  }

  Array<std::size_t> beginnings(Job &job) const {
    return tetlod::beginnings(count_.size(), job, [&](std::size_t v) { return count_[v]; });
  }

  /// visit(vertex, place of its list), of lists that lie side by side from the beginnings on.
  template <class Visit>
  void for_lists(Span<const std::size_t> beginnings, Job &job, const Visit &visit) const {
    job.parallel.for_blocks(count_.size(), stretch, [&](std::size_t begin, std::size_t end) {
      std::size_t place = beginnings[begin / stretch];
      for (std::size_t v = begin; v < end; v++) {
        visit(v, place);
        place += count_[v];
      }
      job.poll(0);
    });
  }

  std::int32_t *find(std::int32_t v, std::int32_t entry) {
    return std::find(begin_[std::size_t(v)], begin_[std::size_t(v)] + count_[std::size_t(v)], entry);
  }

  Array<std::int32_t *> begin_;
  Array<std::uint32_t> count_;
  Array<std::int32_t> items_;
};

}  // namespace tetlod
