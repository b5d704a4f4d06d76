#include "dying_reader.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>

#include "failure.hpp"

namespace cli {
namespace {

constexpr int kDeaths[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// All that a handler may touch. Its stack is one of its own, as the reader's may be what is full.
std::string last_words;
char stack[1 << 16];

void on_death(int) {
  if (write(STDERR_FILENO, last_words.data(), last_words.size()) >= 0) _exit(kFailed);
  _exit(kFailed);
}

}  // namespace

DyingReader::DyingReader(const std::string &path) {
  last_words = "tetlod: " + one_line(path) + ": is damaged: VTK's reader died of it\n";
  stack_t apart{};
  apart.ss_sp = stack;
  apart.ss_size = sizeof stack;
  sigaltstack(&apart, nullptr);
  struct sigaction action {};
  action.sa_handler = on_death;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
  for (const int signal : kDeaths) sigaction(signal, &action, nullptr);
}

DyingReader::~DyingReader() {
  for (const int signal : kDeaths) std::signal(signal, SIG_DFL);
}

}  // namespace cli
