#include "fill_up.hpp"

#include <algorithm>
#include <queue>

#include "insert_vertices.hpp"
#include "refine.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// Part of the tets with which no more are needed.
constexpr double near_enough = 0.98;
/// A vertex with more weight at a corner is no other place; with less at one, it goes onto the face of the others, or
/// their edge.
constexpr double near_corner = 0.8, near_face = 0.02;

/// How many of the original's vertices are in a tet, and which one is the furthest from its corners.
struct Crowd {
  std::int32_t count = 0, tet = -1, probe = -1;
  bool operator<(const Crowd &o) const { return count != o.count ? count < o.count : tet > o.tet; }
};

template <std::size_t m>
Crowd crowd_in(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  Crowd crowd;
  crowd.tet = t;
  const TetFrame frame = mesh.frame(t);
  double nearest = near_corner, w[4];
  mesh.for_probes(t, [&](std::int32_t p) {
    if (std::size_t(p) >= mesh.vertex_probes) return;
    crowd.count++;
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
  const auto has_room = [&] { return std::int64_t(mesh.count()) + tets_a_vertex <= tets; };
  const double snap = tets < few_tets ? 0 : near_face;
  Array<Crowd> crowds = array_of(mesh.tets.size(), Crowd(), job);
  for_each(crowds.size(), job, [&](std::size_t t) {
    if (mesh.alive(std::int32_t(t))) crowds[t] = crowd_in(mesh, std::int32_t(t));
  });
  keep_where(crowds, job, [&](std::size_t t) { return crowds[t].probe >= 0; });
  std::priority_queue most(std::less<>(), std::move(crowds));
  Array<std::int32_t> around(&job.memory);
  for (std::size_t i = 0; has_room() && !most.empty(); i++) {
    if (i % 256 == 0) job.poll(0.9);
    const Crowd next = most.top();
    most.pop();
    if (!mesh.alive(next.tet) || crowd_in(mesh, next.tet).probe != next.probe) continue;
    const Probe<m> probe = mesh.probes[std::size_t(next.probe)];
    if (!insert_vertex(next.tet, probe.point, probe.value, snap, least_shape, mesh)) continue;
    mesh.star(std::int32_t(mesh.points.size()) - 1, around);
    for (std::int32_t t : around)
      if (const Crowd crowd = crowd_in(mesh, t); crowd.probe >= 0) most.push(crowd);
  }
}

template void fill_up(std::int64_t, Job &, AdaptiveMesh<1> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<2> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<3> &);
template void fill_up(std::int64_t, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
