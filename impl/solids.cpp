#include "solids.hpp"

#include <algorithm>

#include "disjoint_sets.hpp"
#include "face_sweep.hpp"

namespace tetlod {

Array<std::int32_t> solids_of_vertices(const MeshView &mesh, Job &job) {
  constexpr std::int32_t none = -1, several = -2;
  DisjointSets solids(mesh.tets.size(), job.memory);
  for_each_face(mesh, {}, job, [&](const FaceUse *first, const FaceUse *last) {
    for (const FaceUse *use = first + 1; use < last; use++)
      solids.join(std::int32_t(first->tet()), std::int32_t(use->tet()));
  });
  Array<std::int32_t> solid(mesh.points.size(), none, &job.memory);
  for (std::size_t t = 0; t < mesh.tets.size(); t++) {
    job.poll_at(t, 0);
    const std::int32_t own = solids.lowest(std::int32_t(t));
    for (const std::int32_t v : mesh.tets[t]) {
      std::int32_t &of_vertex = solid[std::size_t(v)];
      of_vertex = of_vertex == none || of_vertex == own ? own : several;
    }
  }
  std::replace(solid.begin(), solid.end(), several, none);
  return solid;
}

SolidsOfTets::SolidsOfTets(const TetComplex &mesh, Span<const std::int32_t> of_vertices, Job &job)
    : of_vertices_(of_vertices), solid_(&job.memory) {
  if (!are_several()) return;
  const std::size_t tets = mesh.tets.size();
  solid_.resize(tets, -1);
  DisjointSets joined(tets, job.memory);
  for (std::size_t t = 0; t < tets; t++) {
    job.poll_at(t, 0);
    for (const std::int32_t next : mesh.neighbours[t])
      if (mesh.alive(std::int32_t(t)) && next >= 0) joined.join(std::int32_t(t), next);
  }
  const auto solid = [&](std::size_t t) -> std::int32_t & {
    return solid_[std::size_t(joined.lowest(std::int32_t(t)))];
  };
  job.poll(0);
  for (std::size_t t = 0; t < tets; t++)
    for (const std::int32_t v : mesh.tets[t])
      if (v >= 0 && std::size_t(v) < mesh.solid.size()) solid(t) = std::max(solid(t), mesh.solid[std::size_t(v)]);
  for (std::size_t t = 0; t < tets; t++) solid_[t] = solid(t);
}

}  // namespace tetlod
