// How the seconds grow with the size of the mesh.
#pragma once

#include "contest.hpp"

namespace bench {

struct Growth {
  std::vector<Contest> sizes;
  double tetlod_exponent, peer_exponent;  // p of least seconds ~ tets^p, by least squares; 0 for one size
};

// The same field on generated meshes of so many tets. rho is given for the first size and shrinks with the width of the
// cells, so that the samples stay about the same share of the vertices.
Growth measure_growth(const std::vector<std::int64_t> &tets, double time, const Parameters &first, int rounds);

}  // namespace bench
