// Which solid a vertex is of, and what became of it, where solids have places in common.
#include <gtest/gtest.h>

#include <set>

#include "adaptive_meshes.hpp"
#include "errors_outside.hpp"
#include "hold_bound.hpp"
#include "place_probes.hpp"
#include "solids.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Of a random solid: by looking at all pairs of tets.
std::vector<std::set<int>> brute_solids_at_vertices(const Mesh &mesh) {
  std::vector<int> solid(mesh.tets.size());
  std::iota(solid.begin(), solid.end(), 0);
  const auto have_a_face = [](const Tet &a, const Tet &b) {
    return std::count_if(a.begin(), a.end(), [&](auto v) { return std::count(b.begin(), b.end(), v) > 0; }) == 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < solid.size(); i++)
      for (std::size_t j = 0; j < i; j++)
        if (solid[i] != solid[j] && have_a_face(mesh.tets[i], mesh.tets[j])) {
          solid[i] = solid[j] = std::min(solid[i], solid[j]);
          changed = true;
        }
  }
  std::vector<std::set<int>> at(mesh.points.size());
  for (std::size_t t = 0; t < solid.size(); t++)
    for (const std::int32_t v : mesh.tets[t]) at[std::size_t(v)].insert(solid[t]);
  return at;
}

TEST(Solids, AreWhatHangsTogetherByFaces) {
  for (unsigned seed = 1; seed < 6; seed++) {
    const Mesh mesh = random_solid(4, 0.3, seed);
    Host host(2);
    const Array<std::int32_t> solid = solids_of_vertices(mesh.view(), host.job);
    const std::vector<std::set<int>> expected = brute_solids_at_vertices(mesh);
    for (std::size_t v = 0; v < solid.size(); v++)
      EXPECT_EQ(solid[v], expected[v].size() == 1 ? *expected[v].begin() : -1) << seed << ' ' << v;
  }
}

/// Two cubes that reach into each other, of different values; the second's vertices in the first are not in its tets.
class TwoCubes : public testing::Test {
 protected:
  TwoCubes() {
    append(cube(0), 1);
    append(cube(0.7), 5);
    solid = solids_of_vertices(original.view(), host.job);
    adapt(original, host, mesh);
    mesh.solid = solid;
  }
  static Mesh cube(double x) {
    Mesh part = kuhn_cube(4);
    transform(part, [x](const Vec3 &p) { return p + Vec3(x, 0.05, 0.05); });
    return part;
  }
  void append(Mesh part, double value) {
    set_scalars(part, [value](const Vec3 &) { return value; });
    test::append(original, part);
  }
  double largest(Span<const std::int32_t> solids) {
    MeshView view = original.view();
    view.solid = solids;
    ProbeOptions options;
    options.most_vertices = 1e9;
    options.most_inner = 0;
    options.project_outside = true;
    place_probes(view, options, host.job, mesh);
    const double outside = errors_outside(view, 1e9, host.job, mesh).largest;
    return std::max(largest_error(mesh, host.job).value, outside);
  }

  Host host{2};
  Mesh original;
  AdaptiveMesh<1> mesh{host.memory};
  Array<std::int32_t> solid{&host.memory};
};

TEST_F(TwoCubes, EachVertexIsLookedForInItsOwn) {
  EXPECT_EQ(largest({}), 4);
  EXPECT_EQ(largest(solid), 0);
}

TEST_F(TwoCubes, WhatLiesOutsideIsComparedWithTheNearestOfItsOwn) {
  for (Vec3 &p : mesh.points) p = Vec3(p.x > 0.6 ? p.x + 0.15 : p.x, p.y, p.z);  // also sides that lie in the other
  EXPECT_NEAR(largest(solid), 0, 1e-14);
  EXPECT_GT(std::count(mesh.outside.begin(), mesh.outside.end(), 1), 0);
}

TEST_F(TwoCubes, WhatIsNotKnownMayHoldAnything) {
  const SolidsOfTets known(mesh, solid, host.job);
  mesh.solid.assign(mesh.points.size(), -1);
  const SolidsOfTets unknown(mesh, solid, host.job), none(mesh, {}, host.job);
  const auto last_tet = std::int32_t(mesh.tets.size()) - 1, last = std::int32_t(mesh.points.size()) - 1;
  EXPECT_TRUE(known.may_hold(last_tet, last));
  EXPECT_FALSE(known.may_hold(0, last));
  EXPECT_FALSE(known.may_hold(last_tet, 0));
  for (const SolidsOfTets *of : {&unknown, &none}) EXPECT_TRUE(of->may_hold(0, last));
}

}  // namespace
}  // namespace tetlod
