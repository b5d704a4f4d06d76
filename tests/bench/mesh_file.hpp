// A mesh in a file that another process reads as it lies: counts of points and tets, points, values, tets.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bench_mesh.hpp"

namespace bench {

// Removed with its scope. Throws std::runtime_error when it cannot be written.
class MeshOnDisk {
 public:
  explicit MeshOnDisk(const Mesh &mesh)
      : path_((std::filesystem::temp_directory_path() / ("tetlod_bench_" + std::to_string(getpid()) + ".mesh"))
                  .string()) {
    std::ofstream file(path_, std::ios::binary);
    const std::int64_t counts[2] = {std::int64_t(mesh.points.size()), std::int64_t(mesh.tets.size())};
    file.write(reinterpret_cast<const char *>(counts), sizeof counts);
    write(mesh.points, file);
    write(mesh.values, file);
    write(mesh.tets, file);
    file.close();
    if (!file) throw std::runtime_error(path_ + ": cannot be written");
  }
  ~MeshOnDisk() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  MeshOnDisk(const MeshOnDisk &) = delete;
  MeshOnDisk &operator=(const MeshOnDisk &) = delete;
  const std::string &path() const { return path_; }

 private:
  template <class T>
  static void write(const std::vector<T> &items, std::ofstream &file) {
    file.write(reinterpret_cast<const char *>(items.data()), std::streamsize(items.size() * sizeof(T)));
  }

  std::string path_;
};

// Throws std::runtime_error when it is not such a file.
inline Mesh read_mesh_file(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::int64_t counts[2] = {};
  const auto read = [&](auto *items, std::size_t count) {
    file.read(reinterpret_cast<char *>(items), std::streamsize(count * sizeof *items));
    if (!file) throw std::runtime_error(path + ": no mesh");
  };
  read(counts, 2);
  Mesh mesh;
  mesh.points.resize(std::size_t(counts[0]));
  mesh.values.resize(std::size_t(counts[0]));
  mesh.tets.resize(std::size_t(counts[1]));
  read(mesh.points.data(), mesh.points.size());
  read(mesh.values.data(), mesh.values.size());
  read(mesh.tets.data(), mesh.tets.size());
  return mesh;
}

}  // namespace bench
