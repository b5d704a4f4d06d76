// One simplification by the peer: the edge collapse of VTK (vtkUnstructuredGridQuadricDecimation).
#pragma once

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "bench_mesh.hpp"
#include "stopwatch.hpp"

namespace bench {

struct PeerRun {
  Cost cost;  // of the filter alone
  Mesh result;
};

class Peer {
 public:
  // The mesh in VTK's own form is made once, and is nobody's time.
  explicit Peer(const Mesh &mesh);
  // Collapses until at most so many tets are left, or nothing more collapses.
  PeerRun run(std::int64_t tets) const;

 private:
  vtkSmartPointer<vtkUnstructuredGrid> grid_;
};

}  // namespace bench
