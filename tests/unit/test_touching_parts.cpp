// Of points at one place those of parts that only touch stay apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "merge_points.hpp"
#include "meshes.hpp"
#include "prepare.hpp"
#include "touching_parts.hpp"

namespace tetlod {
namespace {

using namespace test;

class TouchingParts : public testing::Test {
 protected:
  Host host{2};
  Mesh mesh;
  std::vector<std::uint8_t> used;
  Array<std::int32_t> representative{&host.memory};

  /// A cube of n^3 cells at that corner, mirrored: with the diagonals of its y faces the other way round.
  void add_cube(int n, const Vec3 &corner, bool mirrored = false) {
    Mesh cube = kuhn_cube(n);
    transform(cube, [&](const Vec3 &p) { return corner + (mirrored ? Vec3(p.x, 1 - p.y, p.z) : p); });
    append(mesh, cube);
  }

  /// Five of several cells, one of which has that many a side.
  void add_blocks(int n) {
    add_cube(4, Vec3(0, 0, 1));
    add_cube(2, Vec3(0, 1, 0));
    add_cube(4, Vec3(0, 1, 1), true);
    add_cube(n, Vec3(1, 0, 0));
    add_cube(4, Vec3(1, 1, 0));
  }

  /// Points that are at the place of another.
  std::int64_t coincident() const {
    std::set<std::array<double, 3>> places;
    for (const Vec3 &p : mesh.points) places.insert({p.x, p.y, p.z});
    return std::int64_t(mesh.points.size() - places.size());
  }

  std::int64_t merge_all() {
    used.resize(mesh.points.size(), 1);
    return merge_points(mesh.view().points, {used.data(), used.size()}, 0, host.job, representative);
  }
  std::int64_t merge() {
    merge_all();
    mesh.scalars.resize(mesh.points.size(), 0);
    const Input input = input_of(mesh);
    keep_touching_parts_apart({input, mesh.view().points, mesh.view().tets, {used.data(), used.size()}}, host.job,
                              representative);
    std::int64_t merged = 0;
    for (std::size_t v = 0; v < representative.size(); v++) merged += representative[v] != std::int32_t(v);
    return merged;
  }

  /// Part by part, tet by tet, until nothing changes.
  std::vector<std::int32_t> brute_force() const {
    const auto at = [&](std::int32_t v) {
      const Vec3 &p = mesh.points[std::size_t(v)];
      return std::array<double, 3>{p.x, p.y, p.z};
    };
    const auto places_of = [&](const Tet &t) {
      return std::set<std::array<double, 3>>{at(t[0]), at(t[1]), at(t[2]), at(t[3])};
    };
    const auto hang_together = [&](const Tet &a, const Tet &b) {
      if (std::any_of(a.begin(), a.end(), [&](auto v) { return std::count(b.begin(), b.end(), v) > 0; })) return true;
      const auto here = places_of(a), there = places_of(b);
      const auto common = std::count_if(here.begin(), here.end(), [&](const auto &p) { return there.count(p) > 0; });
      return here.size() == 4 && there.size() == 4 && common >= 3;
    };
    const auto counts = [&](const Tet &t) {
      return std::all_of(t.begin(), t.end(), [&](auto v) { return used[std::size_t(v)] != 0; });
    };
    std::vector<std::size_t> part(mesh.tets.size());
    std::iota(part.begin(), part.end(), 0);
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < part.size(); i++)
        for (std::size_t j = 0; j < i; j++) {
          const Tet &a = mesh.tets[i], &b = mesh.tets[j];
          if (part[i] == part[j] || !counts(a) || !counts(b) || !hang_together(a, b)) continue;
          part[i] = part[j] = std::min(part[i], part[j]);
          again = true;
        }
    }
    std::vector<std::int32_t> lowest(mesh.points.size());
    std::vector<std::size_t> of_point(mesh.points.size());
    for (std::size_t v = 0; v < of_point.size(); v++) of_point[v] = part.size() + v;  // of no tet: alone
    for (std::size_t t = 0; t < part.size(); t++)
      for (const std::int32_t v : mesh.tets[t])
        if (counts(mesh.tets[t])) of_point[std::size_t(v)] = part[t];
    std::map<std::pair<std::array<double, 3>, std::size_t>, std::int32_t> first;
    for (std::size_t v = 0; v < lowest.size(); v++) {
      lowest[v] = std::int32_t(v);
      if (used[v]) lowest[v] = first.emplace(std::pair(at(lowest[v]), of_point[v]), lowest[v]).first->second;
    }
    return lowest;
  }

  void expect_as_by_brute_force() {
    const std::int64_t merged = merge();
    const std::vector<std::int32_t> expected = brute_force();
    EXPECT_EQ(std::vector<std::int32_t>(representative.begin(), representative.end()), expected);
    std::int64_t count = 0;
    for (std::size_t v = 0; v < expected.size(); v++) count += expected[v] != std::int32_t(v);
    EXPECT_EQ(merged, count);
  }
};

