// What lies inside of the original's boundary, on the average, goes outward.
#include <cmath>
#include <utility>

#include "came_from.hpp"
#include "decimate_solid_fixture.hpp"
#include "move_outward.hpp"

namespace tetlod {
namespace {

using namespace test;

class MoveOutward : public DecimateSolid {
 protected:
  static Mesh ball(int n) {
    Mesh round = kuhn_cube(n);
    transform(round, [](const Vec3 &p) {
      const Vec3 q = 2.0 * p - Vec3(1);
      const double length = glm::length(q), largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)});
      return length > 0 ? largest / length * q : q;
    });
    set_scalars(round, waves);
    return round;
  }

  /// By collapses, as they leave it where it is the field that counts.
  void coarsen(double ratio) {
    SolidHistory history(host.memory);
    options.planes = 0.3;
    options.tets = std::int64_t(ratio * double(original.tets.size()));
    mesh = TetMesh(host.memory);
    origin.clear();
    decimate_solid({original.view(), boundary, surface, topology, tree, contacts}, options, history, host.job, mesh,
                   origin);
  }

  void move(bool guarded = false) {
    move_outward({surface, tree.get(host.job), {stays.data(), stays.size()}, guarded}, host.job, mesh, origin);
  }

  /// The mesh's values become f's.
  template <class Function>
  void set_values(const Function &f) {
    for (std::size_t v = 0; v < mesh.points.size(); v++) mesh.scalars[v] = f(mesh.points[v]);
  }
  static double slope(const Vec3 &p) { return p.x - 2 * p.y; }
  static double jump(const Vec3 &p) { return p.x > 0.1 ? 3 : -1; }

  /// Of the tets of `of` about a vertex, what their linear functions say at a place less what they say at the vertex,
  /// as a part of the range of four: the root of the mean square from the mean, by volume.
  static double unevenness(const TetMesh &of, std::int32_t v, const Vec3 &place) {
    std::vector<std::pair<double, double>> changes;  // and volumes
    double volume = 0, mean = 0, square = 0;
    for (const Tet &t : of.tets) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      Vec3 p[4];
      for (std::size_t k = 0; k < 4; k++) p[k] = of.points[std::size_t(t[k])];
      const double whole = det(p[0], p[1], p[2], p[3]);
      double there = 0;
      for (std::size_t k = 0; k < 4; k++) {
        const Vec3 corner = std::exchange(p[k], place);
        there += det(p[0], p[1], p[2], p[3]) / whole * of.scalars[std::size_t(t[k])];
        p[k] = corner;
      }
      changes.push_back({there - of.scalars[std::size_t(v)], whole});
      volume += whole;
      mean += whole * changes.back().first;
    }
    for (const auto &[change, part] : changes) square += part * std::pow(change - mean / volume, 2);
    return std::sqrt(square / volume) / 4;
  }

  const Vec3 &corner(const Tet &t, std::size_t k) const { return mesh.points[std::size_t(t[k])]; }
  double volume6(const Tet &t) const { return det(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3)); }
  double volume6() const {
    double sum = 0;
    for (const Tet &t : mesh.tets) sum += volume6(t);
    return sum;
  }

  bool is_in(const Vec3 &p, const Tet &t) const {
    const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2), d = corner(t, 3);
    return det(p, b, c, d) >= 0 && det(a, p, c, d) >= 0 && det(a, b, p, d) >= 0 && det(a, b, c, p) >= 0;
  }
  std::size_t count_outside() const {
    return std::size_t(std::count_if(surface.points.begin(), surface.points.end(), [&](const Vec3 &p) {
      return std::none_of(mesh.tets.begin(), mesh.tets.end(), [&](const Tet &t) { return is_in(p, t); });
    }));
  }

  double farthest_sample() const {
    double farthest = 0;
    for (const Vec3 &p : surface.points)
      farthest = std::max(farthest, brute_nearest(mesh.points, mesh.boundary, p).distance);
    return farthest;
  }

  std::vector<std::uint8_t> stays;
  TetMesh mesh{host.memory};
  Array<std::int32_t> origin{&host.memory};
};

TEST_F(MoveOutward, FewerVerticesAreOutside) {
  start_with(ball(12));
  for (double ratio : {0.2, 0.05, 0.02}) {
    coarsen(ratio);
    set_values(slope);
    const TetMesh before = copy_of(mesh, host);
    const std::size_t outside = count_outside();
    const double farthest = farthest_sample(), volume = volume6();
    const Array<std::int32_t> was = copy_of(origin, host);
    move();
    EXPECT_LT(double(count_outside()), (ratio > 0.03 ? 0.95 : 1) * double(outside)) << ratio;
    EXPECT_GT(volume6(), volume);
    EXPECT_LE(volume6(), std::max(volume, 6 * 1.005 * volume_of(original)) * (1 + 1e-12));
    EXPECT_EQ(mesh.tets, before.tets);
    EXPECT_EQ(mesh.boundary, before.boundary);
    for (const Tet &t : mesh.tets) EXPECT_GT(volume6(t), 0);
    for (std::size_t v = 0; v < mesh.points.size(); v++) {
      if (mesh.points[v] == before.points[v]) continue;
      EXPECT_EQ(origin[v], moved_away(was[v]));
      EXPECT_LE(brute_nearest(surface.points, surface.triangles, mesh.points[v]).distance, farthest * (1 + 1e-12));
    }
  }
}

