// 3.2  The boundary: its extraction against one pass over the faces, its decimation with the paper's cost against GTS
// and CGAL.
#pragma once

#include "bench_mesh.hpp"
#include "duel.hpp"

namespace bench {

// Decimation to this part of the edges: ours includes finding the topology; making the rivals' surfaces is nobody's
// time, and all have one thread. Extraction has `threads`.
std::vector<Duel> hold_boundary_duels(const std::string &set, const Mesh &mesh, double sigma, std::int64_t threads,
                                      int rounds);

}  // namespace bench
