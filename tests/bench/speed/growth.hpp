// How the seconds and bytes grow with the size of the mesh.
#pragma once

#include "contest.hpp"

namespace bench {

struct Growth {
  std::vector<Contest> sizes;
  // p of least CPU seconds ~ tets^p, by least squares; 0 for fewer than two sizes.
  double tetlod_exponent, peer_exponent;
};

struct GrowthOptions {
  std::vector<std::int64_t> tets{100000, 300000, 1000000, 3000000, 10000000};
  double time = 0.5;                  // where the front stands
  std::int64_t peer_limit = 1000000;  // of tets: the peer is not waited for beyond it
};

// The same field on generated meshes of so many tets.
Growth measure_growth(const GrowthOptions &options, const Parameters &parameters, int rounds);

// The caller's arrays and the peaks of the host and of the worker.
double bytes_in_all(const Contest &contest);

}  // namespace bench
