#include "solid_in_order.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "sort_by_place.hpp"

namespace tetlod {

namespace {

constexpr std::size_t poll_every = 65536;

bool is_excluded(const Boundary &boundary, std::size_t t) { return !boundary.excluded.empty() && boundary.excluded[t]; }

Array<std::int32_t> used_vertices(const MeshView &original, const Boundary &boundary, Job &job) {
  Array<std::uint8_t> used(original.points.size(), 0, &job.memory);
  for (std::int32_t v : boundary.interior) used[std::size_t(v)] = 1;
  for (const Triangle &t : boundary.triangles)
    for (std::int32_t v : t) used[std::size_t(v)] = 1;
  Array<std::int32_t> vertices(&job.memory);
  for (std::size_t v = 0; v < used.size(); v++)
    if (used[v]) vertices.push_back(std::int32_t(v));
  return vertices;
}

void order_vertices(const MeshView &original, Span<const std::int32_t> used, Job &job, SolidInOrder &solid) {
  const auto place = [&](std::size_t i) { return original.points[std::size_t(used[i])]; };
  solid.origin = order_by_place(used.size(), place, job);
  solid.points.reserve(used.size());
  for (std::int32_t &v : solid.origin) {
    v = used[std::size_t(v)];
    solid.points.push_back(original.points[std::size_t(v)]);
  }
}

std::size_t first_vertex(const Tet &t) { return std::size_t(*std::min_element(t.begin(), t.end())); }

void order_tets(const MeshView &original, const Boundary &boundary, Span<const std::int32_t> number, Job &job,
                SolidInOrder &solid) {
  const auto renumbered = [&](Tet t) {
    for (std::int32_t &v : t) v = number[std::size_t(v)];
    return t;
  };
  Array<std::size_t> next(solid.points.size() + 1, 0, &job.memory);
  for (std::size_t t = 0; t < original.tets.size(); t++) {
    if (t % poll_every == 0) job.poll(0);
    if (!is_excluded(boundary, t)) next[first_vertex(renumbered(original.tets[t])) + 1]++;
  }
  for (std::size_t v = 1; v < next.size(); v++) next[v] += next[v - 1];
  solid.tets.resize(next.back());
  for (std::size_t t = 0; t < original.tets.size(); t++) {
    if (t % poll_every == 0) job.poll(0);
    if (is_excluded(boundary, t)) continue;
    Tet tet = renumbered(original.tets[t]);
    const auto p = [&](std::size_t k) { return solid.points[std::size_t(tet[k])]; };
    if (det(p(0), p(1), p(2), p(3)) < 0) std::swap(tet[2], tet[3]);
    solid.tets[next[first_vertex(tet)]++] = tet;
  }
}

}  // namespace

SolidInOrder put_in_order(const MeshView &original, const Boundary &boundary, Job &job) {
  SolidInOrder solid(job.memory);
  order_vertices(original, used_vertices(original, boundary, job), job, solid);
  Array<std::int32_t> number(original.points.size(), -1, &job.memory);
  for (std::size_t v = 0; v < solid.origin.size(); v++) number[std::size_t(solid.origin[v])] = std::int32_t(v);
  order_tets(original, boundary, number, job, solid);
  solid.triangles.assign(boundary.triangles.begin(), boundary.triangles.end());
  for (Triangle &t : solid.triangles)
    for (std::int32_t &v : t) v = number[std::size_t(v)];
  return solid;
}

}  // namespace tetlod
