// What the worker prints becomes lines of the host's log.
#pragma once
#include <string>

#include "child_process.hpp"
#include "job.hpp"

namespace tetlod {

class WorkerOutput {
 public:
  /// Passes on what is there without waiting, and not more than a fixed amount, so that a worker that never stops
  /// printing does not keep the host from noticing a cancel.
  void drain(ChildProcess &child, const Job &job);
  /// A line without an end counts as one when the worker has ended.
  void flush(const Job &job);
  /// A new call may print its share of lines.
  void start_call() { lines_ = 0; }
  const std::string &last_line() const { return last_; }

 private:
  void add(char letter, const Job &job);

  std::string line_, last_;
  int lines_ = 0;
};

}  // namespace tetlod
