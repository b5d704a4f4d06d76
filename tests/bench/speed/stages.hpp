// The library's stages, called one at a time.
#pragma once

#include "bench_mesh.hpp"
#include "job.hpp"
#include "mesh.hpp"

namespace bench {

// What a stage needs.
struct Stages {
  explicit Stages(std::int64_t threads) : parallel(int(threads)), job(memory, parallel) {}
  tetlod::Memory memory;
  tetlod::Parallel parallel;
  tetlod::Job job;
};

// The mesh as the stages read it, in place: both sides have three doubles a point.
inline tetlod::MeshView view_of(const Mesh &mesh) {
  static_assert(sizeof(Point) == sizeof(tetlod::Vec3) && alignof(Point) == alignof(tetlod::Vec3));
  return {{reinterpret_cast<const tetlod::Vec3 *>(mesh.points.data()), mesh.points.size()},
          {mesh.values.data(), mesh.values.size()},
          {mesh.tets.data(), mesh.tets.size()}};
}

}  // namespace bench
