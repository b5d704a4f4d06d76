#include "dying_reader.hpp"

#include <unistd.h>

#include <cstddef>

#include "failure.hpp"

namespace cli {
namespace {

// All that a handler may touch. Its stack is one of its own, as the reader's may be what is full.
std::string last_words;
char stack[1 << 16];

void on_death(int) {
  [[maybe_unused]] const auto told = write(STDERR_FILENO, last_words.data(), last_words.size());
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
  for (std::size_t i = 0; i < kDeaths.size(); i++) sigaction(kDeaths[i], &action, &before_[i]);
}

DyingReader::~DyingReader() {
  for (std::size_t i = 0; i < kDeaths.size(); i++) sigaction(kDeaths[i], &before_[i], nullptr);
}

}  // namespace cli
