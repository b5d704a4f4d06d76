// Collapsing edges of a solid: what comes out is positive, closed and of the same topology; what is admissible
// satisfies the link condition.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "decimate_solid_fixture.hpp"
#include "deviation.hpp"
#include "solid_rules.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST_F(DecimateSolid, IsSoundAndMeetsItsSize) {
  const auto tunnel = [](const Cell &c) { return !(c[0] > 1 && c[0] < 6 && c[1] > 1 && c[1] < 6); };
  const auto cavity = [](const Cell &c) {
    return !(c[0] > 1 && c[0] < 5 && c[1] > 1 && c[1] < 5 && c[2] > 1 && c[2] < 5);
  };
  Mesh several = kuhn_cube(6), other = kuhn_cube(5);
  for (Vec3 &p : other.points) p += Vec3(1.2, 0.3, 0);
  append(several, other);
  for (Mesh mesh : {kuhn_cube(10), kuhn_solid({8, 8, 8}, tunnel), kuhn_solid({7, 7, 7}, cavity), several}) {
    set_scalars(mesh, waves);
    shuffle(mesh, 1);
    start_with(mesh);
    for (double ratio : {0.5, 0.2, 0.1}) {
      CoarseSolid coarse(host.memory);
      ASSERT_TRUE(decimate(ratio, host, coarse)) << ratio;
      EXPECT_LE(std::int64_t(coarse.mesh.tets.size()), options.tets + options.tets / 1000);
      EXPECT_GE(std::int64_t(coarse.mesh.tets.size()), options.tets - 12);
      expect_sound(coarse);
    }
  }
}

/// All of its tets would be flat elsewhere.
TEST_F(DecimateSolid, ASqueezedMeshIsAMesh) {
  Mesh mesh = kuhn_cube(10);
  set_scalars(mesh, waves);
  for (double squeeze : {1e-3, 1e-6, 1e-9}) {
    Mesh squeezed = mesh;
    for (Vec3 &p : squeezed.points) p.z *= squeeze;
    start_with(squeezed);
    CoarseSolid coarse(host.memory);
    ASSERT_TRUE(decimate(0.3, host, coarse)) << squeeze;
    expect_sound(coarse);
  }
}

TEST_F(DecimateSolid, SolidsThatTouchKeepWhatTouches) {
  for (unsigned seed = 0; seed < 8; seed++) {
    Mesh mesh = random_solid(6, 0.4 + 0.05 * seed, seed);
    set_scalars(mesh, waves);
    start_with(mesh);
    CoarseSolid coarse(host.memory);
    ASSERT_TRUE(decimate(0.7, host, coarse)) << failure;
    ASSERT_GT(std::count(topology.touching.begin(), topology.touching.end(), 1), 0) << "the test looks at nothing";
    expect_sound(coarse);
    for (std::size_t p = 0; p < surface.points.size(); p++) {
      if (!topology.touching[p]) continue;
      EXPECT_EQ(std::count(coarse.mesh.points.begin(), coarse.mesh.points.end(), surface.points[p]), 1);
    }
  }
}

TEST_F(DecimateSolid, SameBytesForAnyNumberOfThreads) {
  Mesh mesh = kuhn_cube(20);  // large enough for blocks
  set_scalars(mesh, waves);
  start_with(mesh);
  CoarseSolid one(host.memory);
  ASSERT_TRUE(decimate(0.1, host, one));
  for (int threads : {2, 3}) {
    Host several(threads);
    CoarseSolid other(several.memory);
    ASSERT_TRUE(decimate(0.1, several, other));
    expect_same(one.mesh, other.mesh);
  }
}

TEST_F(DecimateSolid, WithAHistorySameBytesSooner) {
  Mesh mesh = kuhn_cube(20);
  set_scalars(mesh, waves);
  start_with(mesh);
  std::vector<double> ratios;
  for (double ratio = 0.9; ratio > 0.01; ratio *= 0.6) ratios.push_back(ratio);
  std::shuffle(ratios.begin(), ratios.end(), std::mt19937(1));
  SolidHistory history(host.memory);
  std::int64_t saved = 0;
  for (double ratio : ratios) {
    CoarseSolid alone(host.memory), later(host.memory);
    ASSERT_EQ(decimate(ratio, host, alone), decimate(ratio, host, history, later));
    expect_same(alone.mesh, later.mesh);
    EXPECT_EQ(alone.origin, later.origin);
    EXPECT_EQ(alone.reused, 0);
    saved += later.reused;
  }
  EXPECT_GT(double(saved), 0.4 * double(ratios.size()) * double(mesh.points.size()));
}

/// As lengths its values are beyond all numbers.
TEST_F(DecimateSolid, AFieldNearlyZeroCountsAsConstant) {
  Mesh mesh = kuhn_cube(8);
  set_scalars(mesh, [](const Vec3 &p) { return 1e-310 * waves(p); });
  start_with(mesh);
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.1, host, coarse)) << failure;
  expect_sound(coarse);
}

