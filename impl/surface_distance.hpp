// 3.3  A k-d tree over the triangles of a closed surface: how far is a point from it, and on which side.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "geometry.hpp"
#include "job.hpp"
#include "kd_tree.hpp"
#include "surface_topology.hpp"

namespace tetlod {

/// The point of a surface that is nearest to another.
struct NearestPoint {
  std::int32_t triangle = -1;  ///< -1 where squared distances leave the range of doubles
  Vec3 weights{0};             ///< barycentric, in the triangle
  double distance = 0;
};

class TriangleTree {
 public:
  TriangleTree(Span<const Vec3> points, Span<const Triangle> triangles, Job &job, std::int64_t leaf = 8);
  /// usual2: few points are farther than its root. The less it is, the sooner the others' are found.
  NearestPoint nearest(const Vec3 &p, double usual2 = std::numeric_limits<double>::infinity()) const;
  /// Of the triangles that counts() is true of, or, where it is of none, of all.
  template <class Counts>
  NearestPoint nearest_among(const Vec3 &p, const Counts &counts) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double distance2 = infinity;
    const auto distance2_to = [&](std::int32_t t) { return counts(t) ? triangle(t).distance2_to(p) : infinity; };
    const std::int32_t t = tree_.nearest(p, distance2, distance2_to);
    if (t < 0 || !(distance2 < infinity)) return nearest(p);
    return {t, triangle(t).weights_nearest_to(p), std::sqrt(distance2)};
  }
  /// Whether it is no farther than the root of `most2`: sooner than what is nearest. near: a triangle that may be no
  /// farther, -1: none is known; becomes one that is not, where there is one.
  bool is_within(const Vec3 &p, double most2, std::int32_t &near) const;
  /// In how much material p is, by the triangles, but for one, on a ray to it: exact. Nothing where it is on one of
  /// them.
  std::optional<int> depth(const Vec3 &p, std::int32_t but = -1) const;
  int axis_of_rays() const { return axis_of_rays_; }
  /// visit(other) for the triangles whose boxes meet that of t, t among them; stops when it returns true, and says
  /// whether it did.
  template <class Visit>
  bool any_near(std::int32_t t, const Visit &visit) const {
    return tree_.any_overlap(box_of(points_, triangles_[std::size_t(t)]), visit);
  }
  /// visit(other) for all of them.
  template <class Visit>
  void for_near(std::int32_t t, const Visit &visit) const {
    any_near(t, [&](std::int32_t other) {
      visit(other);
      return false;
    });
  }

 private:
  TriangleInSpace triangle(std::int32_t t) const { return {points_, triangles_[std::size_t(t)]}; }
  std::int32_t nearest_within(const Vec3 &p, double &most2) const;

  Span<const Vec3> points_;
  Span<const Triangle> triangles_;
  KdTree tree_;
  int axis_of_rays_;
};

/// That of a surface, which stays as it is, from when it is first asked for until it is dropped. For one thread at a
/// time.
class TreeOnDemand {
 public:
  TreeOnDemand() = default;
  explicit TreeOnDemand(const Surface &surface) : points_(surface.points), triangles_(surface.triangles) {}

  const TriangleTree &get(Job &job) {
    if (!tree_) {
      TriangleTree tree(points_, triangles_, job);
      job.poll(0);  // of what is cancelled parts are missing
      tree_ = std::move(tree);
    }
    return *tree_;
  }
  /// And what was got from it.
  void drop() { tree_.reset(); }
  /// About.
  std::size_t bytes_to_make() const { return tree_ ? 0 : 150 * triangles_.size(); }

 private:
  Span<const Vec3> points_;
  Span<const Triangle> triangles_;
  std::optional<TriangleTree> tree_;
};

/// Tells inside from outside for every point that is not on the surface itself. The side is that of the angle-weighted
/// pseudonormal at the nearest point (Baerentzen and Aanaes 2005); where the surface touches itself that has no
/// meaning, and a ray decides.
class SurfaceDistance {
 public:
  SurfaceDistance(const Surface &surface, const SurfaceTopology &topology, std::int64_t leaf, Job &job);

  /// Positive inside.
  double signed_distance(const Vec3 &p, NearestPoint &nearest) const;

 private:
  Vec3 unit_normal(std::int32_t triangle) const;
  bool pseudonormal(const NearestPoint &at, Vec3 &normal) const;

  const Surface &surface_;
  const SurfaceTopology &topology_;
  TriangleTree nearest_;
  Array<Vec3> vertex_normal_;  // of each vertex of the cut surface
};

}  // namespace tetlod
