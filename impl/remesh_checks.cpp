#include "remesh_checks.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "disjoint_sets.hpp"
#include "exact_order.hpp"
#include "geometry.hpp"
#include "key_file.hpp"
#include "remesh_frame.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

constexpr std::size_t turn = std::size_t(1) << 16;  // loop turns between two polls of the job

void check_size(const Surface &surface) {
  if (surface.points.empty() || surface.triangles.empty()) fail(Status::mesh_empty, "the boundary is empty");
  if (surface.points.size() < 4 || surface.triangles.size() < 4)
    fail(Status::mesh_degenerate, "the boundary has %zu vertices and %zu triangles, a solid has at least 4",
         surface.points.size(), surface.triangles.size());
  if (surface.points.size() > std::size_t(max_count) || surface.triangles.size() > std::size_t(max_count))
    fail(Status::mesh_too_large, "the boundary has more than %lld vertices or triangles", (long long)max_count);
}

void check_finite(const Surface &surface) {
  for (std::size_t i = 0; i < surface.points.size(); i++)
    if (!is_finite(surface.points[i])) fail(Status::mesh_nonfinite, "boundary vertex %zu is not finite", i);
}

void check_corners(const Surface &surface) {
  const auto count = std::int32_t(surface.points.size());
  for (std::size_t i = 0; i < surface.triangles.size(); i++) {
    const Triangle &t = surface.triangles[i];
    for (const std::int32_t corner : t)
      if (corner < 0 || corner >= count)
        fail(Status::mesh_index, "boundary triangle %zu has the corner %d, there are %d vertices", i, corner, count);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      fail(Status::mesh_degenerate, "boundary triangle %zu has the corner %d twice", i, t[0] == t[1] ? t[0] : t[2]);
  }
}

void check_extents(const Box &box) {
  for (int k = 0; k < 3; k++)
    if (!(box.low[k] < box.high[k]))
      fail(Status::mesh_degenerate, "the boundary is flat: every vertex has %c = %s", "xyz"[k],
           number(box.low[k]).c_str());
}

void check_every_vertex_used(const Surface &surface, Memory &memory) {
  Array<char> used(surface.points.size(), 0, &memory);
  for (const Triangle &t : surface.triangles)
    for (const std::int32_t corner : t) used[std::size_t(corner)] = 1;
  for (std::size_t i = 0; i < used.size(); i++)
    if (!used[i]) fail(Status::remesh, "boundary vertex %zu is in no boundary triangle", i);
}

void check_areas(Span<const Vec3> points, Span<const Triangle> triangles) {
  for (std::size_t i = 0; i < triangles.size(); i++) {
    const Vec3 &a = points[std::size_t(triangles[i][0])];
    const Vec3 &b = points[std::size_t(triangles[i][1])];
    const Vec3 &c = points[std::size_t(triangles[i][2])];
    const Vec3 normal = glm::cross(b - a, c - a);
    if (normal.x == 0 && normal.y == 0 && normal.z == 0)
      fail(Status::mesh_degenerate, "boundary triangle %zu has no area", i);
  }
}

void check_coincident(Span<const Vec3> points, Job &job) {
  const Array<std::int32_t> order = in_exact_order(points, job);
  for (std::size_t i = 1; i < order.size(); i++)
    if (points[std::size_t(order[i - 1])] == points[std::size_t(order[i])])
      fail(Status::mesh_degenerate, "boundary vertices %d and %d are at the same place", order[i - 1], order[i]);
}

void check_duplicates(const Surface &surface, Job &job) {
  KeyFile faces(job.memory);
  file_faces(surface.triangles, surface.points.size(), 0, job, faces);
  for (std::size_t v = 0; v < faces.vertices(); v++) {
    const Span<const std::uint64_t> keys = faces.of(v);
    for (std::size_t i = 1; i < keys.size(); i++)
      if (keys[i - 1] >> 1 == keys[i] >> 1)
        fail(Status::mesh_nonmanifold, "two boundary triangles have the corners %zu, %u and %u", v,
             unsigned(keys[i] >> 32), unsigned(keys[i] >> 1 & 0x7fffffff));
  }
}

/// Edges filed under their smaller vertex: larger vertex, triangle, and the way the triangle runs along.
struct EdgeKey {
  std::uint64_t key;
  EdgeKey(std::int32_t from, std::int32_t to, std::size_t triangle)
      : key(std::uint64_t(std::max(from, to)) << 32 | std::uint64_t(triangle) << 1 | std::uint64_t(from < to)) {}
  explicit EdgeKey(std::uint64_t stored) : key(stored) {}
  std::int32_t larger() const { return std::int32_t(key >> 32); }
  std::int32_t triangle() const { return std::int32_t(key >> 1 & 0x7fffffff); }
  bool upward() const { return key & 1; }
};

