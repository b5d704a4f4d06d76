// The k-d trees, against nanoflann.
#pragma once

#include "bench_mesh.hpp"
#include "duel.hpp"

namespace bench {

// The tree of boxes over the mesh's vertices: building it, and the nearest vertex of points inside tets, where the
// answers are compared; and the sampling tree [3.1] with rho 1 % against building a tree over the interior vertices.
std::vector<Duel> hold_kd_tree_duels(const std::string &set, const Mesh &mesh, int rounds);

}  // namespace bench
