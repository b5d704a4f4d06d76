#include "beside.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "status.hpp"

namespace tetlod {

Beside::Beside(Job &job, std::function<void()> body) : job_(job), body_(std::move(body)) {
  if (!job_.parallel.crew()) return;
  loop_.emplace(
      1, OfBlock{this, [](const void *it, std::size_t) { static_cast<Beside *>(const_cast<void *>(it))->take(); }});
  job_.parallel.crew()->open(*loop_, 1);
}

Beside::~Beside() {
  if (!loop_) return;
  loop_->cancel();
  try {
    job_.parallel.crew()->close(*loop_);
  } catch (const Error &) {  // where nobody is at it any more
  }
}

void Beside::finish() {
  constexpr std::chrono::microseconds soon{100};
  take();
  while (!over_.load(std::memory_order_acquire)) {
    job_.poll(0);
    job_.parallel.crew()->require_here();
    std::this_thread::sleep_for(soon);
  }
  if (failure_) std::rethrow_exception(failure_);
}

void Beside::take() {
  if (taken_.exchange(true, std::memory_order_acq_rel)) return;
  try {
    body_();
  } catch (...) {
    failure_ = std::current_exception();
  }
  over_.store(true, std::memory_order_release);
}

}  // namespace tetlod
