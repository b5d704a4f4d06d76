#include "worker_output.hpp"

#include <unistd.h>

#include <cerrno>

namespace tetlod {

namespace {

constexpr int log_level = 0;             // debug
constexpr int turns = 16;                // reads of one drain
constexpr std::size_t line_limit = 500;  // characters; what is longer goes on in the next line
constexpr int lines_of_a_call = 200;     // what is more is dropped

}  // namespace

void WorkerOutput::drain(ChildProcess &child, const Job &job) {
  char buffer[4096];
  for (int turn = 0; turn < turns && child.output() >= 0; turn++) {
    const ssize_t size = ::read(child.output(), buffer, sizeof buffer);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return child.close_output();
    for (ssize_t i = 0; i < size; i++) add(buffer[i], job);
  }
}

void WorkerOutput::add(char letter, const Job &job) {
  if (letter == '\n' || line_.size() == line_limit) flush(job);
  if (letter != '\n' && letter != '\0') line_ += letter;
}

void WorkerOutput::flush(const Job &job) {
  if (line_.empty()) return;
  last_ = "tetlod-remesh: " + line_;
  line_.clear();
  lines_++;
  if (!job.log || lines_ > lines_of_a_call) return;
  job.log(log_level, last_.c_str());
  if (lines_ == lines_of_a_call) job.log(log_level, "tetlod-remesh: prints more, which is left out");
}

}  // namespace tetlod
