#include "beside.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "arena.hpp"

namespace tetlod {

Beside::Beside(Job &job, std::function<void()> body) : job_(job), body_(std::move(body)) {
  over_.store(false, std::memory_order_release);
  taken_.store(false, std::memory_order_release);
  Arena *const arena = job_.parallel.arena();
  if (!arena) return;
  group_.emplace();
  arena->tasks.execute([this] { group_->run([this] { take(); }); });
}

Beside::~Beside() {
  if (!group_) return;
  group_->cancel();
  job_.parallel.arena()->tasks.execute([this] { group_->wait(); });
}

void Beside::finish() {
  constexpr std::chrono::microseconds soon{100};
  take();
  while (!over_.load(std::memory_order_acquire)) {
    job_.poll(0);
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
