// What counts of points that become one, and how far the others are from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes.hpp"
#include "prepare.hpp"

namespace tetlod {
namespace {

using namespace test;

class MergedValues : public testing::Test {
 protected:
  Host host;
  Original original{host.memory};
  Mesh mesh = cube();
  std::size_t place = std::size_t(mesh.tets[0][0]);
  std::vector<std::uint8_t> flags;

  /// The k-th tet gets a point of its own there.
  void take_own_point(std::size_t k, double value) {
    std::int32_t &corner = *std::find(mesh.tets[k].begin(), mesh.tets[k].end(), std::int32_t(place));
    corner = std::int32_t(mesh.points.size());
    mesh.points.push_back(mesh.points[place]);
    mesh.scalars.push_back(value);
  }
  Input input() {
    Input input = input_of(mesh);
    if (!flags.empty()) input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
    return input;
  }
  void prepare_all() {
    Boundary boundary(host.memory);
    original = Original(host.memory);
    prepare_with_boundary(input(), {}, host.job, original, boundary);
  }
  static Mesh cube() {
    Mesh cube = kuhn_cube(4);
    set_scalars(cube, [](const Vec3 &p) { return p.x + 2 * p.y - 4 * p.z; });
    return cube;
  }
  double value() const { return original.view.scalars[place]; }
};

/// The middle of theirs; the caller's stay what they are.
TEST_F(MergedValues, HaveOneValue) {
  mesh.scalars[place] = 1;
  take_own_point(0, 10);
  take_own_point(1, -2);
  const std::vector<double> submitted = mesh.scalars;
  prepare_all();
  EXPECT_EQ(original.merged_points, 2);
  EXPECT_EQ(value(), 4);
  EXPECT_EQ(mesh.scalars, submitted);
  EXPECT_EQ(original.scalar_min, -4);
  EXPECT_EQ(original.scalar_max, 10);
  EXPECT_EQ(original.spread_error, 6);
  EXPECT_EQ(original.spread[0].lowest, std::int32_t(submitted.size() - 1));
  EXPECT_EQ(original.spread[0].highest, std::int32_t(submitted.size() - 2));
  for (const double other : {3.0, 1.0}) {
    mesh.scalars[submitted.size() - 1] = mesh.scalars[submitted.size() - 2] = other;
    EXPECT_TRUE(renew_values(input(), host.job, original));
    EXPECT_EQ(value(), 0.5 * (other + 1));
    EXPECT_EQ(original.spread_error, 0.5 * (other - 1));
    EXPECT_EQ(original.scalar_max, 3);
  }
}

/// The host wants it.
TEST_F(MergedValues, HaveTheFirstValueThatIsFlagged) {
  mesh.scalars[place] = 1;
  take_own_point(0, 2.5);
  take_own_point(1, -2);
  flags.assign(mesh.points.size(), 0);
  flags[mesh.points.size() - 2] = flags[mesh.points.size() - 1] = keep_vertex;
  prepare_all();
  EXPECT_EQ(value(), 2.5);
  EXPECT_EQ(original.spread_error, 4.5);
}

/// A cell that is given twice, with points of its own, and one without a volume, outside.
TEST_F(MergedValues, OfDroppedTetsDoNotCount) {
  mesh.scalars[place] = 1;
  const auto first = std::int32_t(mesh.points.size());
  for (const std::int32_t v : Tet(mesh.tets[0])) {
    mesh.points.push_back(mesh.points[std::size_t(v)]);
    mesh.scalars.push_back(1e6);
  }
  mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  for (const double x : {0.0, 0.0, 7.0, 8.0, 9.0}) {
    mesh.points.push_back(Vec3(x, -1, -1));
    mesh.scalars.push_back(x - 1e6);
  }
  mesh.tets.push_back({first + 4, first + 6, first + 7, first + 8});
  mesh.tets.push_back({first + 5, first + 6, first + 7, first + 8});
  prepare_all();
  EXPECT_EQ(original.merged_points, 5);
  EXPECT_EQ(original.dropped_tets, 0);  // by its corners alone
  EXPECT_EQ(value(), 1);
  EXPECT_EQ(original.spread_error, 0);
  EXPECT_EQ(original.scalar_max, 3);
  EXPECT_EQ(original.scalar_min, -4);
}

/// Its distance from both is told, whatever it is rounded to.
TEST_F(MergedValues, MayHaveNoMiddle) {
  for (const auto &[one, other] : {std::pair(1e16, 1e16 + 2), std::pair(0.0, 5e-324), std::pair(-1.7e308, 1.7e308)}) {
    mesh = cube();
    std::fill(mesh.scalars.begin(), mesh.scalars.end(), one);
    take_own_point(0, other);
    prepare_all();
    const double off = std::max(std::abs(value() - one), std::abs(value() - other));
    EXPECT_EQ(original.spread_error, std::min(off, original.range)) << one;
    EXPECT_GT(off, 0);
  }
}

}  // namespace
}  // namespace tetlod
