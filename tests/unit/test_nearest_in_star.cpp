// How far a vertex can go among its tets.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "geometry.hpp"
#include "nearest_in_star.hpp"

namespace tetlod {
namespace {

/// Four tets around the origin, which is vertex 0, in a regular one.
class NearestInStar : public testing::Test {
 protected:
  bool find(Vec3 &p) const { return nearest_in_star({tets.data(), tets.size()}, 0, {points.data(), points.size()}, p); }
  double least_height(const Vec3 &p) const {
    double least = 1;
    for (const Tet &t : tets) {
      const Vec3 a = at(t[1]), normal = glm::cross(at(t[2]) - a, at(t[3]) - a);
      least = std::min(least, glm::dot(normal, p - a) / glm::dot(normal, -a));
    }
    return least;
  }
  const Vec3 &at(std::int32_t v) const { return points[std::size_t(v)]; }

  std::vector<Vec3> points = {{0, 0, 0}, {1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  std::vector<Tet> tets = {{0, 1, 2, 3}, {0, 1, 4, 2}, {0, 1, 3, 4}, {0, 2, 4, 3}};
};

TEST_F(NearestInStar, WhereAllTetsStayPositiveItGoesThere) {
  Vec3 p(0.1, -0.05, 0.02);
  ASSERT_TRUE(find(p));
  EXPECT_EQ(p, Vec3(0.1, -0.05, 0.02));
}

TEST_F(NearestInStar, ElseItStopsShortOfTheFace) {
  for (const Vec3 &to : {Vec3(-0.5, -0.5, -0.5), Vec3(-3, -2, -4), Vec3(0.9, 0.9, -0.9), Vec3(0, 0, 2)}) {
    Vec3 p = to;
    ASSERT_TRUE(find(p));
    EXPECT_GT(least_height(p), 0);
    EXPECT_LT(least_height(p), 0.7);
    EXPECT_LT(glm::length(p - to), glm::length(to));
  }
}

/// A flat tet lets it go along its face, and away from it, to the other side of which it cannot.
TEST_F(NearestInStar, AFlatTetGetsNoFlatter) {
  points[0] = Vec3(1e-9) - (at(2) + at(3) + at(4)) / -3.0;
  const double before = least_height(points[0]);
  Vec3 p = points[0] + Vec3(-0.2, 0.1, 0.05);
  ASSERT_TRUE(find(p));
  EXPECT_GE(least_height(p), before * (1 - 1e-6));
  EXPECT_GT(glm::length(p - points[0]), 0.1);
}

TEST_F(NearestInStar, IsNowhereBetweenFacesThatLeaveNoRoom) {
  // Of two faces, each on the wrong side of the other, the vertex is on the right side of both only where it is.
  points = {{0, 0, 0}, {1, 0, -1e-3}, {0, 1, -1e-3}, {-1, -1, -1e-3}, {1, 0, 1e-3}, {0, 1, 1e-3}, {-1, -1, 1e-3}};
  tets = {{0, 1, 3, 2}, {0, 4, 5, 6}};
  Vec3 p(0, 0, 5);
  const bool found = find(p);
  EXPECT_TRUE(!found || std::abs(p.z) < 1e-3);
}

TEST_F(NearestInStar, AFaceWithoutANormalAsksForNothing) {
  points[1] = points[2] = points[3] = {1, 1, 1};
  tets.resize(1);
  Vec3 p(7, 8, 9);
  EXPECT_TRUE(find(p));
  EXPECT_EQ(p, Vec3(7, 8, 9));
}

}  // namespace
}  // namespace tetlod
