#include "parallel.hpp"

#include <tbb/parallel_for.h>

#include <atomic>

#include "arena.hpp"

namespace tetlod {

Parallel::Parallel(int threads) : threads_(threads) {
  if (threads > 1) arena_ = std::make_unique<Arena>(threads);
}

Parallel::~Parallel() = default;
Parallel::Parallel(Parallel &&) noexcept = default;
Parallel &Parallel::operator=(Parallel &&) noexcept = default;

bool Parallel::is_cancelled() const { return arena_ && tbb::is_current_task_group_canceling(); }

void Parallel::for_all(std::size_t blocks, OfBlock run) const {
  if (!arena_ || blocks < 2) {
    for (std::size_t b = 0; b < blocks; b++) run.call(run.body, b);
    return;
  }
  // oneTBB's fork and join order everything; these say so in terms that a race detector sees, too.
  std::atomic<std::size_t> next, done{0};
  next.store(0, std::memory_order_release);
  arena_->tasks.execute([&] {
    tbb::parallel_for(0, threads_, [&](int) {
      for (std::size_t b; (b = next.fetch_add(1, std::memory_order_acq_rel)) < blocks;) {
        if (is_cancelled()) break;
        run.call(run.body, b);
      }
      done.fetch_add(1, std::memory_order_release);
    });
  });
  static_cast<void>(done.load(std::memory_order_acquire));
}

}  // namespace tetlod