TEST_F(TouchingParts, ThatShareFacesAreOne) {
  add_cube(2, Vec3(0));
  add_cube(2, Vec3(1, 0, 0));
  EXPECT_EQ(merge(), 9);
  expect_as_by_brute_force();
}

TEST_F(TouchingParts, StayApart) {
  for (const auto &[cells, corner] : {std::pair(2, Vec3(1, 1, 0)),     // along an edge
                                      std::pair(2, Vec3(1, 1, 1)),     // at a vertex
                                      std::pair(5, Vec3(1, 0, 0))}) {  // smaller triangles
    mesh = {};
    used.clear();
    add_cube(2, Vec3(0));
    add_cube(cells, corner);
    EXPECT_EQ(merge(), 0) << corner.y;
    expect_as_by_brute_force();
  }
}

/// The second divides the first's faces; the third has faces in common with it; the fourth cuts its quads the other
/// way.
TEST_F(TouchingParts, OfAMeshAreOneWhereItConformsAfterwards) {
  add_cube(2, Vec3(0));
  add_cube(4, Vec3(1, 0, 0));
  EXPECT_EQ(merge(), 0) << "an assembly";
  add_cube(2, Vec3(0, 1, 0));
  EXPECT_EQ(merge(), 9 + 9);
  add_cube(2, Vec3(0, 0, 1), true);
  EXPECT_EQ(merge(), 9 + 9 + 9);
}

/// Faces of the first and the third are the same, or cut the other way, others are finer or coarser by up to two
/// levels.
TEST_F(TouchingParts, OfAMeshAreOneWhereLevelsAreLeftOut) {
  add_blocks(8);
  EXPECT_EQ(merge(), coincident());
}

/// Others would fit; but one does not, and slits would be left.
TEST_F(TouchingParts, StayApartWhereNotAllConforms) {
  add_blocks(5);
  EXPECT_EQ(merge(), 25) << "of the first and the third";
}

/// Two of three lie on one another with the same faces, the third on both with others.
TEST_F(TouchingParts, EachPlaceHasAPointOfEachPart) {
  add_cube(2, Vec3(0));
  add_cube(2, Vec3(1, 0, 0));
  add_cube(5, Vec3(0.5, 0, 1));
  EXPECT_EQ(merge(), 9);
  expect_as_by_brute_force();
}

/// A tet without volume that has points of both, or one face that both have, makes them one all over.
TEST_F(TouchingParts, OneTieMakesOneOfTwo) {
  add_cube(2, Vec3(0));
  const auto first = std::int32_t(mesh.points.size());
  add_cube(5, Vec3(1, 0, 0));
  std::int32_t twin = 0, other = first;
  while (mesh.points[std::size_t(twin)] != Vec3(1)) twin++;
  while (mesh.points[std::size_t(other)] != Vec3(1)) other++;
  mesh.tets.push_back({0, 1, twin, other});
  EXPECT_EQ(merge(), 4);
  expect_as_by_brute_force();
  used[0] = 0;  // a tet that goes ties nothing
  EXPECT_EQ(merge(), 0);
  expect_as_by_brute_force();
}

/// Few places, of which each has many points; no four are nearly in one plane, as those of a crossed quad are.
TEST_F(TouchingParts, AsByBruteForce) {
  std::mt19937_64 random(3);
  const auto any = [&](int count) { return int(random() % std::uint64_t(count)); };
  const std::array<Vec3, 6> places = {Vec3(1, 3, 4),   Vec3(3, 4, -4),  Vec3(4, -4, 3),
                                      Vec3(2, -3, -4), Vec3(-4, -3, 3), Vec3(-4, 3, 1)};
  int differ = 0;
  for (int round = 0; round < 200; round++) {
    mesh = {};
    for (int i = 0; i < 40; i++) mesh.points.push_back(places[std::size_t(any(6))]);
    mesh.scalars.assign(mesh.points.size(), 0);
    for (int i = 0; i < 3 + any(20); i++) mesh.tets.push_back({any(40), any(40), any(40), any(40)});
    used.assign(mesh.points.size(), 1);
    for (int i = 0; i < any(4); i++) used[std::size_t(any(40))] = 0;
    expect_as_by_brute_force();
    const Array<std::int32_t> apart = copy_of(representative, host);
    merge_all();
    differ += representative != apart;
  }
  EXPECT_GT(differ, 50) << "parts only touch in most of them";
}

