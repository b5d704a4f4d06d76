// 3.5  Point location, against VTK's vtkStaticCellLocator.
#pragma once

#include "bench_mesh.hpp"
#include "duel.hpp"

namespace bench {

// The vertices of a result (preset fast at `target`) in the original, and those of the original in the result with the
// field there; making the search structures is included on both sides.
std::vector<Duel> hold_location_duels(const std::string &set, const Mesh &mesh, double target, std::int64_t threads,
                                      int rounds);

}  // namespace bench
