// The run, stage by stage, in the paper's order [3.6].
#pragma once
#include <array>
#include <cstdint>

#include "decimate_boundary.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "remesh.hpp"
#include "strided.hpp"
#include "worker.hpp"

namespace tetlod {

/// What happens to a defect of the input that can be repaired. The numbers are those of the C ABI.
enum class Policy : std::int64_t { error = 0, repair = 1 };

struct Options {
  double rho = 0.01;
  double sigma = 0.1;
  double lambda = 0.1;
  double min_distance = 0.01;
  double merge_tolerance = 0;
  double clean_edges = 0;
  std::int64_t boundary_leaf = 200;
  std::int64_t tet_leaf = 500;
  std::int64_t threads = 1;
  std::int64_t seed = 1;
  double time_limit = 0;
  Policy on_coincident = Policy::repair;  ///< merge the points
  Policy on_repeated = Policy::repair;    ///< drop the tets
  Policy on_flat = Policy::repair;        ///< peel the tets off the boundary, keep them inside
  Policy on_inverted = Policy::repair;    ///< take the tets the other way round
  Policy on_duplicate = Policy::repair;   ///< drop the later tets
  Policy on_overlap = Policy::repair;     ///< keep the tets: inside they do no harm
  Policy on_unused = Policy::repair;      ///< ignore the points
  Policy on_nonfinite = Policy::error;    ///< repair: ignore points without a finite value together with their tets
};

/// The caller's arrays: shapes, types and strides are sound, contents are not looked at yet.
struct Input {
  std::array<StridedArray, 3> xyz;  ///< one component each
  StridedArray tets;                ///< four components
  std::int32_t index_base = 0;
  StridedArray scalars;  ///< one component
};

/// The rows of the paper's Table 2. Seconds by Stage.
struct Report {
  std::int64_t points_in = 0, tets_in = 0;
  std::int64_t merged_points = 0, nonfinite_points = 0, dropped_tets = 0, unused_points = 0;
  std::int64_t interior_points_in = 0;
  std::int64_t boundary_points_in = 0, boundary_edges_in = 0, boundary_triangles_in = 0;
  std::int64_t components = 0, nonmanifold_edges = 0, nonmanifold_points = 0;
  std::int64_t cleaned_edges = 0;
  std::int64_t boundary_points_out = 0, boundary_edges_out = 0, boundary_triangles_out = 0;
  std::int64_t selected_samples = 0, samples_outside = 0, samples_too_near = 0, samples = 0;
  std::int64_t steiner_points = 0, points_out = 0, tets_out = 0;
  std::int64_t remesh_attempts = 0, boundary_retries = 0;
  std::array<double, std::size_t(Stage::count)> seconds{};
  double seconds_total = 0;
  std::uint64_t peak_bytes = 0, worker_peak_bytes = 0, hash = 0;
  double scalar_min = 0, scalar_max = 0;
};

struct Result {
  explicit Result(Memory &memory) : mesh(memory) {}
  TetMesh mesh;
  Report report;
};

/// Simplifies; throws Error. `result` is meant to be a fresh one: after a throw its contents mean nothing.
void run(const Input &input, const Options &options, Worker &worker, Job &job, Result &result);

}  // namespace tetlod
