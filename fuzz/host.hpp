// The host's side: an allocator that counts, fails and interrupts on demand, and what of the process is the host's.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "tetlod.h"

namespace fuzz {

/// Hooks for tetlod_config. Each block remembers what it was asked as, to be compared when it is released.
class Allocator {
 public:
  void install(tetlod_config &config);

  /// The allocation after `count` others fails, and so do the `more` next ones; negative: none.
  void fail_after(long count, long more = 0) { left_ = count, more_ = more, failed_ = false; }
  bool failed() const { return failed_; }
  /// Calls back, once, in the allocation after `count` others.
  void call_after(long count, std::function<void()> call);
  void forget();

  std::size_t in_use() const { return in_use_; }

 private:
  void *allocate(std::size_t bytes, std::size_t alignment);
  void release(void *pointer, std::size_t bytes, std::size_t alignment);

  std::atomic<long> left_{-1}, more_{0}, until_call_{-1};
  std::function<void()> call_;
  std::atomic<bool> failed_{false};
  std::atomic<std::size_t> in_use_{0};
};

/// Descriptors that are open; children, also zombies, that nobody has waited for.
int open_files();
bool has_children();

/// Once, before the first input: no core files of TetGen's crashes.
void settle();

/// Writes the input to the folder that the environment's TETLOD_FUZZ_KEEP names, if it does: what is no defect of the
/// library, but worth a look (TetGen failed in every way).
void keep(const char *why, const std::uint8_t *data, std::size_t size);

}  // namespace fuzz
