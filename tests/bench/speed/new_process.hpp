// A contestant in a process of its own, where the system has yet to hand out the memory that it takes, as in most
// programs.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <type_traits>

namespace bench {

// What run() returns there. This process must have started no threads, which its copy would miss. Throws
// std::runtime_error where run() does, having printed why.
template <class Run>
auto in_new_process(const Run &run) {
  using Outcome = decltype(run());
  static_assert(std::is_trivially_copyable_v<Outcome>, "it comes through a pipe");
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no new process");
  if (child == 0) {
    try {
      const Outcome outcome = run();
      _exit(write(ends[1], &outcome, sizeof outcome) == ssize_t(sizeof outcome) ? 0 : 1);
    } catch (const std::exception &error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
  }
  close(ends[1]);
  Outcome outcome{};
  const bool is_whole = read(ends[0], &outcome, sizeof outcome) == ssize_t(sizeof outcome);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!is_whole || status != 0) throw std::runtime_error("a contestant failed in its process");
  return outcome;
}

}  // namespace bench
