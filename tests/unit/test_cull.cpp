// 3.3  Culling: inside or outside, and how far, as the winding number and a look at every triangle say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "brute_force.hpp"
#include "cull_samples.hpp"
#include "meshes.hpp"
#include "remesh_surfaces.hpp"
#include "surface_distance.hpp"

namespace tetlod {
namespace {

using namespace test;

/// What the two say of a point, and how sure brute force can be: nearer than this to the surface, it cannot.
constexpr double unsure = 1e-12;

class Cull : public testing::Test {
 protected:
  Host host;
  std::mt19937_64 random{1};
  std::vector<Vec3> points;

  SurfaceTopology topology_of(const Surface &surface) {
    SurfaceTopology topology(host.memory);
    find_topology(surface.points, surface.triangles, host.job, topology);
    return topology;
  }

  void scatter(const Surface &surface, int count) {
    Box box;
    for (const Vec3 &p : surface.points) box.add(p);
    std::uniform_real_distribution<double> uniform(-0.05, 1.05);
    const Vec3 size = box.high - box.low;
    for (int i = 0; i < count; i++)
      points.push_back(box.low + size * Vec3(uniform(random), uniform(random), uniform(random)));
  }

  /// Beside triangles, edges and vertices, at distances from large to hardly any.
  void scatter_near(const Surface &surface, int count) {
    std::uniform_real_distribution<double> uniform(0, 1), direction(-1, 1), exponent(-9, -1);
    for (int i = 0; i < count; i++) {
      const Triangle &t = surface.triangles[random() % surface.triangles.size()];
      double w[3] = {uniform(random), i % 3 ? uniform(random) : 0, i % 3 == 1 ? uniform(random) : 0};
      const double total = w[0] + w[1] + w[2];
      Vec3 p(0);
      for (std::size_t k = 0; k < 3; k++) p += w[k] / total * surface.points[std::size_t(t[k])];
      const double distance = std::pow(10.0, exponent(random));
      points.push_back(p + distance * Vec3(direction(random), direction(random), direction(random)));
    }
  }

  void expect_distances(const Surface &surface, std::int64_t leaf) {
    const SurfaceTopology topology = topology_of(surface);
    const SurfaceDistance distance(surface, topology, leaf, host.job);
    int inner = 0, outer = 0;
    for (const Vec3 &p : points) {
      const BruteNearest brute = brute_nearest(surface.points, surface.triangles, p);
      const double winding = winding_number(surface.points, surface.triangles, p);
      NearestPoint nearest;
      const double d = distance.signed_distance(p, nearest);
      ASSERT_NEAR(std::abs(d), brute.distance, 1e-12) << p.x << " " << p.y << " " << p.z;
      ASSERT_EQ(nearest.distance, std::abs(d));
      if (brute.distance < unsure) continue;
      ASSERT_LT(std::min(std::abs(winding), std::abs(winding - 1)), 1e-3) << "brute force is at a loss";
      ASSERT_EQ(d > 0, winding > 0.5) << p.x << " " << p.y << " " << p.z << ", " << d << " away";
      (d > 0 ? inner : outer)++;
    }
    EXPECT_GT(inner, int(points.size() / 100));
    EXPECT_GT(outer, int(points.size() / 100));
  }

  void expect_distances(const Surface &surface) {
    points.clear();
    scatter(surface, 200);
    scatter_near(surface, 600);
    expect_distances(surface, 8);
  }

