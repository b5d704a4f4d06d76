// What a stage needs from the run that it is part of: memory, threads, and somebody who may say stop.
#pragma once
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>

#include "memory.hpp"
#include "parallel.hpp"

namespace tetlod {

/// The stages in the paper's order; the numbers are those of the C ABI.
enum class Stage : std::int32_t { prepare = 0, boundary, decimate, sample, cull, remesh, values, count };

class Job {
 public:
  /// Called on the thread that made the job, at most every few milliseconds; true cancels.
  using Progress = std::function<bool(Stage, double fraction)>;
  /// level: 0 debug, 1 info, 2 warning.
  using Log = std::function<void(int level, const char *message)>;

  Job(Memory &memory, const Parallel &parallel) : memory(memory), parallel(parallel) {}

  Memory &memory;
  const Parallel &parallel;
  Progress progress;
  Log log;
  const std::atomic<bool> *cancel = nullptr;  ///< set by tetlod_cancel from another thread
  double time_limit = 0;                      ///< seconds for the whole run, 0: none
  bool makes_do = false;  ///< where memory is short nothing is kept of earlier runs that could go first

  void enter(Stage stage) {
    if (stage != stage_) reached_ = 0;
    stage_ = stage;
    last_call_ = {};
    poll(0);
  }

  /// Call it at least every few milliseconds of work, from any thread. Throws Status::cancelled or
  /// Status::time_limit. `fraction` of the stage that is done, in [0, 1]; the host is not told less than before.
  void poll(double fraction);

  /// In loops over many items that are soon done, with the number of each: polls once in a while.
  void poll_at(std::size_t item, double fraction) {
    if (item % 65536 == 0) poll(fraction);
  }

 private:
  using Clock = std::chrono::steady_clock;
  Stage stage_ = Stage::prepare;
  double reached_ = 0;
  std::thread::id owner_ = std::this_thread::get_id();
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_call_{};
};

/// less, for std::sort of many, that polls as it goes.
template <class Less>
class PollingLess {
 public:
  PollingLess(Job &job, double fraction, Less less) : job_(&job), fraction_(fraction), less_(less) {}
  template <class T>
  bool operator()(const T &a, const T &b) {
    if (++calls_ % (1 << 15) == 0) job_->poll(fraction_);
    return less_(a, b);
  }

 private:
  Job *job_;
  double fraction_;
  Less less_;
  std::uint32_t calls_ = 0;
};

}  // namespace tetlod
