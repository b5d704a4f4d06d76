// The preset paper has no size to ask for: the parameters that come near one.
#pragma once

#include "run_tetlod.hpp"

namespace bench {

// sigma is the root of the part that is kept, so that interior and boundary thin out alike; rho is found by bisection,
// with at most eight runs. The result may be far off: samples too near the boundary are removed, however small rho.
Parameters paper_at(const Mesh &mesh, std::int64_t tets, std::int64_t threads);

}  // namespace bench
