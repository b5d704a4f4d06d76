// Cracks: sides with points of their own at one place stay apart where a field jumps, and become one where none does.
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "brute_force.hpp"
#include "geometry.hpp"
#include "prepared_mesh.hpp"

namespace tetlod {
namespace {

using namespace test;

class CrackTest : public PreparedMesh {
 protected:
  CrackTest() { options.target_ratio = 0.1; }

  using PreparedMesh::prepare;
  void prepare(const Mesh &mesh, const std::vector<std::uint8_t> &flags) {
    original = Original(host.memory);
    boundary = Boundary(host.memory);
    Input input = input_of(mesh);
    input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
    prepare_with_boundary(input, options, host.job, original, boundary);
  }

  /// How many points are at the place of another.
  static std::int64_t doubled(const Mesh &mesh) {
    std::set<std::array<double, 3>> places;
    for (const Vec3 &p : mesh.points) places.insert({p.x, p.y, p.z});
    return std::int64_t(mesh.points.size() - places.size());
  }

  /// No point is merged, no tet turned over, sides lie apart, by next to nothing, and the boundary is as submitted.
  /// staying: points of one side that are not moved.
  void expect_open(const Mesh &mesh, std::int64_t staying = 0) {
    EXPECT_EQ(original.merged_points, 0);
    EXPECT_EQ(std::int64_t(original.moves.opened.size()), 2 * doubled(mesh) - staying);
    EXPECT_EQ(oriented_triangles(boundary.triangles), brute_boundary(mesh));
    Mesh opened = mesh;
    opened.points.assign(original.view.points.begin(), original.view.points.end());
    EXPECT_EQ(doubled(opened), 0);
    const double little = 1.001e-5 * box_of(mesh.view().points).diagonal();
    for (std::size_t v = 0; v < mesh.points.size(); v++)
      EXPECT_LE(glm::distance(opened.points[v], mesh.points[v]), little);
    for (const Tet &t : mesh.tets) {
      const auto volume = [&](const Mesh &of) {
        const auto at = [&](std::size_t k) { return of.points[std::size_t(t[k])]; };
        return det(at(0), at(1), at(2), at(3));
      };
      EXPECT_GT(volume(opened) / volume(mesh), 0.9);
    }
    EXPECT_TRUE(crossings(surface_of(opened, host.job), host.memory).empty());
  }

  void expect_closed(const Mesh &mesh) {
    EXPECT_EQ(original.merged_points, doubled(mesh));
    EXPECT_TRUE(original.moves.opened.empty());
    for (std::size_t v = 0; v < mesh.points.size(); v++) EXPECT_EQ(original.view.points[v], mesh.points[v]);
  }

  static bool lie_in(const Face &face, int axis, double at) {
    return std::all_of(face.begin(), face.end(), [&](const Vec3 &p) { return p[axis] == at; });
  }

