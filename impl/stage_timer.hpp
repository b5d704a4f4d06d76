// How long each stage takes.
#pragma once
#include <chrono>

#include "pipeline.hpp"

namespace tetlod {

/// The seconds of a stage are those that a StageTimer of it lives.
class StageTimer {
 public:
  StageTimer(Stage stage, Job &job, Report &report) : seconds_(report.seconds[std::size_t(stage)]) { job.enter(stage); }
  ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  StageTimer(const StageTimer &) = delete;
  StageTimer &operator=(const StageTimer &) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double &seconds_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace tetlod
