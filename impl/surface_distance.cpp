#include "surface_distance.hpp"

#include <cmath>
#include <limits>

#include "portable_math.hpp"
#include "ray.hpp"

namespace tetlod {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double angle_between(const Vec3 &a, const Vec3 &b) { return angle_of(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

}  // namespace

TriangleTree::TriangleTree(Span<const Vec3> points, Span<const Triangle> triangles, Job &job, std::int64_t leaf)
    : points_(points), triangles_(triangles), tree_(job.memory) {
  Array<Box> boxes = boxes_of(triangles.size(), job, [&](std::size_t t) { return box_of(points, triangles[t]); });
  axis_of_rays_ = tetlod::axis_of_rays(boxes, job);
  tree_.build(std::move(boxes), leaf, job);
}

/// Of those that are no farther than the root of `most2`, which becomes the square of its distance; else -1.
std::int32_t TriangleTree::nearest_within(const Vec3 &p, double &most2) const {
  return tree_.nearest(p, most2, [&](std::int32_t t) { return triangle(t).distance2_to(p); });
}

NearestPoint TriangleTree::nearest(const Vec3 &p, double usual2) const {
  NearestPoint best;
  double distance2 = usual2;
  best.triangle = nearest_within(p, distance2);
  if (best.triangle < 0) best.triangle = nearest_within(p, distance2 = infinity);
  if (best.triangle < 0) {  // so far away that squares leave the range of doubles
    best.distance = infinity;
    return best;
  }
  best.weights = triangle(best.triangle).weights_nearest_to(p);
  best.distance = std::sqrt(distance2);
  return best;
}

bool TriangleTree::is_within(const Vec3 &p, double most2, std::int32_t &near) const {
  constexpr double no_more = -1;  // none is nearer, so that the search ends
  if (near >= 0 && triangle(near).distance2_to(p) <= most2) return true;
  double best = most2;
  const auto end_or_go_on = [&](std::int32_t t) { return triangle(t).distance2_to(p) <= most2 ? no_more : infinity; };
  const std::int32_t found = tree_.nearest(p, best, end_or_go_on);
  if (found >= 0) near = found;
  return found >= 0;
}

std::optional<int> TriangleTree::depth(const Vec3 &p, std::int32_t but) const {
  int depth = 0;
  const bool meets = !tree_.empty() && tree_.any_overlap(ray_to(p, tree_.box(), axis_of_rays_), [&](std::int32_t t) {
    if (t == but) return false;
    const TriangleInSpace met = triangle(t);
    const RayEnd end = end_of_ray(met.a, met.b, met.c, p, axis_of_rays_);
    depth += depth_gained(end);
    return end == RayEnd::at;
  });
  return meets ? std::nullopt : std::optional(depth);
}

SurfaceDistance::SurfaceDistance(const Surface &surface, const SurfaceTopology &topology, std::int64_t leaf, Job &job)
    : surface_(surface),
      topology_(topology),
      nearest_(surface.points, surface.triangles, job, leaf),
      vertex_normal_(topology.vertex_of.size(), Vec3(0), &job.memory) {
  for (std::size_t t = 0; t < surface.triangles.size(); t++) {
    if (t % 4096 == 0) job.poll(0);
    const Triangle &v = surface.triangles[t];
    const Vec3 normal = unit_normal(std::int32_t(t));
    for (std::size_t k = 0; k < 3; k++) {
      const Vec3 &at = surface.points[std::size_t(v[k])];
      const double angle = angle_between(surface.points[std::size_t(v[(k + 1) % 3])] - at,
                                         surface.points[std::size_t(v[(k + 2) % 3])] - at);
      vertex_normal_[std::size_t(topology.sheet_vertex[3 * t + k])] += angle * normal;
    }
  }
}

Vec3 SurfaceDistance::unit_normal(std::int32_t triangle) const {
  const TriangleInSpace t(surface_.points, surface_.triangles[std::size_t(triangle)]);
  const Vec3 normal = area_vector(t.a, t.b, t.c);
  const double length = glm::length(normal);
  return length > 0 ? normal / length : Vec3(0);
}

bool SurfaceDistance::pseudonormal(const NearestPoint &at, Vec3 &normal) const {
  const Triangle &v = surface_.triangles[std::size_t(at.triangle)];
  int zeros = 0, zero = 0, other = 0;
  for (int k = 0; k < 3; k++)
    if (at.weights[k] == 0) {
      zeros++;
      zero = k;
    } else {
      other = k;
    }
  normal = unit_normal(at.triangle);
  if (zeros == 0) return true;
  if (zeros == 1) {  // on the edge opposite corner `zero`
    const int from = (zero + 1) % 3, to = (zero + 2) % 3;
    if (topology_.touching[std::size_t(v[std::size_t(from)])] && topology_.touching[std::size_t(v[std::size_t(to)])])
      return false;
    normal += unit_normal(topology_.mate[std::size_t(3 * at.triangle + from)] / 3);
    return true;
  }
  if (topology_.touching[std::size_t(v[std::size_t(other)])]) return false;
  normal = vertex_normal_[std::size_t(topology_.sheet_vertex[std::size_t(3 * at.triangle + other)])];
  return true;
}

double SurfaceDistance::signed_distance(const Vec3 &p, NearestPoint &nearest) const {
  nearest = nearest_.nearest(p);
  const TriangleInSpace triangle(surface_.points, surface_.triangles[std::size_t(nearest.triangle)]);
  const Vec3 at = triangle.at(nearest.weights);
  Vec3 normal;
  const bool inside = pseudonormal(nearest, normal) ? glm::dot(p - at, normal) < 0 : nearest_.depth(p) > 0;
  return inside ? nearest.distance : -nearest.distance;
}

}  // namespace tetlod