TEST_F(DecimateSolid, BlocksOfAPlateGetOn) {
  Mesh mesh = kuhn_solid({66, 66, 1}, [](const Cell &) { return true; });
  set_scalars(mesh, waves);
  start_with(mesh);
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.1, host, coarse)) << failure;
  expect_sound(coarse);
  EXPECT_LE(std::int64_t(coarse.mesh.tets.size()), options.tets + options.tets / 1000);
}

TEST_F(DecimateSolid, KeptVerticesStayInsideAndOnTheBoundary) {
  Mesh mesh = kuhn_cube(8);
  set_scalars(mesh, waves);
  start_with(mesh);
  std::vector<std::uint8_t> kept(mesh.points.size(), 0);
  for (std::size_t v = 0; v < kept.size(); v++) kept[v] = mesh.points[v].x == 0 || v % 17 == 0;
  options.kept = {kept.data(), kept.size()};
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.4, host, coarse));
  expect_sound(coarse);
  std::vector<std::int32_t> place(kept.size(), -1);
  for (std::size_t i = 0; i < coarse.origin.size(); i++)
    if (coarse.origin[i] >= 0) place[std::size_t(coarse.origin[i])] = std::int32_t(i);
  for (std::size_t v = 0; v < kept.size(); v++) {
    if (!kept[v]) continue;
    ASSERT_GE(place[v], 0) << v;
    EXPECT_EQ(coarse.mesh.points[std::size_t(place[v])], mesh.points[v]);
    EXPECT_EQ(coarse.mesh.scalars[std::size_t(place[v])], mesh.scalars[v]);
  }
  // The wall x = 0, whose vertices are all kept, has its triangles still.
  const std::multiset<Triangle> now = oriented_triangles(coarse.mesh.boundary);
  for (Triangle t : boundary.triangles) {
    if (!std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return mesh.points[std::size_t(v)].x == 0; })) continue;
    for (std::int32_t &v : t) v = place[std::size_t(v)];
    EXPECT_EQ(now.count(lowest_first(t)), 1u);
  }
}

/// Along z nothing changes but linearly: an eighth of the vertices is enough.
TEST_F(DecimateSolid, LosesNothingWhereTheFieldIsLinear) {
  Mesh mesh = kuhn_cube(8);
  const auto field = [](const Vec3 &p) { return std::abs(p.x - 0.5) + 2 * p.z - p.y; };
  set_scalars(mesh, field);
  start_with(mesh);
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.05, host, coarse));
  expect_sound(coarse);
  for (std::size_t v = 0; v < coarse.mesh.points.size(); v++)
    EXPECT_NEAR(coarse.mesh.scalars[v], field(coarse.mesh.points[v]), 1e-9);
}

TEST_F(DecimateSolid, PointsThatNoTetUsesChangeNothing) {
  Mesh mesh = kuhn_cube(8);
  set_scalars(mesh, waves);
  start_with(mesh);
  CoarseSolid without(host.memory), with(host.memory);
  ASSERT_TRUE(decimate(0.1, host, without));
  mesh.points.push_back(Vec3(1e6));
  mesh.scalars.push_back(-1e150);
  start_with(mesh);
  ASSERT_TRUE(decimate(0.1, host, with));
  expect_same(with.mesh, without.mesh);
}

TEST_F(DecimateSolid, RefusesTetsThatOverlap) {
  Mesh mesh = kuhn_cube(4);
  set_scalars(mesh, waves);
  const std::size_t middle = [&] {
    for (std::size_t v = 0; v < mesh.points.size(); v++)
      if (mesh.points[v] == Vec3(0.5)) return v;
    return std::size_t(0);
  }();
  mesh.points[middle] = Vec3(0.9, 0.5, 0.5);  // beyond its neighbours
  start_with(mesh);
  std::vector<std::uint8_t> kept(mesh.points.size(), 0);
  kept[middle] = 1;
  options.kept = {kept.data(), kept.size()};
  CoarseSolid coarse(host.memory);
  EXPECT_FALSE(decimate(0.9, host, coarse));
  EXPECT_NE(failure.find("the volume is "), std::string::npos) << failure;
}