  Array<std::int32_t> all_samples() {
    Array<std::int32_t> samples(&host.memory);
    for (std::size_t i = 0; i < points.size(); i++) samples.push_back(std::int32_t(i));
    return samples;
  }
};

TEST_F(Cull, DistanceToACube) {
  const Surface surface = box(host.memory, 3);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  const SurfaceTopology topology = topology_of(surface);
  const SurfaceDistance distance(surface, topology, 8, host.job);
  for (int i = 0; i < 2000; i++) {
    const Vec3 p(uniform(random), uniform(random), uniform(random)), out = glm::max(-p, p - Vec3(1));
    const double most = std::max({out.x, out.y, out.z});
    const double expected = most < 0 ? -most : -glm::length(glm::max(out, Vec3(0)));
    NearestPoint nearest;
    ASSERT_NEAR(distance.signed_distance(p, nearest), expected, 1e-14);
  }
}

/// What is said of it beforehand makes it sooner, not another; also where it is none.
TEST_F(Cull, TheNearestWhateverIsUsual) {
  const Surface surface = random_blob(host.memory, 6, 1);
  const TriangleTree tree(surface.points, surface.triangles, host.job, 4);
  points.assign(surface.points.begin(), surface.points.end());
  scatter(surface, 200);
  scatter_near(surface, 600);
  for (const Vec3 &p : points) {
    const NearestPoint plain = tree.nearest(p);
    const double distance2 = plain.distance * plain.distance;
    ASSERT_NEAR(plain.distance, brute_nearest(surface.points, surface.triangles, p).distance, 1e-12);
    for (double usual2 : {0.0, 0.5 * distance2, distance2, 2 * distance2, 1e9}) {
      const NearestPoint sooner = tree.nearest(p, usual2);
      ASSERT_EQ(sooner.triangle, plain.triangle) << usual2;
      ASSERT_EQ(sooner.distance, plain.distance) << usual2;
    }
    for (std::int32_t first : {-1, 0, plain.triangle}) {
      std::int32_t near = first;
      EXPECT_EQ(tree.is_within(p, 0.99 * distance2, near), plain.distance == 0);
      EXPECT_TRUE(tree.is_within(p, 1.01 * distance2, near));
      EXPECT_LE(TriangleInSpace(surface.points, surface.triangles[std::size_t(near)]).distance2_to(p),
                1.01 * distance2);
    }
  }
}

TEST_F(Cull, ConvexAndRound) {
  expect_distances(sphere(host.memory, 6));
  expect_distances(torus(host.memory, 20, 12));
  Surface hollow = sphere(host.memory, 6);
  append(hollow, sphere(host.memory, 5, 0.9), true);
  expect_distances(hollow);
}

TEST_F(Cull, RandomBlobs) {
  for (unsigned seed = 0; seed < 4; seed++) expect_distances(random_blob(host.memory, 6, seed));
}

TEST_F(Cull, AnL) {
  const Mesh mesh = kuhn_solid({2, 2, 1}, [](const Cell &c) { return !(c[0] == 1 && c[1] == 1); });
  expect_distances(surface_of(mesh, host.job));
}

TEST_F(Cull, AThinSlot) {
  for (double width : {1e-2, 1e-5}) {
    Mesh mesh = kuhn_solid({3, 3, 2}, [](const Cell &c) { return !(c[0] == 1 && c[1] > 0); });
    transform(mesh, [width](const Vec3 &p) { return Vec3(p.x <= 1 ? p.x : p.x - 1 + width, p.y, p.z); });
    const Surface surface = surface_of(mesh, host.job);
    points.clear();
    std::uniform_real_distribution<double> across(-2 * width, 3 * width), along(0, 3);
    for (int i = 0; i < 500; i++) points.push_back(Vec3(1 + across(random), along(random), 0.7 * along(random)));
    scatter_near(surface, 1500);
    expect_distances(surface, 8);
  }
}

TEST_F(Cull, SharpSpikes) {
  const Surface surface = spiky_star(host.memory, 6);
  ASSERT_TRUE(crossings(surface, host.memory).empty());
  expect_distances(surface);
}

/// Needles: the nearest point is a tip or a very sharp edge for most of space.
TEST_F(Cull, ANeedle) {
  for (double width : {1e-1, 1e-4}) {
    Surface surface(host.memory);
    surface.points = {Vec3(0, 0, 1), Vec3(width, 0, 0), Vec3(-width, width, 0), Vec3(-width, -width, 0)};
    for (const Triangle &t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 1}, Triangle{1, 3, 2}})
      surface.triangles.push_back(t);
    points.clear();
    std::uniform_real_distribution<double> uniform(-1.2 * width, 1.2 * width), up(-0.1, 1.1);
    for (int i = 0; i < 2000; i++) points.push_back(Vec3(uniform(random), uniform(random), up(random)));
    scatter_near(surface, 1000);
    expect_distances(surface, 1);
  }
}

TEST_F(Cull, SolidsThatTouch) {
  for (const Vec3 &step : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    Surface surface = box(host.memory, 3);
    append(surface, box(host.memory, 3, step, step + Vec3(1)));
    expect_distances(welded(host.memory, surface));
  }
  for (unsigned seed = 0; seed < 4; seed++) expect_distances(surface_of(random_solid(4, 0.5, seed), host.job));
}

TEST_F(Cull, LeavesDoNotMatter) {
  const Surface surface = random_blob(host.memory, 8, 9);
  scatter(surface, 300);
  scatter_near(surface, 300);
  for (std::int64_t leaf : {1, 8, 200, 100000}) expect_distances(surface, leaf);
}

// The rule