/// Small tets are in the way of a ball.
class MoveOutwardAmongTets : public MoveOutward {
 protected:
  void start() {
    Mesh ball_among_tets = ball(8);
    for (int k = 0; k < 12; k++) append(ball_among_tets, tet_over(direction()));
    set_scalars(ball_among_tets, slope);
    start_with(ball_among_tets);
  }

 private:
  /// With a corner just over the ball of radius 1.
  Mesh tet_over(const Vec3 &up) {
    const Vec3 side = glm::normalize(glm::cross(up, direction())), across = glm::cross(up, side);
    const auto at = [&](double height, double x, double y) { return height * up + x * side + y * across; };
    return {
        {at(1.01, 0, 0), at(1.05, 0.02, 0), at(1.05, 0, 0.02), at(1.05, -0.02, -0.02)}, {0, 0, 0, 0}, {{0, 1, 2, 3}}};
  }

  Vec3 direction() { return glm::normalize(Vec3(normal(random), normal(random), normal(random))); }

  std::mt19937_64 random{1};
  std::normal_distribution<double> normal;
};

TEST_F(MoveOutwardAmongTets, GuardedTheBoundaryDoesNotCrossItself) {
  std::size_t crossed = 0;
  for (int i = 0; i < 12; i++) {
    start();
    coarsen(0.05);
    if (crosses_itself(mesh)) continue;
    const TetMesh before = copy_of(mesh, host);
    const Array<std::int32_t> was = copy_of(origin, host);
    move();
    crossed += crosses_itself(mesh);
    mesh = before;
    origin = was;
    move(true);
    EXPECT_FALSE(crosses_itself(mesh)) << i;
    EXPECT_NE(mesh.points, before.points) << i;
  }
  EXPECT_GT(crossed, 0u) << "unguarded";
}

/// Where all of it would cross, what may goes outward.
TEST_F(MoveOutwardAmongTets, DecimationLowersAllTheSame) {
  std::size_t crossed = 0, lower = 0;
  for (int i = 0; i < 12; i++) {
    start();
    CoarseSolid coarse(host.memory), outward(host.memory);
    lowered = 0;
    ASSERT_TRUE(decimate(0.05, host, coarse)) << failure;
    lowered = std::int64_t(coarse.mesh.tets.size());
    ASSERT_TRUE(decimate(0.05, host, outward)) << failure;
    expect_sound(outward);
    EXPECT_LE(outward.deviation, coarse.deviation) << i;
    lower += outward.deviation < coarse.deviation;
    mesh = coarse.mesh;
    origin = coarse.origin;
    move();
    crossed += crosses_itself(mesh);
  }
  EXPECT_GT(crossed, 0u);
  EXPECT_GT(lower, 6u) << "of twelve";
}

TEST_F(MoveOutward, WhereAFieldJumpsItStays) {
  start_with(ball(12));
  coarsen(0.2);
  set_values(slope);
  const TetMesh coarse = copy_of(mesh, host);
  move();
  const Array<Vec3> moved = copy_of(mesh.points, host);
  mesh.points = coarse.points;
  set_values(jump);
  const TetMesh before = copy_of(mesh, host);
  move();
  std::size_t stay = 0, go = 0;
  for (std::size_t v = 0; v < moved.size(); v++) {
    EXPECT_LE(unevenness(before, std::int32_t(v), mesh.points[v]), 0.002 * (1 + 1e-9)) << v;
    stay += moved[v] != before.points[v] && mesh.points[v] == before.points[v];
    go += mesh.points[v] != before.points[v];
  }
  EXPECT_GT(stay, 10u);
  EXPECT_GT(go, 5 * stay) << "elsewhere nothing holds them";
}

/// Nor does it go inward where it is outside.
TEST_F(MoveOutward, WhatIsPlaneStays) {
  Mesh cube = kuhn_cube(8);
  set_scalars(cube, [](const Vec3 &) { return 1; });
  start_with(cube);
  for (double size : {1.0, 1.001}) {
    coarsen(0.1);
    for (Vec3 &p : mesh.points) p = Vec3(0.5) + size * (p - Vec3(0.5));
    const TetMesh before = copy_of(mesh, host);
    move();
    EXPECT_EQ(mesh.points, before.points) << size;
  }
}

TEST_F(MoveOutward, KeptVerticesStay) {
  start_with(ball(8));
  const auto left = [&](const TetMesh &of, const Array<std::int32_t> &was) {
    std::size_t count = 0;
    for (std::size_t v = 0; v < was.size(); v++) count += was[v] >= 0 && of.points[v] == mesh.points[v];
    return count;
  };
  for (bool kept : {false, true}) {
    coarsen(0.5);
    const TetMesh before = copy_of(mesh, host);
    const Array<std::int32_t> was = copy_of(origin, host);
    const auto all = std::size_t(std::count_if(was.begin(), was.end(), [](std::int32_t v) { return v >= 0; }));
    stays.assign(original.points.size(), kept);
    move();
    EXPECT_EQ(left(before, was) == all, kept);
    EXPECT_NE(before.points, mesh.points) << "others move";
  }
}

}  // namespace
}  // namespace tetlod
