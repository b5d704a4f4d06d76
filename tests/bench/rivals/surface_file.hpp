// What the programs beside this file read, and what they print.
//
// Each links one library and nothing of the project, because of the licences: GTS is LGPL, parts of CGAL are GPL,
// TetGen is AGPL. They are made for ./dev bench alone and are not installed.
#pragma once

#include <sys/resource.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace rivals {

// A closed surface, outward triangles, and further points inside it.
struct SurfaceFile {
  std::vector<std::array<double, 3>> points;  // of the surface first
  std::vector<std::array<std::int32_t, 3>> triangles;
};

// The file: two int64 counts, coordinates in float64, corners in int32. Ends the process when it cannot be read.
inline SurfaceFile read_surface(const char *path) {
  SurfaceFile surface;
  std::int64_t counts[2] = {0, 0};
  std::FILE *const file = std::fopen(path, "rb");
  bool sound = file != nullptr && std::fread(counts, sizeof counts, 1, file) == 1;
  if (sound) {
    surface.points.resize(std::size_t(counts[0]));
    surface.triangles.resize(std::size_t(counts[1]));
    sound = std::fread(surface.points.data(), 24, surface.points.size(), file) == surface.points.size() &&
            std::fread(surface.triangles.data(), 12, surface.triangles.size(), file) == surface.triangles.size();
  }
  if (file != nullptr) std::fclose(file);
  if (!sound) {
    std::fprintf(stderr, "%s: cannot be read\n", path);
    std::exit(EXIT_FAILURE);
  }
  return surface;
}

// Seconds of the wall clock and of the processor since it was made.
class Watch {
 public:
  // One line: wall seconds, CPU seconds, and how many edges or tets are left.
  void print(std::int64_t left) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin_;
    std::printf("%.9f %.9f %lld\n", wall.count(), cpu() - cpu_begin_, static_cast<long long>(left));
  }

 private:
  static double cpu() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  }

  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = cpu();
};

}  // namespace rivals
