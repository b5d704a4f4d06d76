// What lies inside of the original's boundary, on the average, goes outward.
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

  /// By collapses, as they leave it.
  void coarsen(double ratio) {
    SolidHistory history(host.memory);
    options.tets = std::int64_t(ratio * double(original.tets.size()));
    mesh = TetMesh(host.memory);
    origin.clear();
    decimate_solid({original.view(), boundary, surface, topology, tree}, options, history, host.job, mesh, origin);
  }

  void move() { move_outward(surface, tree.get(host.job), {stays.data(), stays.size()}, host.job, mesh, origin); }

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
    const TetMesh before = mesh;
    const std::size_t outside = count_outside();
    const double farthest = farthest_sample(), volume = volume6();
    move();
    EXPECT_LT(double(count_outside()), (ratio > 0.03 ? 0.95 : 1) * double(outside)) << ratio;
    EXPECT_GT(volume6(), volume);
    EXPECT_LE(volume6(), std::max(volume, 6 * 1.005 * volume_of(original)) * (1 + 1e-12));
    EXPECT_EQ(mesh.tets, before.tets);
    EXPECT_EQ(mesh.boundary, before.boundary);
    for (const Tet &t : mesh.tets) EXPECT_GT(volume6(t), 0);
    for (std::size_t v = 0; v < mesh.points.size(); v++) {
      if (mesh.points[v] == before.points[v]) continue;
      EXPECT_EQ(origin[v], -1);
      EXPECT_LE(brute_nearest(surface.points, surface.triangles, mesh.points[v]).distance, farthest * (1 + 1e-12));
    }
  }
}

/// Nor does it go inward where it is outside.
TEST_F(MoveOutward, WhatIsPlaneStays) {
  Mesh cube = kuhn_cube(8);
  set_scalars(cube, [](const Vec3 &) { return 1; });
  start_with(cube);
  for (double size : {1.0, 1.001}) {
    coarsen(0.1);
    for (Vec3 &p : mesh.points) p = Vec3(0.5) + size * (p - Vec3(0.5));
    const TetMesh before = mesh;
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
    const TetMesh before = mesh;
    const Array<std::int32_t> was = origin;
    const auto all = std::size_t(std::count_if(was.begin(), was.end(), [](std::int32_t v) { return v >= 0; }));
    stays.assign(original.points.size(), kept);
    move();
    EXPECT_EQ(left(before, was) == all, kept);
    EXPECT_NE(before.points, mesh.points) << "others move";
  }
}

}  // namespace
}  // namespace tetlod
