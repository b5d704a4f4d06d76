// The hardware's floor for whatever looks at the faces of a mesh: one pass that reads the tets and writes each of their
// faces.
#pragma once

#include <vector>

#include "bench_mesh.hpp"
#include "stopwatch.hpp"

namespace bench {

class FacePass {
 public:
  // The faces go into memory that was touched before. threads 0: one a core.
  FacePass(const std::vector<Tet> &tets, std::int64_t threads);
  Cost run();

 private:
  void part(std::size_t i);

  const std::vector<Tet> &tets_;
  std::size_t threads_;
  std::vector<Triangle> faces_;
};

}  // namespace bench
