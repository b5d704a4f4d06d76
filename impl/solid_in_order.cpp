#include "solid_in_order.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "predicates.hpp"
#include "sort_by_place.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

void order_vertices(const MeshView &original, Span<const std::int32_t> used, Job &job, SolidInOrder &solid) {
  const auto place = [&](std::size_t i) { return original.points[std::size_t(used[i])]; };
  solid.origin = order_by_place(used.size(), place, job);
  solid.points.reserve(used.size());
  for (std::int32_t &v : solid.origin) {
    v = used[std::size_t(v)];
    solid.points.push_back(original.points[std::size_t(v)]);
  }
}

/// Of each tet, with its vertices' new numbers.
Array<std::int32_t> first_vertices(const MeshView &original, Span<const std::int32_t> number, Job &job) {
  Array<std::int32_t> first = array_of(original.tets.size(), std::numeric_limits<std::int32_t>::max(), job);
  for_each(first.size(), job, [&](std::size_t t) {
    for (std::int32_t v : original.tets[t]) first[t] = std::min(first[t], number[std::size_t(v)]);
  });
  return first;
}

Tet upright(Tet tet, Span<const std::int32_t> number, Span<const Vec3> points) {
  for (std::int32_t &v : tet) v = number[std::size_t(v)];
  if (orientation(points, tet) < 0) std::swap(tet[2], tet[3]);
  return tet;
}

/// By their first vertices; each thread those of some vertices.
void order_tets(const MeshView &original, Span<const std::int32_t> number, Job &job, SolidInOrder &solid) {
  const Array<std::int32_t> first = first_vertices(original, number, job);
  Array<std::size_t> next(solid.points.size() + 1, 0, &job.memory);
  const auto for_tets = [&](const auto &visit) {
    job.parallel.for_parts(solid.points.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = 0; t < first.size(); t++) {
        job.poll_at(t, 0);
        if (std::size_t(first[t]) - begin < end - begin) visit(t, next[std::size_t(first[t])]);
      }
    });
  };
  for_tets([](std::size_t, std::size_t &count) { count++; });
  std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t(0));
  grow(solid.tets, next.back(), job);
  for_tets([&](std::size_t t, std::size_t &place) {
    solid.tets[place++] = upright(original.tets[t], number, solid.points);
  });
}

}  // namespace

SolidInOrder put_in_order(const MeshView &original, const Boundary &boundary, Job &job) {
  SolidInOrder solid(job.memory);
  order_vertices(original, used_vertices(original, job), job, solid);
  Array<std::int32_t> number(original.points.size(), -1, &job.memory);
  for (std::size_t v = 0; v < solid.origin.size(); v++) number[std::size_t(solid.origin[v])] = std::int32_t(v);
  order_tets(original, number, job, solid);
  solid.triangles.assign(boundary.triangles.begin(), boundary.triangles.end());
  for (Triangle &t : solid.triangles)
    for (std::int32_t &v : t) v = number[std::size_t(v)];
  return solid;
}

}  // namespace tetlod
