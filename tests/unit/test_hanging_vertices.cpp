// Meshes that are refined in places: vertices hang on the edges of coarser neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <set>
#include <utility>

#include "brute_force.hpp"
#include "geometry.hpp"
#include "hanging_vertices.hpp"
#include "prepared_mesh.hpp"

namespace tetlod {
namespace {

using namespace test;

class HangingVertices : public PreparedMesh {
 protected:
  /// A solid of this volume, closed, with one surface, without slits; tets wind one way, nearly all with a volume.
  void expect_conforming(const Mesh &mesh, double volume) {
    prepare(mesh);
    Mesh is = mesh;
    is.tets.assign(original.view.tets.begin(), original.view.tets.end());
    EXPECT_EQ(oriented_triangles(boundary.triangles), brute_boundary(is));
    const SurfaceFacts facts = facts_of(boundary.triangles);
    EXPECT_TRUE(facts.closed);
    EXPECT_EQ(facts.components, 1);
    EXPECT_EQ(facts.euler, 2);
    EXPECT_EQ(facts.nonmanifold_edges, 0);
    double sum = 0;
    std::size_t flat = 0;
    for (std::size_t t = 0; t < is.tets.size(); t++) {
      const auto at = [&](std::size_t k) { return is.points[std::size_t(is.tets[t][k])]; };
      const double volume6 = det(at(0), at(1), at(2), at(3));
      sum += volume6 / 6;
      flat += std::abs(volume6) < 1e-12;
      EXPECT_GT(volume6, -1e-12);
    }
    EXPECT_NEAR(sum / volume, 1, 1e-9);
    EXPECT_LE(flat, is.tets.size() / 100);
    EXPECT_LT(length2(enclosed(is)), 1e-20);
  }

  /// As many tets as the mesh has that the prepared one has not under their number, whatever their winding.
  void expect_divided(const Mesh &mesh) const {
    const auto vertices_of = [](Tet t) {
      std::sort(t.begin(), t.end());
      return t;
    };
    std::set<std::pair<std::int32_t, Tet>> left;
    for (std::size_t t = 0; t < original.view.tets.size(); t++)
      left.insert({original.tet_number[t], vertices_of(original.view.tets[t])});
    std::int64_t divided = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); t++)
      divided += left.count({std::int32_t(t), vertices_of(mesh.tets[t])}) == 0;
    EXPECT_GT(divided, 0);
    EXPECT_EQ(std::int64_t(original.replaced.size()), divided);
  }

  static double single_precision(double x) { return float(x); }
  static double six_digits(double x) {  // as text has it
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return std::strtod(text, nullptr);
  }

  /// The area vectors of a closed surface add up to nothing.
  Vec3 enclosed(const Mesh &mesh) const {
    Vec3 sum(0);
    for (const Triangle &t : boundary.triangles)
      sum +=
          area_vector(mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])], mesh.points[std::size_t(t[2])]);
    return sum;
  }
};

TEST_F(HangingVertices, AreNoneInSoundMeshes) {
  for (unsigned seed = 1; seed < 8; seed++) {
    const Mesh mesh = random_solid(4, 0.5, seed);
    prepare(mesh);
    EXPECT_TRUE(original.replaced.empty());
    ASSERT_EQ(original.view.tets.size(), mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); t++) EXPECT_EQ(original.view.tets[t], mesh.tets[t]);
  }
}

/// Where a crack is hardly open, one side's vertices are next to the ends of the other side's edges.
TEST_F(HangingVertices, AreNoneAcrossCracks) {
  for (const double opening : {1e-4, 3e-6, 1e-6, 1e-8}) {
    const Mesh mesh = open_cracked_cube(16, opening);
    prepare(mesh);
    EXPECT_TRUE(original.replaced.empty()) << opening;
    EXPECT_EQ(oriented_triangles(boundary.triangles), brute_boundary(mesh)) << opening;
  }
}

