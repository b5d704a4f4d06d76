// A mesh as the caller has it, before points become one.
#pragma once
#include <algorithm>

#include "disjoint_sets.hpp"
#include "job.hpp"
#include "pipeline.hpp"

namespace tetlod {

struct SubmittedMesh {
  const Input &input;
  Span<const Vec3> points;
  Span<const Tet> tets;
  Span<const std::uint8_t> used;  ///< of each point; tets with one that is not are none

  bool has_all(const Tet &t) const {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return used[std::size_t(v)] != 0; });
  }

  /// Its points, as they hang together that tets have in common.
  DisjointSets join_parts(Job &job) const {
    DisjointSets parts(points.size(), job.memory);
    for (std::size_t t = 0; t < tets.size(); t++) {
      job.poll_at(t, 0.9);
      if (!has_all(tets[t])) continue;
      for (const std::int32_t v : tets[t]) parts.join(tets[t][0], v);
    }
    return parts;
  }
};

/// Parts of fewer tets may be cells of a method that lets fields jump everywhere.
constexpr std::int32_t large_part = 64;

}  // namespace tetlod
