// Predicates: the sign is that of exact arithmetic, whatever rounding would have made of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "exact.hpp"
#include "predicates.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Moves a coordinate by up to `most` units in the last place.
double nudged(double x, int most, std::mt19937_64 &random) {
  const int steps = std::uniform_int_distribution<int>(-most, most)(random);
  for (int i = 0; i < std::abs(steps); i++) x = std::nextafter(x, steps > 0 ? 1e9 : -1e9);
  return x;
}

Vec3 nudged(const Vec3 &p, int most, std::mt19937_64 &random) {
  return {nudged(p.x, most, random), nudged(p.y, most, random), nudged(p.z, most, random)};
}

Vec3 random_point(double extent, std::mt19937_64 &random) {
  std::uniform_real_distribution<double> uniform(-extent, extent);
  return {uniform(random), uniform(random), uniform(random)};
}

/// Every even permutation keeps the sign and every odd one turns it round.
void expect_orientation(const Vec3 *p) {
  const int expected = exact_orientation(p[0], p[1], p[2], p[3]);
  int order[4] = {0, 1, 2, 3};
  do {
    int inversions = 0;
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < i; j++) inversions += order[j] > order[i];
    const int sign = orientation(p[order[0]], p[order[1]], p[order[2]], p[order[3]]);
    ASSERT_EQ(sign, inversions % 2 ? -expected : expected);
  } while (std::next_permutation(order, order + 4));
}

TEST(ExactArithmetic, IsExactItself) {
  EXPECT_EQ((Wide(3.0) * Wide(-5.0) + Wide(7.0) * Wide(2.0)).sign(), -1);
  EXPECT_EQ((Wide(3.0) * Wide(-5.0) + Wide(7.5) * Wide(2.0)).sign(), 0);
  EXPECT_EQ((Wide(0x1p60) - Wide(0x1p60) + Wide(0x1p-99)).sign(), 1);
  EXPECT_EQ((Wide(0.1) + Wide(0.2) - Wide(0.3)).sign(), 1);  // of the doubles, not of the decimals
  const Vec3 o(0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(exact_orientation(o, x, y, z), 1);
  EXPECT_EQ(exact_orientation(o, y, x, z), -1);
  EXPECT_EQ(exact_turn(o, x, y, 0, 1), 1);
}

TEST(Orientation, OfTheUnitTet) {
  const Vec3 o(0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(orientation(o, x, y, z), 1);
  EXPECT_EQ(orientation(o, y, x, z), -1);
  EXPECT_EQ(orientation(o, x, y, Vec3(0.3, 0.4, 0)), 0);
}

TEST(Orientation, OfRandomPoints) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; i++) {
    const Vec3 p[4] = {random_point(1, random), random_point(1, random), random_point(1, random),
                       random_point(1, random)};
    ASSERT_NO_FATAL_FAILURE(expect_orientation(p));
  }
}

TEST(Orientation, NearlyInOnePlane) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 2);
  int differs_from_rounded = 0;
  for (int i = 0; i < 3000; i++) {
    const Vec3 a = random_point(1, random), b = random_point(1, random), c = random_point(1, random);
    const double s = uniform(random), t = uniform(random);
    const Vec3 p[4] = {a, b, c, nudged(a + s * (b - a) + t * (c - a), 2, random)};
    ASSERT_NO_FATAL_FAILURE(expect_orientation(p));
    const int exact = exact_orientation(p[0], p[1], p[2], p[3]);
    const double rounded = glm::dot(glm::cross(b - a, c - a), p[3] - a);
    differs_from_rounded += exact != (rounded > 0) - (rounded < 0);
  }
  EXPECT_GT(differs_from_rounded, 100) << "the points are not near enough to a plane to test anything";
}

