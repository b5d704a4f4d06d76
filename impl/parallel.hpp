// Parallel loops over blocks of fixed size: the same partial results in the same order for any number of threads.
#pragma once
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>

namespace tetlod {

/// One arena per context; with one thread nothing of oneTBB is touched.
class Parallel {
 public:
  explicit Parallel(int threads = 1) : threads_(threads) {
    if (threads > 1) arena_ = std::make_unique<tbb::task_arena>(threads);
  }
  int threads() const noexcept { return threads_; }
  tbb::task_arena *arena() const noexcept { return arena_.get(); }  ///< null with one thread

  /// Whether what the calling thread does is of no use any more, because something that it is part of failed.
  bool is_cancelled() const { return arena_ && tbb::is_current_task_group_canceling(); }

  /// body(begin, end) for consecutive blocks of `block` indices that cover [0, count), begun in order. The blocks do
  /// not depend on the number of threads, so a sum per block, added up in block order, is deterministic.
  template <class Body>
  void for_blocks(std::size_t count, std::size_t block, const Body &body) const {
    const std::size_t blocks = (count + block - 1) / block;
    const auto run = [&](std::size_t b) { body(b * block, std::min(count, (b + 1) * block)); };
    if (!arena_ || blocks < 2) {
      for (std::size_t b = 0; b < blocks; b++) run(b);
      return;
    }
    // oneTBB's fork and join order everything; these say so in terms that a race detector sees, too.
    std::atomic<std::size_t> next, done{0};
    next.store(0, std::memory_order_release);
    arena_->execute([&] {
      tbb::parallel_for(0, threads_, [&](int) {
        for (std::size_t b; (b = next.fetch_add(1, std::memory_order_acq_rel)) < blocks;) {
          if (is_cancelled()) break;
          run(b);
        }
        done.fetch_add(1, std::memory_order_release);
      });
    });
    static_cast<void>(done.load(std::memory_order_acquire));
  }

  /// All of these steps, of which none needs another.
  template <class... Steps>
  void at_once(const Steps &...steps) const {
    const std::function<void()> all[] = {std::cref(steps)...};
    for_blocks(sizeof...(steps), 1, [&](std::size_t i, std::size_t) { all[i](); });
  }

  /// body(part, begin, end) for a part of [0, count) for each thread: where each has to look at all of something, and
  /// what it does with an index does not depend on the part.
  template <class Body>
  void for_parts(std::size_t count, const Body &body) const {
    const std::size_t size = count / std::size_t(threads_) + 1;
    for_blocks(count, size, [&](std::size_t begin, std::size_t end) { body(begin / size, begin, end); });
  }

 private:
  int threads_;
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace tetlod
