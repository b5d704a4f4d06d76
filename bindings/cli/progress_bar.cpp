#include "progress_bar.hpp"

#include <unistd.h>
#include <vtkAlgorithm.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "interrupt.hpp"

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

void ProgressBar::on_progress(vtkObject *object, unsigned long, void *) {
  auto *filter = vtkAlgorithm::SafeDownCast(object);
  const char *stage = filter->GetProgressText();
  show(stage != nullptr ? stage : "start", filter->GetProgress());
  if (interrupted()) filter->SetAbortExecute(1);
}

}  // namespace cli
