// A line on stderr that says how far the run is; nothing where stderr is not a terminal.
#pragma once

#include <cstdint>

namespace cli {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar &) = delete;
  ProgressBar &operator=(const ProgressBar &) = delete;

  void show(const char *what, double fraction);
  void clear();
  // A tetlod_progress_fn; `bar` is a ProgressBar. Cancels after an interruption.
  static int32_t on_progress(void *bar, int32_t stage, double fraction);

 private:
  bool on_;
  bool drawn_ = false;
};

}  // namespace cli
