// 3.4  The simplified boundary and the samples become a tetrahedral mesh that keeps both.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "worker.hpp"

namespace tetlod {

struct RemeshReport {
  std::int64_t steiner_points = 0;
  std::int64_t dropped_samples = 0;  ///< samples that the accepted attempt went without
  std::int32_t attempts = 0;         ///< calls of TetGen, 1 when the first was accepted
  std::uint64_t worker_peak_bytes = 0;
};

struct RemeshResult {
  explicit RemeshResult(Memory &memory) : points(&memory), tets(&memory), origin(&memory) {}
  Array<Vec3> points;          ///< the surface's, bitwise and in order; samples that a tet uses; Steiner points
  Array<Tet> tets;             ///< every one positive
  Array<std::int32_t> origin;  ///< of each point: i < surface points: the surface's i; then surface points + sample
                               ///< index; -1: a Steiner point
  RemeshReport report;
};

/// Throws Status::remesh when every attempt of the ladder failed (the message has what each said), and what
/// Worker::tetrahedralize throws. The surface must be closed and oriented; it may touch itself at vertices and edges.
void remesh(const Surface &surface, Span<const Vec3> samples, Worker &worker, Job &job, RemeshResult &result);

}  // namespace tetlod
