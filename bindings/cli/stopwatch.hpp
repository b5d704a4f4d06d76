// Wall-clock seconds.
#pragma once

#include <chrono>

namespace cli {

class Stopwatch {
 public:
  // Since the last call, or since the watch was made.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> seconds = now - begin_;
    begin_ = now;
    return seconds.count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace cli
