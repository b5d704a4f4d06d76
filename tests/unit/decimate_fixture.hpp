// A surface, what decimation makes of it, and what has to hold whatever was asked for.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "brute_force.hpp"
#include "decimate_and_check.hpp"
#include "geometry.hpp"
#include "meshes.hpp"
#include "remesh_surfaces.hpp"

namespace tetlod {

using namespace test;

class Decimate : public testing::Test {
 protected:
  Host host;
  Surface original{host.memory}, result{host.memory};
  SurfaceTopology topology{host.memory};
  std::vector<std::uint8_t> locked;
  DecimateReport report;

  /// Origins are numbered as points.
  void start_with(Surface &&surface) {
    original = std::move(surface);
    complete(original, [](const Vec3 &p) { return p.x + 2 * p.y; });
    locked.clear();
    topology = SurfaceTopology(host.memory);
    find_topology(original.points, original.triangles, host.job, topology);
    ASSERT_TRUE(crossings(original, host.memory).empty()) << "the test's own surface crosses itself";
  }

  void decimate(const DecimateOptions &options) {
    result = original;
    report = decimate_boundary(result, topology, {locked.data(), locked.size()}, options, host.job);
  }
  void decimate(double sigma, double lambda = 0.1) { decimate(DecimateOptions{sigma, lambda, 0}); }

  double volume() const { return volume_inside(result.points, result.triangles); }
  double relative_volume() const { return volume() / volume_inside(original.points, original.triangles); }

  /// All that has to hold, whatever was asked for.
  void expect_sound() {
    const SurfaceFacts before = facts_of(original.triangles), after = facts_of(result.triangles);
    EXPECT_TRUE(after.closed);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_LE(after.nonmanifold_edges, before.nonmanifold_edges);
    EXPECT_EQ(after.vertices, std::int64_t(result.points.size())) << "points that no triangle uses";
    EXPECT_TRUE(crossings(result, host.memory).empty());
    EXPECT_EQ(report.edges_in, std::int64_t(3 * original.triangles.size() / 2));
    EXPECT_EQ(report.edges_out, std::int64_t(3 * result.triangles.size() / 2));
    ASSERT_EQ(result.scalars.size(), result.points.size());
    ASSERT_EQ(result.origin.size(), result.points.size());
    const auto [low, high] = std::minmax_element(original.scalars.begin(), original.scalars.end());
    for (double s : result.scalars) EXPECT_TRUE(s >= *low && s <= *high) << "a value beyond the range";
    for (std::size_t i = 0; i < result.points.size(); i++)
      if (result.origin[i] >= 0) expect_untouched(i);
    expect_areas();
  }

  void expect_untouched(std::size_t i) const {
    const auto v = std::size_t(result.origin[i]);
    EXPECT_EQ(std::memcmp(&result.points[i], &original.points[v], sizeof(Vec3)), 0);
    EXPECT_EQ(result.scalars[i], original.scalars[v]);
  }

  void expect_areas() const {
    for (const Triangle &t : result.triangles)
      EXPECT_GT(triangle_quality(result.points[std::size_t(t[0])], result.points[std::size_t(t[1])],
                                 result.points[std::size_t(t[2])]),
                0.0);
  }

  void expect_stays(std::size_t v) const {
    const auto found = std::find(result.origin.begin(), result.origin.end(), std::int32_t(v));
    ASSERT_NE(found, result.origin.end()) << "vertex " << v << " is gone";
    expect_untouched(std::size_t(found - result.origin.begin()));
  }

  /// Of either surface from the other, at its vertices, or also at the middles of its edges and triangles.
  double brute_deviation(bool between) const {
    double largest = 0;
    const auto look = [&](const Vec3 &p, const Surface &from) {
      largest = std::max(largest, brute_nearest(from.points, from.triangles, p).distance);
    };
    const auto look_at_all = [&](const Surface &of, const Surface &from) {
      for (const Vec3 &p : of.points) look(p, from);
      for (const Triangle &t : of.triangles) {
        if (!between) continue;
        const auto corner = [&](std::size_t k) { return of.points[std::size_t(t[k % 3])]; };
        look((corner(0) + corner(1) + corner(2)) / 3.0, from);
        for (std::size_t k = 0; k < 3; k++) look((corner(k) + corner(k + 1)) / 2.0, from);
      }
    };
    look_at_all(original, result);
    look_at_all(result, original);
    return largest;
  }

  bool reaches(double sigma) const { return double(report.edges_out) <= std::ceil(sigma * double(report.edges_in)); }
};

}  // namespace tetlod
