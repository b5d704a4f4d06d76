// The largest errors of a small mesh: found, lowered one after another, and gone when every vertex is served.
#include <gtest/gtest.h>

#include "adaptive_meshes.hpp"
#include "errors_outside.hpp"
#include "hold_bound.hpp"
#include "place_probes.hpp"

namespace tetlod {
namespace {

using namespace test;

/// `mesh` becomes the coarse one among the vertices of the original.
void put_among(const Mesh &original, const Mesh &coarse, bool project_outside, Host &host, AdaptiveMesh<1> &mesh) {
  adapt(coarse, host, mesh);
  ProbeOptions vertices;
  vertices.most_inner = 0;
  vertices.project_outside = project_outside;
  place_probes(original.view(), vertices, host.job, mesh);
}

/// A coarse cube among the vertices of a fine one.
class TheLargestError : public testing::Test {
 protected:
  TheLargestError() : original(kuhn_cube(8)), mesh(host.memory) {
    set_scalars(original,
                [](const Vec3 &p) { return std::sin(9 * p.x) * std::cos(7 * p.y) + std::exp(p.y + 2 * p.z); });
    put_among(original, kuhn_cube(2), false, host, mesh);
  }

  double largest() { return largest_error(mesh, host.job).value; }

  void expect_whole() {
    double volume = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); t++) {
      if (!mesh.alive(std::int32_t(t))) continue;
      const double own = det(mesh.corner(std::int32_t(t), 0), mesh.corner(std::int32_t(t), 1),
                             mesh.corner(std::int32_t(t), 2), mesh.corner(std::int32_t(t), 3));
      EXPECT_GT(own, 0);
      volume += own / 6;
    }
    EXPECT_NEAR(volume, 1, 1e-12);
  }

  Host host;
  Mesh original;
  AdaptiveMesh<1> mesh;
};

TEST_F(TheLargestError, IsLowerWithMoreTets) {
  double before = largest();
  for (std::int64_t tets : {100, 300, 900}) {
    lower_largest(tets, host.job, mesh);
    expect_whole();
    EXPECT_GT(std::int64_t(mesh.count()), tets - 3);
    EXPECT_LT(std::int64_t(mesh.count()), tets + 24);
    EXPECT_LT(largest(), 0.9 * before) << tets;
    before = largest();
  }
}

TEST_F(TheLargestError, IsNoneWhereEveryVertexIsServed) {
  lower_largest(1000000, host.job, mesh);
  expect_whole();
  EXPECT_LT(largest(), 1e-12);
  EXPECT_EQ(mesh.points.size(), original.points.size());
}

TEST_F(TheLargestError, StaysWithoutTetsForIt) {
  const double before = largest();
  lower_largest(std::int64_t(mesh.count()), host.job, mesh);
  EXPECT_EQ(largest(), before);
}

/// A vertex of value 1 beyond a corner of the mesh, whose value is 0: they count at the same point of the boundary.
class BeyondACorner : public testing::Test {
 protected:
  BeyondACorner() : cube(kuhn_cube(1)), original(cube), mesh(host.memory) {
    original.points.push_back({1.2, 1.2, 1.2});
    original.scalars.push_back(1);
    original.tets.push_back({number({1, 1, 1}), number({1, 0, 0}), number({1, 0, 1}), beyond()});
    put_among(original, cube, true, host, mesh);
  }
  std::int32_t number(const Vec3 &p) const {
    return std::int32_t(std::find(cube.points.begin(), cube.points.end(), p) - cube.points.begin());
  }
  std::int32_t beyond() const { return std::int32_t(cube.points.size()); }
  std::vector<std::int32_t> held_by(double bound) {
    const Array<std::int32_t> left = hold_bound(bound, host.job, mesh);
    return {left.begin(), left.end()};
  }

  Host host;
  const Mesh cube;
  Mesh original;
  AdaptiveMesh<1> mesh;
};

/// No value, and no vertex that is put on the boundary, makes both right: one of them is left.
TEST_F(BeyondACorner, NeedsAnotherBoundary) {
  const std::vector<std::int32_t> left = held_by(0.4);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE(left[0] == beyond() || left[0] == number({1, 1, 1}));
}

TEST_F(BeyondACorner, NeedsAnotherBoundaryWhereTheHostKeepsTheValue) {
  mesh.kept[std::size_t(number({1, 1, 1}))] = 1;
  EXPECT_EQ(held_by(0.6), std::vector<std::int32_t>{beyond()});
  EXPECT_EQ(held_by(2), std::vector<std::int32_t>{});
}

