// 3.2  Decimation of the boundary, fast where nothing speaks against it: crossings are looked for afterwards.
#pragma once
#include "decimate_boundary.hpp"

namespace tetlod {

/// As decimate_boundary; careful as far as it has to be. Throws Status::mesh_intersecting where the result crosses
/// itself because the original does; its vertices are numbered from `index_base`.
DecimateReport decimate_and_check(Surface &surface, const SurfaceTopology &topology, Span<const std::uint8_t> locked,
                                  const DecimateOptions &options, std::int32_t index_base, Job &job);

}  // namespace tetlod
