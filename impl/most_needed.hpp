// Which probe of a mesh is to become a vertex next, when each of them changes what the others need.
#pragma once
#include <cstdint>
#include <functional>
#include <queue>

#include "adaptive_mesh.hpp"
#include "insert_vertices.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

/// How much it matters that a probe in a tet becomes a vertex; no probe: not at all.
struct Need {
  double size = 0;
  std::int32_t tet = -1, probe = -1;
  bool operator<(const Need &o) const { return size != o.size ? size < o.size : tet > o.tet; }
  bool operator==(const Need &o) const { return size == o.size && tet == o.tet && probe == o.probe; }
};

/// The greatest need of all first, as long as a vertex more leaves no more than `tets`. need_in(t): the greatest in tet
/// t. serve(need): the tets around the vertex that the probe has become; none where it could not.
template <std::size_t m, class NeedIn, class Serve>
void serve_most_needed(std::int64_t tets, Job &job, const AdaptiveMesh<m> &mesh, const NeedIn &need_in,
                       const Serve &serve) {
  Array<Need> needs = array_of(mesh.tets.size(), Need(), job);
  for_each(needs.size(), job, [&](std::size_t t) {
    if (mesh.alive(std::int32_t(t))) needs[t] = need_in(std::int32_t(t));
  });
  keep_where(needs, job, [&](std::size_t t) { return needs[t].probe >= 0; });
  std::priority_queue greatest(std::less<>(), std::move(needs));
  for (std::size_t i = 0; std::int64_t(mesh.count()) + tets_a_vertex <= tets && !greatest.empty(); i++) {
    if (i % 256 == 0) job.poll(0.9);
    const Need next = greatest.top();
    greatest.pop();
    if (!mesh.alive(next.tet) || !(need_in(next.tet) == next)) continue;
    for (std::int32_t t : serve(next))
      if (const Need need = need_in(t); need.probe >= 0) greatest.push(need);
  }
}

}  // namespace tetlod