/// Two vertices have a triangle with each of the others.
TEST_F(HangingVertices, AreNotLookedForAmongVeryMany) {
  constexpr int n = 100000;
  Mesh mesh;
  mesh.points = {Vec3(0), Vec3(0, 0, 1)};
  for (std::int32_t i = 0; i < n; i++) {
    const double angle = 2 * 3.141592653589793 * i / n;
    mesh.points.push_back(Vec3(std::cos(angle), std::sin(angle), 0));
    mesh.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
  }
  mesh.scalars.assign(mesh.points.size(), 0);
  const auto begin = std::chrono::steady_clock::now();
  prepare(mesh);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 2);
  EXPECT_EQ(boundary.triangles.size(), 2U * n);
}

TEST_F(HangingVertices, OfOneFineCell) {
  for (const Cell &fine : {Cell{1, 1, 1}, Cell{0, 1, 1}, Cell{0, 0, 0}}) {
    const Mesh mesh = refined_cubes(3, [&](const Cell &c) { return c == fine; });
    expect_conforming(mesh, 1);
    expect_divided(mesh);
  }
}

TEST_F(HangingVertices, OfCellsAnywhere) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 6; round++) {
    std::bernoulli_distribution is_fine(0.1 + 0.15 * round);
    const Mesh mesh = refined_cubes(4, [&](const Cell &) { return is_fine(random); });
    expect_conforming(mesh, 1);
    for (double (*const rounded)(double) : {single_precision, six_digits}) {
      Mesh turned = mesh;
      transform(turned, [&](const Vec3 &p) {  // in no plane of the axes
        return Vec3(rounded(3 * p.x - 0.7 * p.y), rounded(2 * p.y + 0.3 * p.z + 10), rounded(p.z - 0.2 * p.x));
      });
      prepare(turned);
      EXPECT_EQ(facts_of(boundary.triangles).components, 1) << round;
      EXPECT_EQ(facts_of(boundary.triangles).euler, 2) << round;
    }
  }
}

TEST_F(HangingVertices, OfCellsThatAreCutAnyhow) {
  std::mt19937_64 random(2);
  for (unsigned seed = 1; seed <= 8; seed++) {
    std::bernoulli_distribution is_fine(0.1 * seed - 0.1);
    const Mesh mesh = refined_cubes(
        4, [&](const Cell &) { return is_fine(random); }, seed);
    expect_conforming(mesh, 1);
    expect_divided(mesh);
  }
}

/// By up to two: vertices also lie inside of the triangles of coarse cells.
TEST_F(HangingVertices, OfCellsThatAreLevelsApart) {
  for (unsigned seed = 1; seed <= 8; seed++) {
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> level(0, 2);
    const Mesh mesh = refined_cubes(
        2, [&](const Cell &) { return level(random); }, seed % 2 == 0 ? seed : 0);
    expect_conforming(mesh, 1);
    expect_divided(mesh);
  }
}

/// Each cell has points of its own, as some programs write them: parts that share faces, or halves of them, are one.
TEST_F(HangingVertices, OfCellsWithPointsOfTheirOwn) {
  std::mt19937_64 random(9);
  std::bernoulli_distribution is_fine(0.4);
  const Mesh mesh = refined_cubes(3, [&](const Cell &) { return is_fine(random); });
  const Mesh apart = with_points_of_their_own(mesh);
  for (const double ratio : {0.0, 0.1}) {
    options.target_ratio = ratio;
    expect_conforming(apart, 1);
    EXPECT_EQ(original.merged_points, std::int64_t(apart.points.size() - mesh.points.size()));
  }
}

TEST_F(HangingVertices, StayWhereOverlapsAreErrors) {
  options.on_overlap = policy_error;
  const Mesh mesh = refined_cubes(2, [](const Cell &c) { return c == Cell{0, 0, 0}; });
  prepare(mesh);
  EXPECT_EQ(original.view.tets.size(), mesh.tets.size());
}

}  // namespace
}  // namespace tetlod