/// Where it serves both, and changes no further than that.
TEST_F(BeyondACorner, TakesAValueBetween) {
  const std::size_t tets = mesh.count();
  EXPECT_EQ(held_by(0.6), std::vector<std::int32_t>{});
  EXPECT_EQ(mesh.count(), tets);
  EXPECT_NEAR(mesh.values[std::size_t(number({1, 1, 1}))][0], 0.4, 1e-3);
  EXPECT_LE(largest_error(mesh, host.job).value, 0.6);
}

/// A tet's values, continued by a hair, may be others than those of the boundary there: of a sliver, or one to come.
TEST(PlaceProbes, TakesVerticesThatAreAHairOutsideToTheBoundary) {
  Host host;
  const Mesh cube = kuhn_cube(1);
  for (double hair : {1e-6, 1e-8, 1e-10, 1e-12}) {
    Mesh original = cube;
    original.points.push_back({0.3, 0.4, 1 + hair});
    original.scalars.push_back(1);
    original.tets.push_back({0, 1, 2, std::int32_t(cube.points.size())});
    AdaptiveMesh<1> mesh(host.memory);
    put_among(original, cube, true, host, mesh);
    const auto at = std::find(mesh.vertex_of_probe.begin(), mesh.vertex_of_probe.end(), original.tets.back()[3]);
    ASSERT_NE(at, mesh.vertex_of_probe.end());
    EXPECT_LE(mesh.probes[std::size_t(at - mesh.vertex_of_probe.begin())].point.z, 1) << hair;
  }
}

/// A wall of value 0 at z = 0, a vertex `beneath` it of value 1, which makes a sliver there, and an original vertex of
/// value 0 a hair above the two.
std::vector<std::int32_t> beyond_above_sliver(double beneath, double value_of_wall, double bound) {
  const Vec3 middle(0.3, 0.3, 0);
  const Mesh coarse{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, middle - Vec3(0, 0, beneath), {0.3, 0.3, -1}},
                    {value_of_wall, value_of_wall, value_of_wall, 1, 1},
                    {{0, 2, 1, 3}, {0, 3, 1, 4}, {1, 3, 2, 4}, {2, 3, 0, 4}}};
  Mesh original = coarse;
  original.points.push_back(middle + Vec3(0, 0, 1e-9));
  original.scalars.push_back(0);
  original.tets.push_back({0, 1, 2, 5});
  Host host;
  AdaptiveMesh<1> mesh(host.memory);
  put_among(original, coarse, true, host, mesh);
  const Array<std::int32_t> beyond = errors_outside(original.view(), bound, host.job, mesh).beyond;
  return {beyond.begin(), beyond.end()};
}

TEST(ErrorsOutside, FindWhatIsBehindASliver) {
  const std::vector<std::int32_t> none, above{5};
  EXPECT_EQ(beyond_above_sliver(1e-8, 0, 0.9), above);
  EXPECT_EQ(beyond_above_sliver(1e-8, 0, 1.1), none);
  EXPECT_EQ(beyond_above_sliver(1e-2, 0, 0.9), none) << "no reader finds it behind so thick a tet";
  EXPECT_EQ(beyond_above_sliver(1e-2, 1, 0.9), above) << "at the wall";
}

/// A vertex above a tet, out of it by more than rounding until the tet becomes higher.
TEST(ErrorsOutside, KnowWhatComesToBeOutByRounding) {
  const Mesh coarse{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}}, {0, 0, 0, 0}, {{0, 1, 2, 3}}};
  for (double out : {0.5e-6, 1.5e-6, 2.5e-6, 1e-5, 1e-3}) {
    Mesh original = coarse;
    original.points.push_back({0.3, 0.3, out});
    original.scalars.push_back(1);
    original.tets.push_back({0, 1, 2, 4});
    Host host;
    AdaptiveMesh<1> mesh(host.memory);
    put_among(original, coarse, false, host, mesh);
    const bool is_inside = out < 1e-6, comes_inside = !is_inside && out < 100e-6;
    EXPECT_EQ(mesh.vertices_left_out, is_inside ? 0u : 1u) << out;
    EXPECT_EQ(mesh.in_no_tet.size(), is_inside ? 0u : 1u) << out;
    EXPECT_EQ(largest_outside(original.view(), host.job, mesh), 0) << out;
    mesh.points[3].z = -100;
    EXPECT_NEAR(largest_outside(original.view(), host.job, mesh), comes_inside ? 1 : 0, 1e-4) << out;
  }
}

}  // namespace
}  // namespace tetlod
