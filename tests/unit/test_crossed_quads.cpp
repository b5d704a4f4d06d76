// Quads that tets on their two sides cut along different diagonals.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "brute_force.hpp"
#include "close_quads.hpp"
#include "geometry.hpp"
#include "prepared_mesh.hpp"

namespace tetlod {
namespace {

using namespace test;

class CrossedQuads : public PreparedMesh {
 protected:
  double volume6(const Tet &t) const {
    const auto at = [&](std::size_t k) { return original.view.points[std::size_t(t[k])]; };
    return det(at(0), at(1), at(2), at(3));
  }

  /// Every face is used once or twice, and those used once are the boundary.
  void expect_conforming() const {
    std::map<Triangle, int> uses;
    for (const Tet &t : original.view.tets)
      for (std::size_t k = 0; k < 4; k++) {
        Triangle face;
        for (std::size_t i = 0, n = 0; i < 4; i++)
          if (i != k) face[n++] = t[i];
        std::sort(face.begin(), face.end());
        uses[face]++;
      }
    std::size_t single = 0;
    for (const auto &[face, count] : uses) {
      EXPECT_LE(count, 2);
      single += count == 1;
    }
    EXPECT_EQ(single, boundary.triangles.size());
    EXPECT_EQ(boundary.tet_of.size(), boundary.triangles.size());
  }

