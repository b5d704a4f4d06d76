// What another thread does beside what this one goes on with.
#pragma once
#include <atomic>
#include <exception>
#include <functional>
#include <optional>

#include "crew.hpp"
#include "job.hpp"

namespace tetlod {

/// Hands `body`, which depends on nothing that happens until finish(), to another thread of the job's, if it has one.
class Beside {
 public:
  Beside(Job &job, std::function<void()> body);
  /// Without finish() the body ends where it polls the job next, and what it throws is lost.
  ~Beside();
  Beside(const Beside &) = delete;
  Beside &operator=(const Beside &) = delete;

  /// Waits until the body is done; does it where no other thread has begun. Throws what it throws.
  void finish();

 private:
  void take();

  Job &job_;
  std::function<void()> body_;
  std::optional<Loop> loop_;  // of one block, if there are helpers
  std::atomic<bool> taken_{false}, over_{false};
  std::exception_ptr failure_;
};

}  // namespace tetlod
