#include "parallel.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <future>
#include <thread>
#include <vector>

#include "arena.hpp"

namespace tetlod {

namespace {

/// So many threads at the same time. Where oneTBB finds none for a worker while a worker asks, it ends the process.
void try_threads(int count) {
  std::promise<void> go;
  const std::shared_future<void> gone = go.get_future().share();
  std::vector<std::thread> threads;
  const auto end = [&] {
    go.set_value();
    for (std::thread &thread : threads) thread.join();
  };
  try {
    threads.reserve(std::size_t(count));
    for (int i = 0; i < count; i++)
      threads.emplace_back([gone] {
        ::operator delete(::operator new(1));  // each takes a part of the address space for what it allocates
        gone.wait();
      });
  } catch (...) {
    end();
    throw;
  }
  end();
}

}  // namespace

/// At once: an arena whose beginning has failed when it was first used waits for its end for ever.
Arena::Arena(int threads) : tasks(threads) {
  if (threads > 2) try_threads(threads - 1);  // of two, only the caller starts the other
  tasks.initialize();
}

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
