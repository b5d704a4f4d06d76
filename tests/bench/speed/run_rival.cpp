#include "run_rival.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace bench {

namespace fs = std::filesystem;

SurfaceOnDisk::SurfaceOnDisk(const Point *points, std::size_t point_count, const Triangle *triangles,
                             std::size_t triangle_count)
    : path_((fs::temp_directory_path() / ("tetlod_bench_" + std::to_string(getpid()) + ".surface")).string()) {
  std::ofstream file(path_, std::ios::binary);
  const std::int64_t counts[2] = {std::int64_t(point_count), std::int64_t(triangle_count)};
  file.write(reinterpret_cast<const char *>(counts), sizeof counts);
  file.write(reinterpret_cast<const char *>(points), std::streamsize(point_count * sizeof *points));
  file.write(reinterpret_cast<const char *>(triangles), std::streamsize(triangle_count * sizeof *triangles));
  file.close();
  if (!file) throw std::runtime_error(path_ + ": cannot be written");
}

SurfaceOnDisk::~SurfaceOnDisk() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

Cost run_rival(const std::string &program, const std::string &arguments, const std::string &package) {
  const std::string path = std::string(TETLOD_BENCH_FOLDER) + "/" + program;
  if (!fs::exists(path)) throw NoRival(program + " is not built, it needs " + package);
  std::FILE *const pipe = popen(("'" + path + "' " + arguments).c_str(), "r");
  if (pipe == nullptr) throw NoRival(program + " cannot be started");
  Cost cost;
  const int read = std::fscanf(pipe, "%lf %lf", &cost.wall, &cost.cpu);
  if (pclose(pipe) != 0 || read != 2) throw NoRival(program + " failed");
  return cost;
}

}  // namespace bench
