// Tets that are turned over: vertices are moved until none is, by little, or nothing is.
#include <random>

#include "brute_force.hpp"
#include "prepared_mesh.hpp"
#include "status.hpp"

namespace tetlod {
namespace {

using namespace test;

constexpr int cells = 6;
constexpr double cell = 1.0 / cells;

class Untangle : public PreparedMesh {
 protected:
  Mesh mesh = cube(cells);
  std::vector<std::uint8_t> flags;

  static Mesh with_values(Mesh mesh) {
    set_scalars(mesh, [](const Vec3 &p) { return p.x + 2 * p.y; });
    return mesh;
  }
  static double volume6(Span<const Vec3> points, const Tet &t) {
    const auto at = [&](std::size_t k) { return points[std::size_t(t[k])]; };
    return glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0));
  }
  static Mesh cube(int n) {
    Mesh cube = with_values(kuhn_cube(n));
    for (Tet &t : cube.tets)
      if (volume6({cube.points.data(), cube.points.size()}, t) < 0) std::swap(t[2], t[3]);
    return cube;
  }
  std::size_t vertex_at(const Vec3 &p) const {
    for (std::size_t v = 0; v < mesh.points.size(); v++)
      if (glm::distance(mesh.points[v], p) < 1e-9) return v;
    ADD_FAILURE() << "no vertex there";
    return 0;
  }
  /// The vertex in the middle of the top, through the layer of cells below it.
  std::size_t push_in(double beyond) {
    const std::size_t v = vertex_at({0.5, 0.5, 1});
    mesh.points[v].z -= cell + beyond;
    return v;
  }
  void prepare_flagged() {
    Input input = input_of(mesh);
    input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
    original = Original(host.memory);
    boundary = Boundary(host.memory);
    prepare_with_boundary(input, options, host.job, original, boundary);
  }

  std::int64_t turned(Span<const Vec3> points) const {
    std::int64_t count = 0;
    for (const Tet &t : mesh.tets) count += !(volume6(points, t) > 0);
    return count;
  }
  std::int64_t moved() const {
    std::int64_t count = 0;
    for (std::size_t v = 0; v < mesh.points.size(); v++) count += original.view.points[v] != mesh.points[v];
    return count;
  }
  /// Of a mesh whose tets were wound one way.
  void expect_untangled() {
    EXPECT_GT(turned({mesh.points.data(), mesh.points.size()}), 0);
    EXPECT_EQ(turned(original.view.points), 0);
    EXPECT_TRUE(facts_of(boundary.triangles).closed);
    EXPECT_GT(moved(), 0);
    EXPECT_EQ(std::int64_t(original.moves.upright.size()), moved());
    Mesh is = mesh;
    is.points.assign(original.view.points.begin(), original.view.points.end());
    EXPECT_EQ(oriented_triangles(boundary.triangles), brute_boundary(is));
    double farthest = 0, on_boundary = 0;
    std::vector<bool> is_on_boundary(mesh.points.size(), false);
    for (const Triangle &t : boundary.triangles)
      for (const std::int32_t v : t) is_on_boundary[std::size_t(v)] = true;
    for (std::size_t v = 0; v < mesh.points.size(); v++) {
      EXPECT_EQ(original.view.place(v), mesh.points[v]) << "errors are measured there";
      const double by = glm::distance(original.view.points[v], mesh.points[v]);
      farthest = std::max(farthest, by);
      if (is_on_boundary[v]) on_boundary = std::max(on_boundary, by);
    }
    EXPECT_EQ(original.boundary_moved_by, on_boundary);
    EXPECT_LE(farthest, 0.02 * original.box.diagonal());
    EXPECT_EQ(original.box.diagonal(), box_of(original.view.points).diagonal());
  }
  void expect_untouched() {
    EXPECT_TRUE(original.moves.upright.empty());
    EXPECT_EQ(original.boundary_moved_by, 0);
    EXPECT_EQ(moved(), 0);
  }
};

TEST_F(Untangle, AVertexOfTheBoundaryThatWentThroughTheNext) {
  push_in(0.02);
  prepare(mesh);
  expect_untangled();
}

TEST_F(Untangle, AVertexInsideThatWentThroughTheBoundary) {
  mesh.points[vertex_at({0.5, 0.5, 1 - cell})].z += cell + 0.02;
  prepare(mesh);
  expect_untangled();
}