/// A state begins careful collapses only where nothing was collapsed carelessly that they would look at.
TEST_F(DecimateSolid, CareBeginsAtNoStateThatIsTooCoarse) {
  Mesh plates;
  for (int k = 0; k < 3; k++) {
    Mesh plate = kuhn_cube(14);
    transform(plate, [k](const Vec3 &p) {
      return Vec3(p.x, p.y, 0.1 * k + 0.06 * std::sin(9 * p.x) * std::sin(7 * p.y) + 0.099 * p.z);
    });
    append(plates, plate);
  }
  set_scalars(plates, waves);
  start_with(plates);
  const auto collapse = [&](double ratio, SolidHistory &history, TetMesh &mesh) {
    options.tets = std::int64_t(ratio * double(original.tets.size()));
    Array<std::int32_t> origin(&host.memory);
    const MeshView view = original.view();
    return decimate_solid({view, boundary, surface, topology, tree, contacts}, options, history, host.job, mesh,
                          origin);
  };
  SolidHistory with(host.memory), without(host.memory);
  TetMesh careless(host.memory), careful(host.memory), alone(host.memory);
  collapse(0.02, with, careless);
  ASSERT_GE(with.states<1>(host.memory).size(), 3U);
  options.careful_from = std::int64_t(original.tets.size() / 2);
  EXPECT_GT(collapse(0.04, with, careful), 0);
  EXPECT_EQ(collapse(0.04, without, alone), 0);
  expect_same(careful, alone);
}

TEST_F(DecimateSolid, KeepsRestoredVerticesAndForgetsTheOthersStates) {
  Mesh mesh = kuhn_cube(14);
  set_scalars(mesh, waves);
  start_with(mesh);
  SolidHistory history(host.memory);
  CoarseSolid first(host.memory), coarse(host.memory);
  ASSERT_TRUE(decimate(0.05, host, history, first));
  ASSERT_FALSE(history.states<1>(host.memory).empty());
  std::vector<std::uint8_t> restored(mesh.points.size(), 0);
  for (std::size_t v = 0; v < mesh.points.size(); v += 97) restored[v] = 1;
  options.restored = {restored.data(), restored.size()};
  ASSERT_TRUE(decimate(0.05, host, history, coarse));
  expect_sound(coarse);
  EXPECT_TRUE(history.states<1>(host.memory).empty());
  for (std::size_t v = 0; v < mesh.points.size(); v += 97) {
    const auto at = std::find(coarse.origin.begin(), coarse.origin.end(), std::int32_t(v)) - coarse.origin.begin();
    ASSERT_LT(at, std::ptrdiff_t(coarse.origin.size())) << v;
    EXPECT_EQ(coarse.mesh.points[std::size_t(at)], mesh.points[v]);
    EXPECT_EQ(coarse.mesh.scalars[std::size_t(at)], mesh.scalars[v]);
  }
}

// ---- The link condition

using Simplex = std::set<std::int32_t>;
constexpr std::int32_t cone = -1;  // the vertex that all of the boundary is joined to

std::set<Simplex> link_of(const std::vector<Simplex> &maximal, const Simplex &of) {
  std::set<Simplex> link;
  for (const Simplex &s : maximal) {
    if (!std::includes(s.begin(), s.end(), of.begin(), of.end())) continue;
    std::vector<std::int32_t> rest;
    std::set_difference(s.begin(), s.end(), of.begin(), of.end(), std::back_inserter(rest));
    for (std::size_t some = 1; some < std::size_t(1) << rest.size(); some++) {
      Simplex face;
      for (std::size_t k = 0; k < rest.size(); k++)
        if ((some >> k) & 1u) face.insert(rest[k]);
      link.insert(face);
    }
  }
  return link;
}

bool satisfies_link_condition(const std::vector<Simplex> &maximal, std::int32_t a, std::int32_t b) {
  const std::set<Simplex> of_a = link_of(maximal, {a}), of_b = link_of(maximal, {b});
  std::set<Simplex> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::inserter(common, common.end()));
  return common == link_of(maximal, {a, b});
}

double volume6(const Mesh &mesh, const Tet &t) {
  const auto p = [&](std::size_t k) { return mesh.points[std::size_t(t[k])]; };
  return det(p(0), p(1), p(2), p(3));
}

/// Every pair of tets for which that can be done becomes three around a new edge. The triangle that they shared is
/// none of the mesh then, but its edges are: the ends of each share a neighbour that no tet at the edge has.
void flip_pairs(Mesh &mesh) {
  for (std::size_t i = 0; i < mesh.tets.size(); i++)
    for (std::size_t j = 0; j < i; j++) {
      const Tet one = mesh.tets[i], two = mesh.tets[j];
      const auto not_in = [](const Tet &t) {
        return [&t](std::int32_t v) { return std::find(t.begin(), t.end(), v) == t.end(); };
      };
      if (std::count_if(one.begin(), one.end(), not_in(two)) != 1) continue;
      const std::int32_t apex = *std::find_if(one.begin(), one.end(), not_in(two)),
                         other_apex = *std::find_if(two.begin(), two.end(), not_in(one));
      std::vector<Tet> three;
      for (std::int32_t shared : one)
        if (shared != apex) {
          three.push_back(one);
          std::replace(three.back().begin(), three.back().end(), shared, other_apex);
        }
      const auto keeps_side = [&](const Tet &t) { return volume6(mesh, t) / volume6(mesh, one) > 0.01; };
      if (!std::all_of(three.begin(), three.end(), keeps_side)) continue;
      mesh.tets[i] = three[0];
      mesh.tets[j] = three[1];
      mesh.tets.push_back(three[2]);
    }
}

