// 3.5  Values of the original field at other points: linear inside, the nearest boundary's outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "brute_force.hpp"
#include "extract_boundary.hpp"
#include "interpolate.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

class Interpolate : public testing::Test {
 protected:
  Host host;
  std::mt19937_64 random{1};
  Mesh mesh;
  std::vector<Vec3> points;

  Array<double> values(std::int64_t leaf, Host &with) {
    Boundary boundary(with.memory);
    extract_boundary(mesh.view(), with.job, boundary);
    Array<double> result(&with.memory);
    interpolate(mesh.view(), boundary.triangles, {points.data(), points.size()}, leaf, with.job, result);
    return result;
  }
  Array<double> values(std::int64_t leaf = 500) { return values(leaf, host); }

  void scatter(int count, double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    for (int i = 0; i < count; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  }

  void expect_field(const Array<double> &values, const Field &field, double tolerance) {
    ASSERT_EQ(values.size(), points.size());
    for (std::size_t i = 0; i < points.size(); i++)
      ASSERT_NEAR(values[i], field(points[i]), tolerance) << points[i].x << " " << points[i].y << " " << points[i].z;
  }
};

double linear(const Vec3 &p) { return 1 + 2 * p.x - 3 * p.y + 0.5 * p.z; }

TEST_F(Interpolate, LinearFieldsAreExact) {
  mesh = kuhn_cube(6);
  shuffle(mesh, 1);
  set_scalars(mesh, linear);
  scatter(2000, 0, 1);
  for (std::int64_t leaf : {1, 8, 500, 100000}) expect_field(values(leaf), linear, 1e-12);
}

TEST_F(Interpolate, LinearFieldsOnAnyTets) {
  mesh = kuhn_cube(6);
  transform(mesh, [](const Vec3 &p) {  // the inner points moved
    const double inside = 64 * p.x * (1 - p.x) * p.y * (1 - p.y) * p.z * (1 - p.z);
    return p + 0.04 * inside * Vec3(std::sin(9 * p.y), std::sin(8 * p.z), std::cos(7 * p.x));
  });
  set_scalars(mesh, linear);
  scatter(2000, 0, 1);
  expect_field(values(), linear, 1e-12);
}

TEST_F(Interpolate, AtVerticesEdgesAndFaces) {
  mesh = kuhn_cube(5);
  set_scalars(mesh, linear);
  points = mesh.points;
  for (const Tet &t : mesh.tets) {
    const auto at = [&](std::size_t k) { return mesh.points[std::size_t(t[k])]; };
    points.push_back(0.5 * (at(0) + at(1)));
    points.push_back((at(1) + at(2) + at(3)) / 3.0);
  }
  expect_field(values(), linear, 1e-12);
}

TEST_F(Interpolate, OnlyOnePiece) {
  mesh = kuhn_cube(4);
  set_scalars(mesh, [](const Vec3 &p) { return p.x > 0.9 ? 1 : 0; });
  scatter(1000, 0, 1);
  expect_field(
      values(), [](const Vec3 &p) { return std::max(0.0, 4 * p.x - 3); }, 1e-12);
}

/// Outside, and inside a cavity: what the field is at the nearest point of the boundary.
TEST_F(Interpolate, OutsideTakesTheNearestOfTheBoundary) {
  mesh = kuhn_solid({5, 5, 5}, [](const Cell &c) { return c != Cell{2, 2, 2}; });
  set_scalars(mesh, linear);
  scatter(500, -3, 8);
  scatter(200, 2, 3);
  Boundary boundary(host.memory);
  extract_boundary(mesh.view(), host.job, boundary);
  const Array<double> found = values();
  int outside = 0;
  for (std::size_t i = 0; i < points.size(); i++) {
    const Span<const Vec3> corners{mesh.points.data(), mesh.points.size()};
    const bool inside = winding_number(corners, boundary.triangles, points[i]) > 0.5;
    const Vec3 at = inside ? points[i] : brute_nearest(corners, boundary.triangles, points[i]).point;
    ASSERT_NEAR(found[i], linear(at), 1e-11);
    outside += !inside;
  }
  EXPECT_GT(outside, 400);
}

/// A rounding out of the solid makes no difference that could be seen.
TEST_F(Interpolate, RoundingOutside) {
  mesh = kuhn_cube(4);
  set_scalars(mesh, linear);
  scatter(500, 0, 1);
  for (std::size_t i = 0; i < points.size(); i++) points[i][int(i % 3)] = i % 2 ? -1e-13 : 1 + 1e-13;
  const Array<double> found = values();
  expect_field(found, linear, 1e-11);
  const auto [low, high] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
  for (double value : found) EXPECT_TRUE(value >= *low && value <= *high);
}

TEST_F(Interpolate, StaysWithinTheRange) {
  mesh = random_solid(5, 0.6, 1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double &s : mesh.scalars) s = uniform(random);
  scatter(3000, -1, 6);
  const auto [low, high] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
  for (double value : values()) ASSERT_TRUE(value >= *low && value <= *high);
}

/// A mean of equal values may round beyond them; the range is kept to the last bit, inside and outside.
TEST_F(Interpolate, ConstantValuesStayWhatTheyAre) {
  mesh = kuhn_cube(5);
  scatter(3000, -0.2, 1.2);
  for (double constant : {913.1500244140625, 0.1, -1.0 / 3, 3.3144460104e-07}) {
    set_scalars(mesh, [constant](const Vec3 &) { return constant; });
    for (double value : values()) ASSERT_EQ(value, constant);
  }
}

/// Flat tets are in real meshes. They hold no point and must not answer for one, wherever their box reaches.
TEST_F(Interpolate, FlatTetsAnswerNothing) {
  mesh = kuhn_solid({4, 4, 4}, [](const Cell &) { return true; });
  // Sheared, so that the planes of the lattice are oblique and the boxes of flat tets have a volume; integers, so that
  // flat is exactly flat.
  transform(mesh, [](const Vec3 &p) { return Vec3(p.x + p.z, p.y + p.z, p.z + p.x + p.y); });
  set_scalars(mesh, linear);
  const std::vector<Tet> good = mesh.tets;
  std::vector<Tet> flat;
  for (std::size_t cell = 0; cell < good.size(); cell += 6) {  // the four corners of a square of the cell
    const Tet &t = good[cell];
    const auto at = [&](std::size_t k) { return mesh.points[std::size_t(t[k])]; };
    const auto fourth = std::find(mesh.points.begin(), mesh.points.end(), at(0) + at(2) - at(1));
    ASSERT_NE(fourth, mesh.points.end());
    flat.push_back({t[0], t[1], t[2], std::int32_t(fourth - mesh.points.begin())});
  }
  for (const Tet &t : good) {
    const auto at = [&](std::size_t k) { return mesh.points[std::size_t(t[k])]; };
    points.push_back(0.25 * (at(0) + at(1) + at(2) + at(3)));
    points.push_back(0.5 * (at(0) + at(3)));
  }
  Boundary boundary(host.memory);
  extract_boundary(mesh.view(), host.job, boundary);
  for (bool first : {false, true}) {
    mesh.tets = first ? flat : good;
    mesh.tets.insert(mesh.tets.end(), (first ? good : flat).begin(), (first ? good : flat).end());
    Array<double> found(&host.memory);
    interpolate(mesh.view(), boundary.triangles, {points.data(), points.size()}, 500, host.job, found);
    expect_field(found, linear, 1e-11);
  }
}

TEST_F(Interpolate, ThreadsAndLeavesDoNotMatter) {
  mesh = kuhn_cube(8);
  set_scalars(mesh, [](const Vec3 &p) { return std::sin(7 * p.x) * p.y + p.z; });
  scatter(5000, -0.1, 1.1);
  const Array<double> one = values(500);
  Host two(2);
  const Array<double> other = values(500, two);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(double)), 0);
  for (std::int64_t leaf : {1, 8}) {
    const Array<double> again = values(leaf);
    for (std::size_t i = 0; i < one.size(); i++) ASSERT_NEAR(again[i], one[i], 1e-11);
  }
}

TEST_F(Interpolate, NoPoints) {
  mesh = kuhn_cube(1);
  EXPECT_TRUE(values().empty());
}

}  // namespace
}  // namespace tetlod
