// 3.2  Decimation of the boundary, fast where nothing speaks against it: crossings are looked for afterwards.
#pragma once
#include <functional>

#include "decimate_boundary.hpp"

namespace tetlod {

/// Decimates a surface like decimate_boundary.
using Decimation = std::function<DecimateReport(Surface &surface, const DecimateOptions &options)>;

/// Decimates by `decimate`, careful as far as it has to be. `topology` is the surface's own. Throws
/// Status::mesh_intersecting where the result crosses itself because the original does; its vertices are numbered from
/// `index_base`.
DecimateReport decimate_and_check(Surface &surface, const SurfaceTopology &topology, const DecimateOptions &options,
                                  std::int32_t index_base, Job &job, const Decimation &decimate);

}  // namespace tetlod
