// 3.4  The simplified boundary and the samples become a tetrahedral mesh that keeps both.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "worker.hpp"

namespace tetlod {

struct RemeshReport {
  std::int64_t steiner_points = 0;
  std::int64_t dropped_samples = 0;     ///< samples that the accepted attempt went without
  std::int32_t attempts = 0;            ///< calls of TetGen, 1 when the first was accepted; of the part that took most
  std::uint64_t worker_peak_bytes = 0;  ///< of all processes together, if each had its peak at the same time
};

struct RemeshResult {
  explicit RemeshResult(Memory &memory) : points(&memory), tets(&memory), origin(&memory) {}
  Array<Vec3> points;          ///< the surface's, bitwise and in order; samples that a tet uses; Steiner points
  Array<Tet> tets;             ///< every one positive
  Array<std::int32_t> origin;  ///< of each point: i < surface points: the surface's i; then surface points + sample
                               ///< index; -1: a Steiner point
  RemeshReport report;
};

/// A call of TetGen costs as much as some hundred points: small solids go together. It is the same for any number of
/// threads, as are the results.
constexpr std::size_t usual_points_at_once = 2048;

/// Where there is another way, one attempt of a second says whether remeshing is one: all of them may take minutes.
enum class Ladder { whole, first_rung };

/// Solids are remeshed each for itself, as many at once as the job has threads; small ones together, up to
/// `points_at_once` points and samples. Throws Status::remesh when every attempt of the ladder failed for one of them
/// (the message has what each said), and what Worker::begin() throws. The surface must be closed and oriented;
/// it may touch itself at vertices and edges. meanwhile(), if there is one, is called once, when processes have begun.
void remesh(const Surface &surface, Span<const Vec3> samples, Worker &worker, Job &job, RemeshResult &result,
            std::size_t points_at_once = usual_points_at_once, const std::function<void()> &meanwhile = {},
            Ladder ladder = Ladder::whole);

}  // namespace tetlod
