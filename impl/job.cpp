#include "job.hpp"

#include <algorithm>

#include "status.hpp"

namespace tetlod {

namespace {
constexpr std::chrono::milliseconds progress_interval{5};
}  // namespace

void Job::poll(double fraction) {
  if (cancel && cancel->load(std::memory_order_relaxed)) fail(Status::cancelled, "cancelled by tetlod_cancel");
  if (time_limit > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() >= time_limit)
    fail(Status::time_limit, "the time limit of %s seconds is used up", number(time_limit).c_str());
  if (std::this_thread::get_id() != owner_) {
    if (parallel.is_cancelled()) fail(Status::cancelled, "cancelled with the work that this is part of");
    return;
  }
  if (!progress) return;
  reached_ = std::max(reached_, std::clamp(fraction, 0.0, 1.0));
  if (Clock::now() - last_call_ < progress_interval) return;
  const bool ends = progress(stage_, reached_);
  last_call_ = Clock::now();  // or one that takes long would be called at every poll
  if (ends) fail(Status::cancelled, "cancelled by the progress callback");
}

}  // namespace tetlod