  /// How many of the tets are nearly flat.
  std::size_t expect_closed(const Mesh &mesh, std::size_t hull, double volume) {
    prepare(mesh);
    expect_conforming();
    EXPECT_EQ(boundary.triangles.size(), hull);
    double sum = 0;
    std::size_t flat = 0;
    for (const Tet &t : original.view.tets) {
      sum += volume6(t) / 6;
      flat += std::abs(volume6(t)) < 1e-12;
    }
    EXPECT_NEAR(sum / volume, 1, 1e-12);
    const std::size_t tets = original.view.tets.size();
    EXPECT_EQ(original.tet_number.size(), tets);
    for (const std::int32_t number : original.tet_number) EXPECT_LT(std::size_t(number), mesh.tets.size());
    return flat;
  }
};

TEST_F(CrossedQuads, AreClosed) {
  for (const int n : {2, 4, 7}) {
    const Mesh mesh = cubes_in_five(n);
    EXPECT_EQ(brute_boundary(mesh).size(), std::size_t(12 * n * n + 12 * n * n * (n - 1))) << "four in each inner quad";
    EXPECT_LE(expect_closed(mesh, std::size_t(12 * n * n), 1), mesh.tets.size() / 1000) << n;
  }
}

/// Where quads are no longer exactly plane, or bent, and whichever way tets wind.
TEST_F(CrossedQuads, AreClosedWhereTheyAreNotPlane) {
  const int n = 6;
  Mesh turned = cubes_in_five(n), bent = turned;
  transform(turned, [](const Vec3 &p) { return Vec3(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z + 0.3 * p.x); });
  for (std::size_t t = 0; t < turned.tets.size(); t += 2) std::swap(turned.tets[t][0], turned.tets[t][1]);
  EXPECT_LE(expect_closed(turned, 12 * n * n, 1), turned.tets.size() / 200);
  transform(bent, [](const Vec3 &p) {
    return Vec3((1 + p.x) * std::cos(p.y), (1 + p.x) * std::sin(p.y), p.z + 0.1 * std::sin(3 * p.x));
  });
  prepare(bent);
  expect_conforming();
  EXPECT_EQ(boundary.triangles.size(), std::size_t(12 * n * n));
}

TEST_F(CrossedQuads, AreClosedBetweenParts) {
  Mesh mesh = kuhn_cube(2), other = mesh;
  transform(other, [](const Vec3 &p) { return Vec3(1 + p.x, 1 - p.y, p.z); });
  append(mesh, other);
  EXPECT_EQ(expect_closed(mesh, 80, 2), 0U);
  EXPECT_EQ(original.merged_points, 9);
  options.target_ratio = 0.1;  // they may be in contact
  prepare(mesh);
  EXPECT_EQ(original.merged_points, 0);
}

/// All of whose tets overlap, or none: a saddle turns alike everywhere.
TEST_F(CrossedQuads, AreClosedBetweenPartsThatMeetInASaddle) {
  for (const double turn : {0.3, -0.3}) {
    const int n = 4;
    Mesh mesh = kuhn_cube(n), other = mesh;
    transform(other, [](const Vec3 &p) { return Vec3(1 + p.x, 1 - p.y, p.z); });
    append(mesh, other);
    transform(mesh, [&](const Vec3 &p) { return Vec3(p.x + turn * (p.y - 0.5) * (p.z - 0.5), p.y, p.z); });
    prepare(mesh);
    expect_conforming();
    EXPECT_EQ(boundary.triangles.size(), std::size_t(20 * n * n)) << turn;
  }
}

/// Numbers are those of tets nearby.
TEST_F(CrossedQuads, LeaveNumbersInPlace) {
  const Mesh mesh = cubes_in_five(5);
  prepare(mesh);
  for (std::size_t t = 0; t < original.view.tets.size(); t++) {
    const Tet &old = mesh.tets[std::size_t(original.tet_number[t])];
    for (const std::int32_t v : original.view.tets[t])
      EXPECT_LT(glm::length(mesh.points[std::size_t(v)] - mesh.points[std::size_t(old[0])]), 0.2 * std::sqrt(3) + 1e-9);
  }
}

TEST_F(CrossedQuads, AreNoneWhereOverlapsAreErrors) {
  options.on_overlap = policy_error;
  const Mesh mesh = cubes_in_five(2);
  prepare(mesh);
  EXPECT_EQ(boundary.triangles.size(), brute_boundary(mesh).size());
}

/// A cavity of the shape of a tet; and a flat solid whose boundary is four triangles.
TEST_F(CrossedQuads, AreNoCavitiesAndNoSolids) {
  Mesh mesh = kuhn_cube(5);
  mesh.tets.erase(mesh.tets.begin() + 6 * 62 + 1);  // in the middle
  prepare(mesh);
  EXPECT_EQ(boundary.triangles.size(), 300U + 4);
  const Vec3 corners[] = {Vec3(3, 0, 0), Vec3(4, 0, 0), Vec3(3, 1, 0), Vec3(4, 1, 0.01)};
  const auto first = std::int32_t(mesh.points.size());
  Vec3 middle(0);
  for (const Vec3 &p : corners) {
    mesh.points.push_back(p);
    middle += 0.25 * p;
  }
  mesh.points.push_back(middle);
  mesh.scalars.resize(mesh.points.size(), 0);
  for (int k = 0; k < 4; k++) {
    Tet t{first, first + 1, first + 2, first + 3};
    t[std::size_t(k)] = first + 4;
    mesh.tets.push_back(t);
  }
  prepare(mesh);
  EXPECT_EQ(boundary.triangles.size(), 300U + 4 + 4);
  mesh.tets.erase(mesh.tets.begin(), mesh.tets.end() - 4);
  prepare(mesh);
  EXPECT_EQ(boundary.triangles.size(), 4U);
}

/// However flat, and where two touch.
TEST_F(CrossedQuads, AreNoCavitiesInFlatBodies) {
  const auto without = [](Mesh mesh, const std::vector<std::ptrdiff_t> &tets) {
    for (const std::ptrdiff_t t : tets) mesh.tets.erase(mesh.tets.begin() + t);
    return mesh;
  };
  const Mesh cube = kuhn_cube(5);
  const std::ptrdiff_t middle = 6 * 62, next = 6 * (62 + 1 + 5 + 25);
  for (const double flat : {1.0, 0.05, 1e-3, 1e-6}) {
    for (Mesh mesh : {without(cube, {middle + 1}), without(cube, {next + 2, middle + 1})}) {
      const std::size_t faces = brute_boundary(mesh).size();
      ASSERT_GE(faces, 304U);
      transform(mesh, [&](const Vec3 &p) { return Vec3(p.x, p.y, flat * p.z); });
      prepare(mesh);
      EXPECT_EQ(boundary.triangles.size(), faces) << flat;
      Tet sliver = cube.tets[std::size_t(middle + 1)];
      Vec3 &tip = mesh.points[std::size_t(sliver[3])];
      const Vec3 on_face = (mesh.points[std::size_t(sliver[0])] + mesh.points[std::size_t(sliver[1])] +
                            mesh.points[std::size_t(sliver[2])]) /
                           3.0;
      tip = on_face + 0.1 * (tip - on_face);
      prepare(mesh);
      ASSERT_TRUE(original.moves.upright.empty());
      EXPECT_EQ(boundary.triangles.size(), faces) << "a sliver, " << flat;
    }
  }
}

/// Of some the tets beside it are three times as large, or more; some touch.
TEST_F(CrossedQuads, AreNoPores) {
  for (unsigned seed = 1; seed <= 6; seed++) {
    Mesh mesh = kuhn_cube(8);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> shift(-0.035, 0.035), part(0, 1);
    for (Vec3 &p : mesh.points) p += Vec3(shift(random), shift(random), shift(random));
    const auto is_gone = [&](const Tet &) { return part(random) < 0.02 * seed; };
    mesh.tets.erase(std::remove_if(mesh.tets.begin(), mesh.tets.end(), is_gone), mesh.tets.end());
    const std::size_t tets = mesh.tets.size(), faces = brute_boundary(mesh).size();
    prepare(mesh);
    EXPECT_EQ(boundary.triangles.size(), faces) << seed;
    EXPECT_EQ(original.view.tets.size(), tets) << seed;
  }
}

/// By the measure of a mesh that is flat many faces are next to one another.
TEST_F(CrossedQuads, AreNoneInFlatBodiesThatConform) {
  for (unsigned seed = 1; seed <= 12; seed++) {
    Mesh mesh = random_solid(6, 0.9, seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> shift(-0.03, 0.03);
    for (Vec3 &p : mesh.points) p += Vec3(shift(random), shift(random), shift(random));
    for (const double flat : {1.0, 1e-3, 1e-4, 1e-5}) {
      Mesh squeezed = mesh;
      transform(squeezed, [&](const Vec3 &p) { return Vec3(p.x, p.y, flat * p.z); });
      prepare(squeezed);
      EXPECT_EQ(original.view.tets.size(), mesh.tets.size()) << seed << ' ' << flat;
      EXPECT_TRUE(original.replaced.empty()) << seed << ' ' << flat;
    }
  }
}

/// Cells that are no boxes: flat tets give way late, and what was tried for one is undone in whole.
TEST_F(CrossedQuads, OfCellsThatAreCutAnyhow) {
  for (unsigned seed = 30; seed <= 40; seed++) {
    Mesh mesh = refined_cubes(
        5, [](const Cell &) { return 0; }, seed);
    transform(mesh, [&](const Vec3 &p) {
      const double turn = 0.01 * (seed + 30) * p.z;
      return Vec3((0.3 + p.x) * std::cos(3 * p.y + turn), (0.3 + p.x) * std::sin(3 * p.y + turn), 0.3 * p.z);
    });
    prepare(mesh);
    expect_conforming();
    EXPECT_EQ(boundary.triangles.size(), 12U * 25) << seed;
  }
}

}  // namespace
}  // namespace tetlod
