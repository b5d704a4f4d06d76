// 3.2  Decimation of the boundary by edge collapse: Lindstrom-Turk placement, shape cost, nothing broken.
#pragma once
#include <array>
#include <cstdint>

#include "collapse_log.hpp"
#include "job.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

struct DecimateOptions {
  double sigma = 0.1;        ///< edges kept, fraction of the surface's
  double lambda = 0.1;       ///< shape optimization weight
  double clean_edges = 0;    ///< edges shorter than this fraction of the diagonal are collapsed first
  double max_deviation = 0;  ///< distance between the boundaries, at all Samples of both; 0: no limit
  std::array<double, most_fields> field_weight{};  ///< length that a unit of each field counts as; 0, of the first:
                                                   ///< the paper's cost, which sees none
  bool careful = true;  ///< no collapse makes the surface cross itself; else that is for the caller to find out

  bool sees_fields() const { return field_weight[0] > 0; }
};

struct DecimateReport {
  std::int64_t edges_in = 0, edges_out = 0;  ///< of the cut surface
  std::int64_t cleaned_edges = 0;
};

/// `topology` is the surface's own. Collapses edges of `surface`, lowest cost first, until at most sigma of its edges
/// are left or no collapse is admissible, that is, breaks no rule and goes no further than max_deviation. Points with
/// locked[i] != 0 (empty: none), and points where the surface touches itself, stay. What is handed back is closed, of
/// the same topology, and crosses itself nowhere that the input did not. `log`, empty before, gets what was done.
DecimateReport decimate_boundary(Surface &surface, const SurfaceTopology &topology, Span<const std::uint8_t> locked,
                                 const DecimateOptions &options, Job &job, CollapseLog &log);
/// The same without a log.
inline DecimateReport decimate_boundary(Surface &surface, const SurfaceTopology &topology,
                                        Span<const std::uint8_t> locked, const DecimateOptions &options, Job &job) {
  CollapseLog log(job.memory);
  return decimate_boundary(surface, topology, locked, options, job, log);
}

}  // namespace tetlod
