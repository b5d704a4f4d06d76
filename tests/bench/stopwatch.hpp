// What something costs: seconds of the wall clock, and of the processors.
#pragma once

#include <sys/resource.h>

#include <chrono>

namespace bench {

// On a machine where other programs run, seconds of the processors (user and system, of this process and of those it
// started and waited for) are what can be compared; wall seconds say how long somebody waited.
struct Cost {
  double wall = 0, cpu = 0;
};

inline double cpu_seconds_of(int who) {
  const auto seconds = [](const timeval &t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  rusage usage{};
  getrusage(who, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Stopwatch {
 public:
  Cost cost() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(), cpu_now() - cpu_begin_};
  }

 private:
  static double cpu_now() { return cpu_seconds_of(RUSAGE_SELF) + cpu_seconds_of(RUSAGE_CHILDREN); }

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = cpu_now();
};

}  // namespace bench
