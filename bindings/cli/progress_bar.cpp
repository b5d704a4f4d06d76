#include "progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "interrupt.hpp"
#include "tetlod.h"

namespace cli {
namespace {

constexpr int kWidth = 40;

std::string bar_of(double fraction) {
  const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::string bar(kWidth, ' ');
  std::fill_n(bar.begin(), full, '#');
  return bar;
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) == 1) {}

void ProgressBar::show(const char *what, double fraction) {
  if (!on_) return;
  std::fprintf(stderr, "\r%-10s [%s] %3.0f %%", what, bar_of(fraction).c_str(), 100.0 * fraction);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

int32_t ProgressBar::on_progress(void *bar, int32_t stage, double fraction) {
  static_cast<ProgressBar *>(bar)->show(tetlod_stage_name(stage), fraction);
  return interrupted() ? 1 : 0;
}

}  // namespace cli
