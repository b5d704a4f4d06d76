// A mesh in a file that another program reads as it lies: "TETMESH1", counts of points and tets, points, values, tets.
#pragma once

#include <string>

#include "bench_mesh.hpp"

namespace bench {

// A temporary file, removed with its scope. `name` tells those of one process apart. Throws std::runtime_error when it
// cannot be written.
class MeshOnDisk {
 public:
  MeshOnDisk(const Mesh &mesh, const std::string &name);
  ~MeshOnDisk();
  MeshOnDisk(const MeshOnDisk &) = delete;
  MeshOnDisk &operator=(const MeshOnDisk &) = delete;
  const std::string &path() const { return path_; }

 private:
  std::string path_;
};

// Throws std::runtime_error when it is not such a file.
Mesh read_mesh_file(const std::string &path);

}  // namespace bench
