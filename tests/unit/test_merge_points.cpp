// Points at one place, or near each other, become one.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "merge_points.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

class MergePoints : public testing::Test {
 protected:
  Host host;
  std::vector<Vec3> points;
  std::vector<std::uint8_t> used;
  Array<std::int32_t> representative{&host.memory};

  std::int64_t merge(double tolerance) {
    if (used.empty()) used.assign(points.size(), 1);
    return merge_points({points.data(), points.size()}, {used.data(), used.size()}, tolerance, host.job,
                        representative);
  }

  void expect(const std::vector<std::int32_t> &expected) {
    EXPECT_EQ(std::vector<std::int32_t>(representative.begin(), representative.end()), expected);
  }

  /// In the order of their numbers, every point joins the lowest one that stays and is near enough.
  std::vector<std::int32_t> brute_force(double tolerance) const {
    std::vector<std::int32_t> joined(points.size());
    for (std::size_t i = 0; i < points.size(); i++) {
      joined[i] = std::int32_t(i);
      for (std::size_t j = 0; used[i] && j < i && joined[i] == std::int32_t(i); j++)
        if (used[j] && joined[j] == std::int32_t(j) &&
            (points[i] == points[j] || glm::dot(points[i] - points[j], points[i] - points[j]) <= tolerance * tolerance))
          joined[i] = std::int32_t(j);
    }
    return joined;
  }
};

TEST_F(MergePoints, SameCoordinates) {
  points = {Vec3(1, 2, 3), Vec3(0.0), Vec3(1, 2, 3), Vec3(-0.0), Vec3(1, 2, std::nextafter(3.0, 4.0)), Vec3(1, 2, 3)};
  EXPECT_EQ(merge(0), 3);
  expect({0, 1, 0, 1, 4, 0});
}

TEST_F(MergePoints, UnusedStayOut) {
  points.assign(4, Vec3(1));
  used = {0, 1, 0, 1};
  EXPECT_EQ(merge(0), 1);
  expect({0, 1, 2, 1});
  EXPECT_EQ(merge(0.1), 1);
  expect({0, 1, 2, 1});
}

/// Of points that no tet uses the coordinates may be anything.
TEST_F(MergePoints, ATinyToleranceTakesNoLonger) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  points.push_back(Vec3(std::numeric_limits<double>::infinity()));
  used.assign(points.size(), 1);
  used.back() = 0;
  const auto seconds = [&](double tolerance) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(merge(tolerance), 0);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double usual = seconds(1e-9);
  EXPECT_LT(seconds(1e-312), 10 * usual);
}

/// Where coordinates are large the points are as far from each other as elsewhere.
TEST_F(MergePoints, FarFromTheOriginItTakesNoLonger) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  const auto seconds = [&] {
    const auto begin = std::chrono::steady_clock::now();
    merge(1e-3);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const double usual = seconds();
  for (Vec3 &p : points) p += 1e12;
  EXPECT_LT(seconds(), 10 * usual);
  expect(brute_force(1e-3));
}

TEST_F(MergePoints, ChainsDoNotCollapse) {
  for (int i = 0; i < 6; i++) points.push_back(Vec3(0.9 * i, 0, 0));
  EXPECT_EQ(merge(1), 3);
  expect({0, 0, 2, 2, 4, 4});
}

TEST_F(MergePoints, AgainstBruteForce) {
  std::mt19937_64 random(1);
  for (double tolerance : {0.0, 1e-312, 0.02, 0.1, 0.4, 5.0})
    for (double shift : {0.0, -0.5, 1000.0}) {
      std::uniform_real_distribution<double> uniform(shift, shift + 1);
      points.clear();
      for (int i = 0; i < 400; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
      for (int i = 0; i < 100; i++) points[random() % 400] = points[random() % 400];
      used.assign(points.size(), 1);
      for (int i = 0; i < 20; i++) used[random() % 400] = 0;
      const std::vector<std::int32_t> expected = brute_force(tolerance);
      std::int64_t count = 0;
      for (std::size_t i = 0; i < expected.size(); i++) count += expected[i] != std::int32_t(i);
      EXPECT_EQ(merge(tolerance), count);
      EXPECT_GT(count, 10);
      expect(expected);
    }
}

/// Others have no cells of their own then; nor beside so large a rounding.
TEST_F(MergePoints, OneMayBeFarAway) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 200000; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  points.push_back(points[17]);
  points.push_back(Vec3(1e12));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(merge(0), 1);
  EXPECT_EQ(merge_rounded({points.data(), points.size()}, {used.data(), used.size()}, 1e-3, host.job, representative),
            -1);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 2);
}

TEST_F(MergePoints, Rounded) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 3000; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  for (int i = 0; i < 2000; i++) {
    const Vec3 off(uniform(random), uniform(random), uniform(random));
    points.push_back(points[random() % points.size()] + 1e-12 * off);
  }
  used.assign(points.size(), 1);
  const auto merged =
      merge_rounded({points.data(), points.size()}, {used.data(), used.size()}, 1e-12, host.job, representative);
  EXPECT_GT(merged, 0);
  expect(brute_force(1e-12));
}

}  // namespace
}  // namespace tetlod
