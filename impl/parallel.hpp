// Parallel loops over blocks of fixed size: the same partial results in the same order for any number of threads.
#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

#include "crew.hpp"

namespace tetlod {

class Parallel {
 public:
  explicit Parallel(int threads = 1);

  int threads() const noexcept { return threads_; }
  Crew *crew() const noexcept { return crew_.get(); }  ///< null with one thread

  /// Whether what the calling thread does is of no use any more, because something that it is part of failed.
  bool is_cancelled() const;

  /// body(begin, end) for consecutive blocks of `block` indices that cover [0, count), begun in order. The blocks do
  /// not depend on the number of threads, so a sum per block, added up in block order, is deterministic.
  template <class Body>
  void for_blocks(std::size_t count, std::size_t block, const Body &body) const {
    const auto run = [&](std::size_t b) { body(b * block, std::min(count, (b + 1) * block)); };
    for_all((count + block - 1) / block,
            {&run, [](const void *it, std::size_t b) { (*static_cast<decltype(&run)>(it))(b); }});
  }

  /// All of these steps, of which none needs another.
  template <class... Steps>
  void at_once(const Steps &...steps) const {
    const std::function<void()> all[] = {std::cref(steps)...};
    for_blocks(sizeof...(steps), 1, [&](std::size_t i, std::size_t) { all[i](); });
  }

  /// body(begin, end) for a part of [0, count) for each thread: where each has to look at all of something, and
  /// what it does with an index does not depend on the part.
  template <class Body>
  void for_parts(std::size_t count, const Body &body) const {
    const std::size_t size = count / std::size_t(threads_) + 1;
    for_blocks(count, size, body);
  }

 private:
  struct EndCrew {
    void operator()(Crew *crew) const noexcept;
  };
  void for_all(std::size_t blocks, OfBlock run) const;

  int threads_;
  std::unique_ptr<Crew, EndCrew> crew_;
};

}  // namespace tetlod