/// As of a mesh that is bent too far in many places.
TEST_F(Untangle, ManyVerticesThatWentAstray) {
  int untangled = 0;
  for (unsigned seed = 1; seed <= 10; seed++) {
    mesh = cube(2 * cells);
    std::mt19937 random(seed);
    std::normal_distribution<double> stray(0, 0.1 * cell);
    for (Vec3 &p : mesh.points) p += Vec3(stray(random), stray(random), stray(random));
    prepare(mesh);
    if (original.moves.upright.empty()) continue;
    untangled++;
    expect_untangled();
  }
  EXPECT_GE(untangled, 8);
}

TEST_F(Untangle, WhateverWayTetsAreWound) {
  push_in(0.02);
  prepare(mesh);
  const Array<Vec3> one_way(original.view.points.begin(), original.view.points.end());
  std::mt19937 random(1);
  for (Tet &t : mesh.tets)
    if (random() % 2) std::swap(t[2], t[3]);
  prepare(mesh);
  EXPECT_EQ(std::int64_t(original.moves.upright.size()), moved());
  for (std::size_t v = 0; v < one_way.size(); v++) EXPECT_LT(glm::distance(original.view.points[v], one_way[v]), 1e-12);
}

TEST_F(Untangle, AnyNumberOfThreadsMovesThemTheSame) {
  push_in(0.02);
  prepare(mesh);
  Host alone(1);
  Original other(alone.memory);
  Boundary of_other(alone.memory);
  prepare_with_boundary(input_of(mesh), options, alone.job, other, of_other);
  EXPECT_EQ(std::vector<Vec3>(original.view.points.begin(), original.view.points.end()),
            std::vector<Vec3>(other.view.points.begin(), other.view.points.end()));
}

/// Then those beside it make room.
TEST_F(Untangle, AFlaggedVertexStays) {
  const std::size_t v = push_in(0.02);
  for (const std::uint8_t flag : {keep_vertex, lock_vertex}) {
    flags.assign(mesh.points.size(), 0);
    flags[v] = flag;
    prepare_flagged();
    expect_untangled();
    EXPECT_EQ(original.view.points[v], mesh.points[v]);
  }
}

TEST_F(Untangle, WhereAllAreFlaggedNothingIsMoved) {
  push_in(0.02);
  flags.assign(mesh.points.size(), lock_vertex);
  prepare_flagged();
  expect_untouched();
}

TEST_F(Untangle, NothingIsMovedFar) {
  push_in(0.4);
  prepare(mesh);
  expect_untouched();
}

TEST_F(Untangle, WhereTheyAreInsideTheBoundaryStays) {
  mesh.points[vertex_at({0.5, 0.5, 0.5})].x += 1.1 * cell;
  mesh.points[vertex_at({0.5, 0.5, 1 - cell})].y += 1.1 * cell;
  prepare(mesh);
  expect_untangled();
  EXPECT_EQ(original.boundary_moved_by, 0);
}

TEST_F(Untangle, WhereNoneIsNothingIsCopied) {
  prepare(mesh);
  expect_untouched();
  EXPECT_EQ(original.view.points.data(), mesh.points.data());
}

TEST_F(Untangle, NothingIsMovedWhereOverlapsAreRefused) {
  push_in(0.02);
  options.on_overlap = policy_error;
  prepare(mesh);
  expect_untouched();
}

/// A ring of prisms whose last is glued to the first as in a mirror.
TEST_F(Untangle, WhatHasNoInsideIsLeftAlone) {
  constexpr int around = 12;
  const auto at = [](int section, int k) {
    constexpr int mirrored[3] = {1, 0, 2};
    return std::int32_t(section < around ? 3 * section + k : mirrored[k]);
  };
  mesh = Mesh{};
  for (int i = 0; i < around; i++) {
    const double turn = 6.283185307179586 * i / around;
    for (const auto &[r, z] : {std::pair(0.8, 0.0), std::pair(1.2, 0.1), std::pair(1.0, 0.3)})
      mesh.points.push_back({r * std::cos(turn), r * std::sin(turn), z});
    mesh.tets.push_back({at(i, 0), at(i, 1), at(i, 2), at(i + 1, 2)});
    mesh.tets.push_back({at(i, 0), at(i, 1), at(i + 1, 1), at(i + 1, 2)});
    mesh.tets.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i + 1, 2)});
  }
  mesh = with_values(mesh);
  prepare(mesh);
  EXPECT_FALSE(facts_of(boundary.triangles).closed);
  expect_untouched();
}

}  // namespace
}  // namespace tetlod
