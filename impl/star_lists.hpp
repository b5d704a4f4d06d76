// A list for every vertex, of the simplices that have it, while vertices merge.
#pragma once
#include <algorithm>
#include <numeric>

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
      : begin_(vertices, nullptr, &job.memory), count_(vertices, 0, &job.memory), pieces_(&job.memory) {}
  StarLists(StarLists &&) = default;
  StarLists &operator=(StarLists &&) = default;

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

  /// The list comes nearer: usual ones are two lines of memory long.
  void prefetch(std::int32_t v) const {
    const Span<const std::int32_t> list = of(v);
    __builtin_prefetch(list.data());
    __builtin_prefetch(list.data() + list.size() / 2);
  }

  /// `list` is none of these lists.
  void set(std::int32_t v, Span<const std::int32_t> list, ListRoom &room) {
    if (list.size() > count_[std::size_t(v)]) begin_[std::size_t(v)] = room.take(list.size());
    std::copy(list.begin(), list.end(), begin_[std::size_t(v)]);
    count_[std::size_t(v)] = std::uint32_t(list.size());
  }
  void clear(std::int32_t v) { count_[std::size_t(v)] = 0; }

  /// What lists of so many entries in all take.
  static constexpr std::size_t bytes(std::size_t vertices, std::size_t entries) {
    return vertices * (sizeof(std::int32_t *) + sizeof(std::uint32_t)) + entries * sizeof(std::int32_t);
  }
  /// Of the lists that lie side by side.
  std::size_t room() const {
    std::size_t sum = 0;
    for (const Array<std::int32_t> &piece : pieces_) sum += piece.size();
    return sum;
  }

  /// Side by side again, a piece after the other, which takes little memory; what lists have taken of a room is given
  /// back by who cleared it.
  void compact(Job &job) {
    for_pieces(job, [&](Array<std::int32_t> &piece, std::size_t begin, std::size_t end) {
      Array<std::int32_t> items(entries(begin, end), &job.memory);
      std::int32_t *place = items.data();
      for (std::size_t v = begin; v < end; v++) {
        std::int32_t *const list = place;
        place = std::copy(begin_[v], begin_[v] + count_[v], place);
        begin_[v] = list;
      }
      piece = std::move(items);
    });
  }

 private:
  static constexpr std::size_t vertices_of_piece = 4096;

  /// visit(vertex, simplex) for every corner: of one vertex one after another, of several at the same time.
  template <std::size_t corners, class Visit>
  void for_corners(Span<const std::array<std::int32_t, corners>> simplices, Job &job, const Visit &visit) const {
    job.parallel.for_parts(count_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = 0; i < simplices.size(); i++) {
        job.poll_at(i, 0);
        if (simplices[i][0] < 0) continue;
        for (std::int32_t v : simplices[i])
          if (std::size_t(v) - begin < end - begin) visit(v, std::int32_t(i));
      }
    });
  }

  void give_room(Job &job) {
    pieces_.resize(count_.size() / vertices_of_piece + 1);
    for_pieces(job, [&](Array<std::int32_t> &piece, std::size_t begin, std::size_t end) {
      piece.resize(entries(begin, end));
      std::int32_t *place = piece.data();
      for (std::size_t v = begin; v < end; v++) {
        begin_[v] = place;
        place += count_[v];
      }
    });
  }

  /// visit(piece, begin, end of its vertices).
  template <class Visit>
  void for_pieces(Job &job, const Visit &visit) {
    job.parallel.for_blocks(count_.size(), vertices_of_piece, [&](std::size_t begin, std::size_t end) {
      visit(pieces_[begin / vertices_of_piece], begin, end);
      job.poll(0);
    });
  }

  std::size_t entries(std::size_t begin, std::size_t end) const {
    return std::accumulate(count_.data() + begin, count_.data() + end, std::size_t(0));
  }

  Array<std::int32_t *> begin_;
  Array<std::uint32_t> count_;
  Array<Array<std::int32_t>> pieces_;
};

}  // namespace tetlod