  /// 1 above and before, less on the other sides of cracks that lie across the axes.
  static double by_side(const Vec3 &, const Vec3 &towards) {
    return (towards.x > 0 ? 0.5 : 0) + (towards.y > 0 ? 0.3 : 0) + (towards.z > 0 ? 0.2 : 0);
  }
};

TEST_F(CrackTest, AreOpenWhereAFieldJumps) {
  for (const double jump : {0.0, 0.001, 0.01, 1.0}) {
    const Mesh mesh = cracked_cube(8, jump);
    ASSERT_GT(doubled(mesh), 4);
    prepare(mesh);
    if (jump > 0.005)
      expect_open(mesh);
    else
      expect_closed(mesh);
    EXPECT_FALSE(original.jumps.empty());
  }
}

/// That cross one another, end at one another, or turn at an edge.
TEST_F(CrackTest, OfSeveralPlanesAreOpen) {
  const auto is_near = [](double x, double least, double most) { return x > least && x < most; };
  const std::function<bool(const Face &)> ways[] = {
      [&](const Face &f) {
        const Vec3 p = (f[0] + f[1] + f[2]) / 3.0;
        return (lie_in(f, 0, 0.5) || lie_in(f, 1, 0.5)) && is_near(p.z, 0.2, 0.8) && is_near(p.x + p.y, 0.5, 1.5);
      },
      [&](const Face &f) {
        const Vec3 p = (f[0] + f[1] + f[2]) / 3.0;
        return (lie_in(f, 0, 0.5) && is_near(p.y, 0.2, 0.8)) || (lie_in(f, 1, 0.5) && is_near(p.x, 0.5, 0.8));
      },
      [&](const Face &f) {
        const Vec3 p = (f[0] + f[1] + f[2]) / 3.0;
        return (lie_in(f, 0, 0.5) && p.y < 0.5 && p.z < 0.7) || (lie_in(f, 1, 0.5) && p.x < 0.5 && p.z < 0.7);
      },
      [&](const Face &f) {
        return (lie_in(f, 0, 0.5) && f[0].y + f[1].y + f[2].y < 2) || (lie_in(f, 0, 0.25) && f[0].z + f[1].z > 1) ||
               (lie_in(f, 2, 0.5) && f[0].x + f[1].x + f[2].x > 1.5);
      },
  };
  for (const auto &is_cracked : ways)
    for (const bool is_bent : {false, true}) {
      Mesh mesh = cracked(kuhn_cube(8), is_cracked, by_side);
      if (is_bent)
        transform(mesh, [](const Vec3 &p) {
          return Vec3(p.x + 0.1 * std::sin(3 * p.z), 1.3 * p.y + 0.07 * p.x * p.x, p.z + 0.1 * std::sin(4 * p.x)) * 1e3;
        });
      prepare(mesh);
      EXPECT_EQ(original.merged_points, 0);
      EXPECT_EQ(oriented_triangles(boundary.triangles), brute_boundary(mesh));
      Mesh opened = mesh;
      opened.points.assign(original.view.points.begin(), original.view.points.end());
      EXPECT_EQ(doubled(opened), 0);
    }
}

/// As where hexahedra were split one by one: no two triangles of the sides are the same. Around the crack the mesh is
/// one after its quads were closed.
TEST_F(CrackTest, AreOpenWhereTheirSidesAreCutInOtherWays) {
  constexpr int n = 8;
  for (const double jump : {0.0, 1.0}) {
    const Mesh mesh = cracked_where_quads_cross(n, jump);
    std::vector<int> used(mesh.points.size(), 0);
    for (const Tet &t : mesh.tets)
      for (const std::int32_t v : t) used[std::size_t(v)] = 1;
    const std::int64_t doubled_in_crack = doubled(mesh) - std::count(used.begin(), used.end(), 0);
    ASSERT_GT(doubled_in_crack, 8);
    prepare(mesh);
    EXPECT_EQ(original.merged_points, jump > 0 ? 0 : doubled_in_crack);
    EXPECT_EQ(std::int64_t(original.moves.opened.size()), jump > 0 ? 2 * doubled_in_crack : 0);
    EXPECT_EQ(facts_of(boundary.triangles).components, jump > 0 ? 2 : 1);
    EXPECT_EQ(facts_of(boundary.triangles).euler, jump > 0 ? 4 : 2);
  }
}

TEST_F(CrackTest, OfCellsAreClosed) {
  Mesh cells = with_points_of_their_own(kuhn_cube(4));
  for (std::size_t v = 0; v < cells.points.size(); v++) cells.scalars[v] = double(v);
  prepare(cells);
  expect_closed(cells);
  EXPECT_TRUE(original.jumps.empty());
}

/// Where there is no way back, as on sides that are folded: among random faces each crack is open, or closed.
TEST_F(CrackTest, WhoseSidesCannotGoBackAreClosed) {
  std::mt19937 random(3);
  std::bernoulli_distribution is_one(0.5);
  std::map<std::array<double, 3>, bool> chosen;
  const Mesh mesh = cracked(
      kuhn_cube(6),
      [&](const Face &f) {
        const Vec3 p = (f[0] + f[1] + f[2]) / 3.0;
        const auto inside = [](double x) { return x > 0.2 && x < 0.8; };
        return inside(p.x) && inside(p.y) && inside(p.z) &&
               chosen.emplace(std::array<double, 3>{p.x, p.y, p.z}, is_one(random)).first->second;
      },
      by_side);
  prepare(mesh);
  EXPECT_GT(original.merged_points, 0);
  EXPECT_LT(original.merged_points, doubled(mesh)) << "others are open";
  Mesh is = mesh;
  is.points.assign(original.view.points.begin(), original.view.points.end());
  is.tets.assign(original.view.tets.begin(), original.view.tets.end());
  EXPECT_TRUE(crossings(surface_of(is, host.job), host.memory).empty());
}

/// One side at least, and where both are flagged, the crack is closed.
TEST_F(CrackTest, FlaggedPointsStay) {
  const Mesh mesh = cracked_cube(8, 1);
  for (const bool both : {false, true}) {
    std::vector<std::uint8_t> flags(mesh.points.size(), 0);
    for (std::size_t v = 0; v < flags.size(); v++)
      flags[v] = mesh.points[v].z == 0.5 && (both || mesh.scalars[v] > 0.2) ? lock_vertex : 0;
    prepare(mesh, flags);
    for (std::size_t v = 0; v < flags.size(); v++)
      EXPECT_TRUE(!flags[v] || original.view.points[v] == mesh.points[v]) << v;
    if (both)
      expect_closed(mesh);
    else
      EXPECT_EQ(std::int64_t(original.moves.opened.size()), doubled(mesh));
  }
}

/// A vertex right behind a side would be gone past: the other side has room.
TEST_F(CrackTest, NoTetIsTurnedOver) {
  for (const double behind : {1e-2, 1e-4, 1e-7, 1e-8}) {
    Mesh mesh = cracked_cube(8, 1);
    *std::find(mesh.points.begin(), mesh.points.end(), Vec3(0.5, 0.5, 0.625)) = Vec3(0.5, 0.5, 0.5 + behind);
    prepare(mesh);
    expect_open(mesh, behind > 1e-5 ? 0 : 1);
  }
}

/// Its two faces are one within the tolerance, and the field differs between them.
TEST_F(CrackTest, AreNoThinPlates) {
  options.merge_tolerance = 1e-3;
  Mesh plate = kuhn_solid({10, 10, 1}, [](const Cell &) { return true; });
  transform(plate, [](const Vec3 &p) { return Vec3(p.x, p.y, 1e-3 * p.z); });
  append(plate, kuhn_cube(3));
  set_scalars(plate, [](const Vec3 &p) { return p.x + 1e4 * p.z; });
  original = Original(host.memory);
  prepare_original(input_of(plate), options, host.job, original);
  EXPECT_TRUE(original.moves.opened.empty());
  EXPECT_GT(original.merged_points, 100);
}

/// As of cells of a method that lets fields jump.
TEST_F(CrackTest, WithMostOfThePointsAreClosed) {
  const auto is_between = [](const Face &f, int width) {
    for (int axis = 0; axis < 3; axis++)
      for (int at = width; at < 12; at += width)
        if (lie_in(f, axis, at / 12.0)) return true;
    return false;
  };
  for (const int width : {3, 6}) {
    const Mesh mesh = cracked(
        kuhn_cube(12),
        [&](const Face &f) {
          const Vec3 p = (f[0] + f[1] + f[2]) / 3.0;  // but for a few, so that they are one part
          return is_between(f, width) && glm::length(p - glm::floor(p * (12.0 / width) + 0.5) * (width / 12.0)) > 0.09;
        },
        by_side);
    prepare(mesh);
    if (width == 3)
      expect_closed(mesh);
    else
      EXPECT_GT(original.moves.opened.size(), 100U);
  }
}

TEST_F(CrackTest, AreClosedWhereTheyMayNotBeMoved) {
  const Mesh mesh = cracked_cube(8, 1);
  options.max_deviation = 1e-7;
  prepare(mesh);
  expect_closed(mesh);
  options.max_deviation = 1e-5;
  prepare(mesh);
  expect_open(mesh);
}

TEST_F(CrackTest, AreClosedWhereNoneAreTaken) {
  options.target_ratio = 0;
  const Mesh mesh = cracked_cube(8, 1);
  prepare(mesh);
  expect_closed(mesh);
}

}  // namespace
}  // namespace tetlod