TEST(Orientation, ExactlyInOnePlaneOfALattice) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::int64_t> large(-(std::int64_t(1) << 40), std::int64_t(1) << 40), small(-500, 500),
      tiny(-1, 1);
  int zeros = 0;
  for (int i = 0; i < 3000; i++) {
    const Vec3 a(double(large(random)), double(large(random)), double(large(random)));
    const Vec3 u(double(large(random) >> 10), double(large(random) >> 10), double(large(random) >> 10));
    const Vec3 v(double(large(random) >> 10), double(large(random) >> 10), double(large(random) >> 10));
    Vec3 d = a + double(small(random)) * u + double(small(random)) * v;
    const bool moved = i % 2 == 1;
    if (moved) d += Vec3(double(tiny(random)), double(tiny(random)), double(tiny(random)));
    const Vec3 p[4] = {a, a + u, a + v, d};
    ASSERT_NO_FATAL_FAILURE(expect_orientation(p));
    ASSERT_TRUE(moved || orientation(p[0], p[1], p[2], p[3]) == 0);
    zeros += !moved;
  }
  EXPECT_EQ(zeros, 1500);
}

/// Differences that do not fit a double: large and tiny coordinates together.
TEST(Orientation, OfCoordinatesOfDifferentSize) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<int> exponent(-40, 40);
  for (int i = 0; i < 2000; i++) {
    Vec3 p[4];
    for (Vec3 &q : p)
      for (int k = 0; k < 3; k++) q[k] = std::ldexp(std::floor(random_point(1024, random).x), exponent(random));
    p[3] = i % 2 ? p[3] : p[0] + 0.5 * (p[1] - p[0]) + 0.25 * (p[2] - p[0]);
    ASSERT_NO_FATAL_FAILURE(expect_orientation(p));
  }
}

TEST(Orientation, NearADiagonalGrid) {
  const Vec3 b(12, 12, 0), c(24, 24, 0), top(20, 20, 12);  // a plane x = y, and points beside it
  for (int i = 0; i < 32; i++)
    for (int j = 0; j < 32; j++) {
      const Vec3 p[4] = {{0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, 0}, b, c, top};
      ASSERT_NO_FATAL_FAILURE(expect_orientation(p));
      ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]) == 0, i == j);
    }
}

TEST(Turn, IsExact) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-2, 2);
  int differs_from_rounded = 0;
  for (int i = 0; i < 20000; i++) {
    const Vec3 a = random_point(1, random), b = random_point(1, random);
    const Vec3 c = i % 4 == 0 ? random_point(1, random) : nudged(a + uniform(random) * (b - a), 2, random);
    for (int x = 0; x < 3; x++) {
      const int y = (x + 1) % 3, expected = exact_turn(a, b, c, x, y);
      ASSERT_EQ(turn(a, b, c, x, y), expected);
      ASSERT_EQ(turn(b, c, a, x, y), expected);
      ASSERT_EQ(turn(b, a, c, x, y), -expected);
      ASSERT_EQ(turn(a, b, c, y, x), -expected);
      const double rounded = (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
      differs_from_rounded += expected != (rounded > 0) - (rounded < 0);
    }
  }
  EXPECT_GT(differs_from_rounded, 100);
}

// Two triangles

struct Pair {
  Vec3 first[3], second[3];
  Triangle first_ids{0, 1, 2}, second_ids{3, 4, 5};
};

bool has_area(const Vec3 *t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) > 0.5; }

/// Corners on a lattice of small numbers; `common` of them are the same vertices, at any corner.
Pair random_pair(int common, int extent, bool coplanar, std::mt19937_64 &random) {
  std::uniform_int_distribution<int> uniform(0, extent);
  const bool tilted = uniform(random) % 2 == 0;
  const auto point = [&] {
    const int x = uniform(random), y = uniform(random), z = uniform(random);
    return Vec3(x, y, !coplanar ? z : tilted ? 2 * x - y : 0);
  };
  Pair pair;
  for (Vec3 &p : pair.first) p = point();
  for (Vec3 &p : pair.second) p = point();
  std::array<std::size_t, 3> at{0, 1, 2}, to{0, 1, 2};
  std::shuffle(at.begin(), at.end(), random);
  std::shuffle(to.begin(), to.end(), random);
  for (std::size_t k = 0; k < std::size_t(common); k++) {
    pair.second[to[k]] = pair.first[at[k]];
    pair.second_ids[to[k]] = pair.first_ids[at[k]];
  }
  return pair;
}