/// min_distance is above what a triangle's height asks for, so that it alone decides.
TEST_F(Cull, KeepsWhatIsInsideAndFarEnough) {
  const Surface surface = random_blob(host.memory, 8, 2);
  const SurfaceTopology topology = topology_of(surface);
  scatter(surface, 1500);
  std::vector<double> inside;  // negative: outside
  for (const Vec3 &p : points) {
    const double distance = brute_nearest(surface.points, surface.triangles, p).distance;
    inside.push_back(winding_number(surface.points, surface.triangles, p) > 0.5 ? distance : -distance);
  }
  for (double least : {0.02, 0.1, 0.4}) {
    std::vector<std::int32_t> expected;
    std::int64_t outside = 0;
    for (std::size_t i = 0; i < points.size(); i++) {
      ASSERT_GT(std::abs(inside[i] - least), 1e-9) << "take another seed";
      outside += inside[i] < 0;
      if (inside[i] >= least) expected.push_back(std::int32_t(i));
    }
    Array<std::int32_t> samples = all_samples();
    const CullReport report =
        cull_samples({points.data(), points.size()}, surface, topology, least, 200, host.job, samples);
    EXPECT_EQ(std::vector<std::int32_t>(samples.begin(), samples.end()), expected) << least;
    EXPECT_EQ(report.outside, outside);
    EXPECT_EQ(report.outside + report.too_near + std::int64_t(expected.size()), std::int64_t(points.size()));
    EXPECT_GT(expected.size(), 10u);
  }
}

/// Exactly as far as asked for is far enough; one rounding less is not.
TEST_F(Cull, MinDistanceIsExact) {
  const Surface surface = box(host.memory, 2);
  const SurfaceTopology topology = topology_of(surface);
  points = {Vec3(0.25, 0.5, 0.5), Vec3(std::nextafter(0.25, 0.0), 0.5, 0.5), Vec3(0.5, 0.5, 0.75),
            Vec3(-0.5, 0.5, 0.5)};
  Array<std::int32_t> samples = all_samples();
  const CullReport report =
      cull_samples({points.data(), points.size()}, surface, topology, 0.25, 200, host.job, samples);
  EXPECT_EQ(std::vector<std::int32_t>(samples.begin(), samples.end()), (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(report.outside, 1);
  EXPECT_EQ(report.too_near, 1);
}

/// One that may be near stays however near it is, but not outside.
TEST_F(Cull, SomeMayBeNear) {
  const Surface surface = box(host.memory, 2);
  const SurfaceTopology topology = topology_of(surface);
  points = {Vec3(1e-3, 0.3, 0.4), Vec3(1e-3, 0.6, 0.4), Vec3(-0.1, 0.5, 0.5), Vec3(0.5, 0.5, 0.6)};
  const std::vector<std::uint8_t> near = {1, 0, 1, 0};
  Array<std::int32_t> samples = all_samples();
  const CullReport report = cull_samples({points.data(), points.size()}, surface, topology, 0.1, 200, host.job, samples,
                                         {near.data(), near.size()});
  EXPECT_EQ(std::vector<std::int32_t>(samples.begin(), samples.end()), (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(report.outside, 1);
  EXPECT_EQ(report.too_near, 1);
}

/// Without a distance asked for, a sample on the surface or a rounding from it goes all the same; others stay.
TEST_F(Cull, NeverOnTheSurface) {
  const Surface surface = box(host.memory, 2);
  const SurfaceTopology topology = topology_of(surface);
  for (double x : {0.0, 1e-15, 1e-9, 0.1}) points.push_back(Vec3(x, 0.3, 0.4));
  Array<std::int32_t> samples = all_samples();
  cull_samples({points.data(), points.size()}, surface, topology, 0, 200, host.job, samples);
  EXPECT_EQ(std::vector<std::int32_t>(samples.begin(), samples.end()), std::vector<std::int32_t>{3});
}

TEST_F(Cull, ThreadsDoNotMatter) {
  const Surface surface = random_blob(host.memory, 8, 3);
  const SurfaceTopology topology = topology_of(surface);
  scatter(surface, 5000);
  Host two(2);
  Array<std::int32_t> one = all_samples(), other = all_samples();
  const CullReport a = cull_samples({points.data(), points.size()}, surface, topology, 0.05, 200, host.job, one);
  const CullReport b = cull_samples({points.data(), points.size()}, surface, topology, 0.05, 200, two.job, other);
  EXPECT_TRUE(std::equal(one.begin(), one.end(), other.begin(), other.end()));
  EXPECT_EQ(a.outside, b.outside);
  EXPECT_EQ(a.too_near, b.too_near);
}

}  // namespace
}  // namespace tetlod
