// A rival that is a program of its own.
#pragma once

#include <string>
#include <vector>

#include "bench_mesh.hpp"
#include "duel.hpp"

namespace bench {

// A surface, and points inside it after its own, in the file that the programs in tests/bench/rivals read. Removed with
// its scope.
class SurfaceOnDisk {
 public:
  SurfaceOnDisk(const Point *points, std::size_t point_count, const Triangle *triangles, std::size_t triangle_count);
  ~SurfaceOnDisk();
  SurfaceOnDisk(const SurfaceOnDisk &) = delete;
  SurfaceOnDisk &operator=(const SurfaceOnDisk &) = delete;
  const std::string &path() const { return path_; }

 private:
  std::string path_;
};

// Runs `program` of the build's folder with these arguments and reads the seconds that it prints, which leave reading
// the file out. Throws NoRival with `package` when it was not built.
Cost run_rival(const std::string &program, const std::string &arguments, const std::string &package);

}  // namespace bench
