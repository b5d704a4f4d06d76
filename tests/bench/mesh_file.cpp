#include "mesh_file.hpp"

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace bench {
namespace {

namespace fs = std::filesystem;

constexpr char kMagic[] = {'T', 'E', 'T', 'M', 'E', 'S', 'H', '1'};

template <class T>
void write(std::ofstream &file, const T *items, std::size_t count) {
  file.write(reinterpret_cast<const char *>(items), std::streamsize(count * sizeof(T)));
}

template <class T>
void read(std::ifstream &file, T *items, std::size_t count) {
  file.read(reinterpret_cast<char *>(items), std::streamsize(count * sizeof(T)));
}

}  // namespace

MeshOnDisk::MeshOnDisk(const Mesh &mesh, const std::string &name)
    : path_((fs::temp_directory_path() / ("tetlod_bench_" + std::to_string(getpid()) + name)).string()) {
  std::ofstream file(path_, std::ios::binary);
  const std::int64_t counts[2] = {std::int64_t(mesh.points.size()), std::int64_t(mesh.tets.size())};
  write(file, kMagic, sizeof kMagic);
  write(file, counts, 2);
  write(file, mesh.points.data(), mesh.points.size());
  write(file, mesh.values.data(), mesh.values.size());
  write(file, mesh.tets.data(), mesh.tets.size());
  file.close();
  if (!file) throw std::runtime_error(path_ + ": cannot be written");
}

MeshOnDisk::~MeshOnDisk() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

Mesh read_mesh_file(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  char magic[sizeof kMagic] = {};
  std::int64_t counts[2] = {};
  read(file, magic, sizeof magic);
  read(file, counts, 2);
  if (!file || std::memcmp(magic, kMagic, sizeof magic) != 0) throw std::runtime_error(path + ": no mesh");
  Mesh mesh;
  mesh.points.resize(std::size_t(counts[0]));
  mesh.values.resize(mesh.points.size());
  mesh.tets.resize(std::size_t(counts[1]));
  read(file, mesh.points.data(), mesh.points.size());
  read(file, mesh.values.data(), mesh.values.size());
  read(file, mesh.tets.data(), mesh.tets.size());
  if (!file) throw std::runtime_error(path + ": it ends too soon");
  return mesh;
}

}  // namespace bench