TEST_F(DecimateSolid, WhatItAdmitsSatisfiesTheLinkCondition) {
  int admitted = 0, of_boundary = 0, removed = 0, refused = 0;
  std::vector<Mesh> meshes = {kuhn_cube(1), kuhn_cube(3), kuhn_solid({4, 1, 1}, [](const Cell &) { return true; })};
  meshes.push_back(kuhn_solid({3, 3, 1}, [](const Cell &c) { return c[0] != 1 || c[1] != 1; }));  // a ring
  meshes.push_back(kuhn_solid({3, 3, 3}, [](const Cell &c) { return c != Cell{1, 1, 1}; }));      // a shell
  for (unsigned seed = 0; seed < 20; seed++) meshes.push_back(random_solid(3, 0.9, seed));
  for (unsigned seed = 0; seed < 4; seed++) {
    meshes.push_back(kuhn_cube(4));
    jitter(meshes.back(), 0.05, seed);
    meshes.push_back(meshes.back());
    flip_pairs(meshes.back());
  }
  for (const Mesh &mesh : meshes) {
    start_with(mesh);
    if (topology.nonmanifold_points > 0 || topology.nonmanifold_edges > 0) continue;
    const SolidComplex solid(put_in_order(mesh.view(), boundary, host.job), host.job);
    std::vector<Simplex> maximal;
    for (const Tet &t : solid.tets) maximal.emplace_back(t.begin(), t.end());
    for (const Triangle &t : solid.triangles) maximal.push_back({t[0], t[1], t[2], cone});
    Neighbours neighbours(host.memory);
    for (std::int32_t a = 0; a < std::int32_t(solid.points.size()); a++) {
      solid.find_neighbours(a, neighbours);
      for (std::int32_t b : neighbours) {
        if (solid.rank(b) > solid.rank(a)) continue;
        const KeptOfFlat kept{0.7, 0};
        SolidEdge edge, of_removal;
        Star star(host.memory);
        const Vec3 &place = solid.point(a);
        const bool on_boundary = solid.on_boundary(b);
        const bool keeps_tets = look_around(solid, a, b, edge) && !flattens(solid, edge, place, kept);
        if (!on_boundary) {
          EXPECT_EQ(look_around_removal(solid, a, b, kept, of_removal), keeps_tets) << "edge " << a << " " << b;
          removed += keeps_tets;
        }
        const bool admits =
            keeps_tets && (!on_boundary || (look_around_on_boundary(solid, edge, place, star) && !folds(star)));
        EXPECT_TRUE(!admits || satisfies_link_condition(maximal, a, b)) << "edge " << a << " " << b;
        (admits ? admitted : refused)++;
        of_boundary += admits && on_boundary;
      }
    }
  }
  EXPECT_GT(admitted, 100);
  EXPECT_GT(of_boundary, 100);
  EXPECT_GT(removed, 100);
  EXPECT_GT(refused, 100);
}

/// Rims of flat bodies are sharper than any fold may get: they do as long as they get no sharper by much.
TEST_F(DecimateSolid, AFlatBodyReachesItsSizeAsRulesGiveWay) {
  Mesh flat = flat_body();
  set_scalars(flat, waves);
  start_with(flat);
  for (double ratio : {0.2, 0.1}) {
    CoarseSolid strict(host.memory), coarse(host.memory);
    options.may_relax = false;
    decimate(ratio, host, strict);
    expect_sound(strict);
    EXPECT_EQ(failure.empty(), ratio > 0.1) << failure;
    options.may_relax = true;
    EXPECT_TRUE(decimate(ratio, host, coarse)) << failure;
    expect_sound(coarse);
    EXPECT_LT(coarse.deviation, 0.035 * box_of(surface.points).diagonal());
  }
}

/// Nothing but the distance holds the end of a slit, which slides along the others' planes.
TEST_F(DecimateSolid, SlitsKeepTheirLengthWhereTheSizeIsMetAllTheSame) {
  Mesh slab = slab_with_slits(12, 8);
  set_scalars(slab, waves);
  start_with(slab);
  for (const double ratio : {0.2, 0.1}) {
    CoarseSolid coarse(host.memory);
    EXPECT_TRUE(decimate(ratio, host, coarse)) << failure;
    expect_sound(coarse);
    EXPECT_LT(coarse.deviation, 2 * far_off * box_of(surface.points).diagonal()) << ratio;
  }
}

}  // namespace
}  // namespace tetlod