KeyFile file_edges(const Surface &surface, Job &job) {
  KeyFile edges(job.memory);
  edges.build(
      surface.points.size(),
      [&](const auto &visit) {
        for (std::size_t i = 0; i < surface.triangles.size(); i++)
          for (std::size_t k = 0; k < 3; k++) {
            const std::int32_t from = surface.triangles[i][k], to = surface.triangles[i][(k + 1) % 3];
            visit(std::min(from, to), EdgeKey(from, to, i).key);
          }
      },
      0, job);
  return edges;
}

/// As many triangles run along an edge one way as the other: two where the surface is a manifold, more where the
/// solid touches itself.
void check_balance(std::size_t vertex, Span<const std::uint64_t> edge) {
  std::size_t upward = 0;
  for (const std::uint64_t key : edge) upward += EdgeKey(key).upward();
  if (2 * upward == edge.size()) return;
  const EdgeKey first(edge[0]);
  fail(Status::mesh_nonmanifold,
       "the boundary is not closed and oriented: edge %zu-%d has %zu triangles one way and %zu the other (triangle %d)",
       vertex, first.larger(), upward, edge.size() - upward, first.triangle());
}

/// Two triangles at an edge of two bound the same piece of empty space, so a cavity is never joined to the outside;
/// at an edge of four it could be.
void find_components(const Surface &surface, Job &job, SurfaceFacts &facts) {
  const KeyFile edges = file_edges(surface, job);
  DisjointSets components(surface.triangles.size(), job.memory);
  for (std::size_t v = 0; v < edges.vertices(); v++) {
    if (v % turn == 0) job.poll(0);
    const Span<const std::uint64_t> keys = edges.of(v);
    for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
      while (last < keys.size() && EdgeKey(keys[last]).larger() == EdgeKey(keys[first]).larger()) last++;
      check_balance(v, {keys.data() + first, last - first});
      if (last - first == 2) components.join(EdgeKey(keys[first]).triangle(), EdgeKey(keys[first + 1]).triangle());
    }
  }
  facts.components = components.count();
  facts.component.resize(surface.triangles.size());
  for (std::size_t t = 0; t < facts.component.size(); t++) facts.component[t] = components.lowest(std::int32_t(t));
}

void check_volume(Span<const Vec3> points, Span<const Triangle> triangles) {
  const Volume volume = enclosed_volume(points, triangles);
  if (volume.value <= -volume.uncertainty) fail(Status::remesh, "the boundary is inside out");
  if (volume.value <= volume.uncertainty) fail(Status::mesh_degenerate, "the boundary encloses no volume");
}

}  // namespace

Volume enclosed_volume(Span<const Vec3> points, Span<const Triangle> triangles) {
  constexpr double error_of_a_term = 1e-15;
  Volume volume;
  if (triangles.empty()) return volume;
  const Vec3 origin = points[std::size_t(triangles[0][0])];
  for (const Triangle &t : triangles) {
    const Vec3 a = points[std::size_t(t[0])];
    const Vec3 b = points[std::size_t(t[1])] - a, c = points[std::size_t(t[2])] - a;
    const Vec3 away = a - origin;
    volume.value += glm::dot(away, glm::cross(b, c)) / 6;
    volume.uncertainty += error_of_a_term * glm::length(away) * glm::length(b) * glm::length(c);
  }
  return volume;
}

SurfaceFacts check_surface(const Surface &surface, Job &job) {
  check_size(surface);
  check_finite(surface);
  check_corners(surface);
  SurfaceFacts facts(job.memory);
  facts.box = box_of(surface.points);
  check_extents(facts.box);
  const Frame frame = uniform_frame(facts.box);
  Array<Vec3> points(surface.points.size(), &job.memory);
  for (std::size_t i = 0; i < points.size(); i++) points[i] = frame.into(surface.points[i]);
  check_every_vertex_used(surface, job.memory);
  check_areas(points, surface.triangles);
  check_coincident(points, job);
  check_duplicates(surface, job);
  find_components(surface, job, facts);
  check_volume(points, surface.triangles);
  return facts;
}

void check_samples(Span<const Vec3> samples) {
  for (std::size_t i = 0; i < samples.size(); i++)
    if (!is_finite(samples[i])) fail(Status::mesh_nonfinite, "interior point %zu is not finite", i);
}

}  // namespace tetlod
