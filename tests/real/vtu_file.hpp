// The data sets: VTK XML files of tets whose arrays are appended raw, each in blocks that zlib compressed.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace real_test {

using Point = std::array<double, 3>;
using Tet = std::array<std::int32_t, 4>;

struct TetFile {
  std::vector<Point> points;
  std::vector<double> scalars;
  std::vector<Tet> tets;
};

/// Throws std::runtime_error for anything but such a file.
TetFile read_vtu(const std::string &path);

}  // namespace real_test
