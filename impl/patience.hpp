// How long a call of the worker may take, and what its job is told meanwhile.
#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <utility>

#include "child_process.hpp"
#include "job.hpp"

namespace tetlod {

constexpr double idle_worth = 5;  ///< seconds of waiting that count as one of work

class Patience {
 public:
  /// seconds: of the worker's processor time, 0: no end. expected: a guess. progress: the fraction of the stage for
  /// that of the call; none: the same.
  Patience(double seconds, double expected, std::function<double(double)> progress)
      : seconds_(seconds), expected_(expected), progress_(std::move(progress)) {}

  /// Of the worker's own time, so that what a result is does not depend on who else is on the machine.
  bool is_over(const ChildProcess &worker, double cpu_before) const {
    if (seconds_ <= 0) return false;
    const double cpu = worker.cpu_seconds();
    if (cpu < 0) return !worker.has_ended() && elapsed() > seconds_;
    return std::max(cpu - cpu_before, elapsed() / idle_worth) > seconds_;
  }

  /// Nobody knows how far a call has got, so the fraction nears one without reaching it.
  void poll(Job &job) const {
    const double gone = elapsed();
    const double fraction = gone / (gone + expected_);
    job.poll(progress_ ? progress_(fraction) : fraction);
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Seconds of waiting. Where none of us has looked for long, both processes were stopped, not the worker slow.
  double elapsed() const {
    constexpr double longest = 1;
    const Clock::time_point now = Clock::now();
    elapsed_ += std::min(std::chrono::duration<double>(now - looked_).count(), longest);
    looked_ = now;
    return elapsed_;
  }
  mutable Clock::time_point looked_ = Clock::now();
  mutable double elapsed_ = 0;
  double seconds_, expected_;
  std::function<double(double)> progress_;
};

}  // namespace tetlod