std::string describe(const Pair &pair) {
  std::string text;
  for (const auto &t : {pair.first, pair.second})
    for (int k = 0; k < 3; k++)
      text += "(" + std::to_string(int(t[k].x)) + " " + std::to_string(int(t[k].y)) + " " +
              std::to_string(int(t[k].z)) + ") ";
  for (std::int32_t id : pair.second_ids) text += std::to_string(id) + " ";
  return text;
}

bool apart(const Pair &p) { return triangles_apart(p.first, p.first_ids, p.second, p.second_ids); }
bool apart_turned(const Pair &p) { return triangles_apart(p.second, p.second_ids, p.first, p.first_ids); }

void compare_with_brute_force(int common, int extent, bool coplanar, int pairs) {
  std::mt19937_64 random(unsigned(100 * common + 10 * extent + coplanar));
  int answers[2] = {0, 0};
  for (int i = 0; i < pairs; i++) {
    const Pair pair = random_pair(common, extent, coplanar, random);
    if (!has_area(pair.first) || !has_area(pair.second)) continue;
    const bool expected = brute_apart(pair.first, pair.first_ids, pair.second, pair.second_ids);
    answers[expected]++;
    ASSERT_EQ(apart(pair), expected) << describe(pair);
    ASSERT_EQ(apart_turned(pair), expected) << describe(pair);
  }
  EXPECT_GT(answers[0], pairs / 100) << "hardly any that meet";
  EXPECT_GT(answers[1], pairs / 100) << "hardly any that are apart";
}

TEST(TrianglesApart, NoCommonVertex) {
  for (int extent : {2, 4, 9}) compare_with_brute_force(0, extent, false, 20000);
}
TEST(TrianglesApart, OneCommonVertex) {
  for (int extent : {2, 4, 9}) compare_with_brute_force(1, extent, false, 20000);
}
TEST(TrianglesApart, TwoCommonVertices) {
  // Not of 9: hardly any pair there is coplanar, and hinges out of a plane are always open.
  compare_with_brute_force(2, 2, false, 20000);
}
TEST(TrianglesApart, InOnePlane) {
  for (int common : {0, 1, 2})
    for (int extent : {3, 6}) compare_with_brute_force(common, extent, true, 20000);
}

TEST(TrianglesApart, TheSameTriangleIsNot) {
  std::mt19937_64 random(7);
  const Pair pair = random_pair(3, 9, false, random);
  EXPECT_FALSE(apart(pair));
}

/// One without area: when it meets the other beyond the common vertices, that is seen.
TEST(TrianglesApart, NeverOverlooksATriangleWithoutArea) {
  std::mt19937_64 random(8);
  int meet = 0;
  for (int i = 0; i < 60000; i++) {
    Pair pair = random_pair(i % 3, 3, i % 2, random);
    const int k = int(random() % 3);
    pair.second[k] = 2.0 * pair.second[(k + 1) % 3] - pair.second[(k + 2) % 3];
    pair.second_ids[std::size_t(k)] = 9;
    if (!has_area(pair.first)) continue;
    if (brute_apart(pair.first, pair.first_ids, pair.second, pair.second_ids)) continue;
    meet++;
    ASSERT_FALSE(apart(pair)) << describe(pair);
    ASSERT_FALSE(apart_turned(pair)) << describe(pair);
  }
  EXPECT_GT(meet, 1000);
}

/// Touching at a place that is no lattice point, at every scale.
TEST(TrianglesApart, AtAnyScale) {
  for (double scale : {1e-30, 1e-3, 1.0, 1e20}) {
    const Vec3 first[3] = {scale * Vec3(0, 0, 0), scale * Vec3(1, 0, 0), scale * Vec3(0, 1, 0)};
    Vec3 second[3] = {scale * Vec3(0.25, 0.25, 0), scale * Vec3(0, 0, 1), scale * Vec3(1, 1, 1)};
    EXPECT_FALSE(triangles_apart(first, {0, 1, 2}, second, {3, 4, 5})) << scale;
    second[0].z = scale * 1e-18;
    EXPECT_TRUE(triangles_apart(first, {0, 1, 2}, second, {3, 4, 5})) << scale;
    second[0].z = -scale * 1e-18;
    EXPECT_FALSE(triangles_apart(first, {0, 1, 2}, second, {3, 4, 5})) << scale;
  }
}

}  // namespace
}  // namespace tetlod
