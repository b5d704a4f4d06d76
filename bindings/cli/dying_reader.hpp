// VTK's readers die of some damaged files.
#pragma once

#include <string>

namespace cli {

// While one lives, the tool says which file it was, and ends as for any other that cannot be read.
class DyingReader {
 public:
  explicit DyingReader(const std::string &path);
  ~DyingReader();
  DyingReader(const DyingReader &) = delete;
  DyingReader &operator=(const DyingReader &) = delete;
};

}  // namespace cli
