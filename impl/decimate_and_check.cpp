#include "decimate_and_check.hpp"

#include "find_crossing.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

/// In one piece that touches itself nowhere, what crosses nothing in the end can have passed through nothing.
bool can_be_checked_afterwards(const SurfaceTopology &topology) {
  return topology.components == 1 && topology.nonmanifold_edges == 0 && topology.nonmanifold_points == 0;
}

}  // namespace

DecimateReport decimate_and_check(Surface &surface, const SurfaceTopology &topology, const DecimateOptions &options,
                                  std::int32_t index_base, Job &job, const Decimation &decimate) {
  // Hardly ever does a collapse make a crossing, and looking for one takes as long as all the rest.
  if (can_be_checked_afterwards(topology)) {
    Surface simplified(job.memory);
    simplified = surface;
    DecimateOptions careless = options;
    careless.careful = false;
    const DecimateReport report = decimate(simplified, careless);
    TreeOnDemand tree(simplified);
    if (find_crossing(simplified, tree, job).first < 0) {
      surface = std::move(simplified);
      return report;
    }
  }
  const DecimateReport report = decimate(surface, options);
  TreeOnDemand tree(surface);
  refuse_crossing(surface, tree, index_base, job);
  return report;
}

}  // namespace tetlod