/// TetGen takes each place once: where it is asked for, all points there are one.
TEST_F(TouchingParts, AreMergedWhereNoContactsAreTaken) {
  add_cube(2, Vec3(0));
  add_cube(5, Vec3(1, 0, 0));
  Options options;
  for (const bool collapses : {false, true}) {
    options.target_ratio = collapses ? 0.1 : 0;
    Original original(host.memory);
    prepare_original(input_of(mesh), options, host.job, original);
    EXPECT_EQ(original.merged_points, collapses ? 0 : 4);
  }
}

/// The field jumps between the first and the second somewhere, by so much of its range, but not to the third.
TEST_F(TouchingParts, StayApartWhereAFieldJumps) {
  for (const double jump : {0.0, 0.005, 0.02, 1.0}) {
    mesh = Mesh();
    for (const Vec3 &corner : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) add_cube(3, corner);
    for (std::size_t v = 0; v < mesh.points.size(); v++) mesh.scalars[v] = mesh.points[v].y / 2;
    std::size_t torn = 64;  // of the second
    while (mesh.points[torn] != Vec3(1, 1, 1)) torn++;
    EXPECT_EQ(merge(), 16 + 16);
    mesh.scalars[torn] -= jump;
    EXPECT_EQ(merge(), jump > 0.01 ? 16 : 32) << jump;
  }
}

/// Of two by two, between the first and the second, and between no others.
TEST_F(TouchingParts, StayApartThoughOthersTieThem) {
  for (const Vec3 &corner : {Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) add_cube(3, corner);
  EXPECT_EQ(merge(), coincident());
  for (std::size_t v = 64; v < 128; v++) mesh.scalars[v] = std::max(0.0, 0.5 - mesh.points[v].y);
  EXPECT_LT(merge(), coincident());
  const auto at = [&](std::size_t first, const Vec3 &p) {
    while (mesh.points[first] != p) first++;
    return representative[first];
  };
  EXPECT_NE(at(0, Vec3(1, 0, 0)), at(64, Vec3(1, 0, 0)));
}

/// Their faces fit only after some are divided.
TEST_F(TouchingParts, OfOtherLevelsStayApartWhereAFieldJumps) {
  for (const double jump : {0.0, 1.0}) {
    mesh = Mesh();
    add_cube(4, Vec3(0));
    add_cube(4, Vec3(0, 1, 0));
    const std::size_t first = mesh.points.size();
    add_cube(8, Vec3(1, 0, 0));
    for (std::size_t v = 0; v < mesh.points.size(); v++) mesh.scalars[v] = mesh.points[v].z + (v < first ? 0 : jump);
    EXPECT_EQ(merge(), jump > 0 ? 25 : 25 + 25);
  }
}

/// Of two blocks half of the faces between them are the same, and the others are not: they are no one mesh.
TEST_F(TouchingParts, WhoseFacesFitInPlacesAloneStayApart) {
  for (const bool fits : {true, false}) {
    mesh = Mesh();
    add_cube(6, Vec3(0));
    const std::size_t first = mesh.points.size();
    add_cube(6, Vec3(1, 0, 0));
    std::mt19937 random(4);
    std::uniform_real_distribution<double> off(0.02, 0.06);
    for (std::size_t v = first; v < mesh.points.size(); v++)
      if (Vec3 &p = mesh.points[v]; !fits && p.x == 1 && p.y > 0.5 && p.y < 1 && p.z > 0 && p.z < 1)
        p += Vec3(0, off(random), off(random));
    EXPECT_EQ(merge(), fits ? 49 : 0);
  }
}

/// They may be the cells of a method that lets it jump everywhere.
TEST_F(TouchingParts, OfFewTetsMergeWhateverTheirValues) {
  add_cube(2, Vec3(0));
  add_cube(2, Vec3(1, 0, 0));
  for (std::size_t v = 0; v < mesh.points.size(); v++) mesh.scalars[v] = double(v);
  EXPECT_EQ(merge(), 9);
}

/// Points of two blocks whose coordinates were computed twice are at one place.
TEST_F(TouchingParts, OfOneMeshThoughTheyAreOffByRounding) {
  for (const double offset : {0.0, 1e6}) {
    mesh = Mesh();
    add_cube(4, Vec3(offset, 0, 0));
    const std::size_t first = mesh.points.size();
    add_cube(4, Vec3(offset + 1, 0, 0));
    std::mt19937_64 random(3);
    for (std::size_t v = first; v < mesh.points.size(); v++)
      for (int k = 0; k < 3; k++)
        if (random() % 2 == 0) mesh.points[v][k] = std::nextafter(mesh.points[v][k], random() % 2 == 0 ? -1e9 : 1e9);
    mesh.scalars.assign(mesh.points.size(), 0);
    for (const double ratio : {0.0, 0.1}) {
      Options options;
      options.target_ratio = ratio;
      Original original(host.memory);
      prepare_original(input_of(mesh), options, host.job, original);
      EXPECT_EQ(original.merged_points, 25) << offset;
    }
  }
}

}  // namespace
}  // namespace tetlod
