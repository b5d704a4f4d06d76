// Places that look random, one for each key: there is no state, so any thread may ask for any of them.
#pragma once
#include <algorithm>
#include <cstdint>

namespace tetlod {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
inline std::uint64_t scrambled(std::uint64_t key) {
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return key ^ (key >> 31);
}

/// Uniform in [0, 1).
inline double random_unit(std::uint64_t key) {
  return double(scrambled((key + 1) * 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53;
}

/// The weights of a tet's corners at a place in it, uniformly: the gaps between three sorted numbers.
inline void random_weights(std::uint64_t key, double weights[4]) {
  double cut[3];
  for (std::size_t k = 0; k < 3; k++) cut[k] = random_unit(3 * key + k);
  std::sort(cut, cut + 3);
  weights[0] = cut[0];
  weights[1] = cut[1] - cut[0];
  weights[2] = cut[2] - cut[1];
  weights[3] = 1 - cut[2];
}

}  // namespace tetlod
