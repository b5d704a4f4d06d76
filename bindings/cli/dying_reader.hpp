// VTK's readers die of some damaged files.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace cli {

// While one lives, the tool says which file it was, and ends as for any other that cannot be read.
class DyingReader {
 public:
  explicit DyingReader(const std::string &path);
  ~DyingReader();
  DyingReader(const DyingReader &) = delete;
  DyingReader &operator=(const DyingReader &) = delete;

 private:
  static constexpr std::array<int, 5> kDeaths = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  struct sigaction before_[kDeaths.size()];
};

}  // namespace cli
