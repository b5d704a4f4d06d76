#include "fill_up.hpp"

#include <algorithm>

#include "flip_tets.hpp"
#include "most_needed.hpp"

namespace tetlod {

namespace {

/// Part of the tets with which no more are needed.
constexpr double near_enough = 0.98;
/// A vertex with more weight at a corner is no other place; with less at one, it goes onto the face of the others, or
/// their edge.
constexpr double near_corner = 0.8, near_face = 0.02;
/// Of so few tets, the dozen that a vertex on an edge may bring are too many.
constexpr std::int64_t few_tets = 500;

/// How many of the original's vertices are in a tet, and which one is the furthest from its corners.
template <std::size_t m>
Need crowd_in(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  Need crowd{0, t, -1};
  const TetFrame frame = mesh.frame(t);
  double nearest = near_corner, w[4];
  mesh.for_probes(t, [&](std::int32_t p) {
    if (std::size_t(p) >= mesh.vertex_probes) return;
    crowd.size++;
    frame.weights(mesh.probes[std::size_t(p)].point, w);
    const double most = *std::max_element(w, w + 4);
    if (most >= nearest) return;
    nearest = most;
    crowd.probe = p;
  });
  return crowd;
}

}  // namespace

template <std::size_t m>
void fill_up(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh) {
  if (double(mesh.count()) >= near_enough * double(tets)) return;
  const double snap = tets < few_tets ? 0 : near_face;
  Array<std::int32_t> around(&job.memory);
  const auto make_vertex = [&](const Need &crowd) -> const Array<std::int32_t> & {
    const Probe<m> probe = mesh.probes[std::size_t(crowd.probe)];
    around.clear();
    if (insert_vertex(crowd.tet, probe.point, probe.value, snap, least_shape, mesh))
      mesh.star(std::int32_t(mesh.points.size()) - 1, around);
    return around;
  };
  serve_most_needed(
      tets, job, mesh, [&](std::int32_t t) { return crowd_in(mesh, t); }, make_vertex);
  const double missing = double(tets) - double(mesh.count());
  if (missing < tets_a_vertex && missing > (1 - near_enough) * double(tets)) remove_faces(tets, job, mesh);
}

template void fill_up(std::int64_t, Job &, AdaptiveMesh<1> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<2> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<3> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
