// Values that give way to the largest errors, as far as errors elsewhere allow.
#pragma once
#include "adaptive_mesh.hpp"

namespace tetlod {

/// Changes the values of a corner of tet t, by as little as it takes, so that the error at a probe of t, of an original
/// vertex, is `bound` at most, as largest_error() counts. They stay within `range`, and no other probe of an original
/// vertex comes to be beyond the bound, or further than it was. False, and nothing is done, where no corner can.
template <std::size_t m>
bool give_way(std::int32_t t, std::int32_t probe, double bound, const ValueRange<m> &range, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
