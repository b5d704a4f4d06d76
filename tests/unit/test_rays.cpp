// In how much material a point is, by a ray to it: against winding numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "brute_force.hpp"
#include "meshes.hpp"
#include "ray.hpp"
#include "surface_distance.hpp"

namespace tetlod {
namespace {

using namespace test;

void add(const Surface &blob, double size, const Vec3 &at, Surface &surface) {
  const auto first = std::int32_t(surface.points.size());
  for (const Vec3 &p : blob.points) surface.points.push_back(size * p + at);
  for (const Triangle &t : blob.triangles) surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// Every other one has another in it, so that some points are in material twice.
Surface row_of_blobs(int axis, int count, Host &host) {
  Surface surface(host.memory);
  const Surface blob = random_blob(host.memory, 2, 7);
  for (int i = 0; i < count; i++) {
    Vec3 at(0);
    at[axis] = 3.5 * i;
    add(blob, 1, at, surface);
    if (i % 2) add(blob, 0.6, at, surface);
  }
  return surface;
}

TEST(Rays, FindTheDepthOfAPointWhicheverAxisTheyTake) {
  Host host;
  std::mt19937_64 random(11);
  for (int axis = 0; axis < 3; axis++) {
    const Surface surface = row_of_blobs(axis, 4, host);
    const TriangleTree tree(surface.points, surface.triangles, host.job);
    EXPECT_NE(tree.axis_of_rays(), axis) << "rays along the row meet all of it";
    const Box box = box_of(surface.points);
    int found[3] = {};
    for (int i = 0; i < 800; i++) {
      Vec3 p;
      for (int k = 0; k < 3; k++) p[k] = std::uniform_real_distribution<double>(box.low[k], box.high[k])(random);
      const auto expected = int(std::lround(winding_number(surface.points, surface.triangles, p)));
      ASSERT_EQ(tree.depth(p), std::optional(expected));
      found[expected]++;
    }
    for (const int times : found) EXPECT_GT(times, 0);
  }
}

TEST(Rays, EndAtATriangleThatThePointIsOn) {
  Host host;
  for (int axis = 0; axis < 3; axis++) {
    const Surface surface = row_of_blobs(axis, 2, host);
    const TriangleTree tree(surface.points, surface.triangles, host.job);
    EXPECT_EQ(tree.depth(surface.points[0]), std::nullopt);
  }
}

TEST(Rays, OfBoxesSideBySideGoAcross) {
  Host host;
  for (int axis = 0; axis < 3; axis++) {
    std::vector<Box> boxes(1);  // an empty one, which does not count
    for (int i = 0; i < 5; i++) {
      Box box;
      box.add(Vec3(0));
      box.add(Vec3(1));
      box.low[axis] += 2 * i, box.high[axis] += 2 * i;
      boxes.push_back(box);
    }
    EXPECT_NE(axis_of_rays({boxes.data(), boxes.size()}, host.job), axis);
  }
}

}  // namespace
}  // namespace tetlod
