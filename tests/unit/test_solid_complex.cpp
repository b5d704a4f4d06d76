// What is around the vertices of a solid while edges collapse: neighbours, borders of blocks, and room for states.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "decimate_solid_fixture.hpp"
#include "solid_blocks.hpp"

namespace tetlod {
namespace {

using namespace test;

std::set<std::int32_t> brute_neighbours(const SolidComplex &solid, std::int32_t v) {
  std::set<std::int32_t> found;
  for (const Tet &t : solid.tets)
    if (t[0] >= 0 && std::find(t.begin(), t.end(), v) != t.end()) found.insert(t.begin(), t.end());
  found.erase(v);
  return found;
}

/// Every triangle of the boundary and one vertex in the middle.
Mesh hub(int n) {
  Mesh mesh = kuhn_cube(n);
  Host host;
  Boundary boundary(host.memory);
  extract_boundary(mesh.view(), host.job, boundary);
  mesh.tets.clear();
  const auto middle = std::int32_t(mesh.points.size());
  for (const Triangle &t : boundary.triangles) mesh.tets.push_back({middle, t[0], t[1], t[2]});
  mesh.points.push_back(Vec3(0.5));
  return mesh;
}

class SolidAround : public DecimateSolid {
 protected:
  SolidComplex solid_of(const Mesh &mesh) {
    start_with(mesh);
    return SolidComplex(put_in_order(original.view(), boundary, host.job), host.job);
  }
  /// As if collapses had taken some of the tets away.
  static void take_away_some(SolidComplex &solid, unsigned seed) {
    std::mt19937 random(seed);
    for (Tet &t : solid.tets)
      if (random() % 4 == 0) t[0] = -1;
  }
};

TEST_F(SolidAround, NeighboursAreThoseOfTheTetsThatAreLeft) {
  std::vector<Mesh> meshes = {kuhn_cube(1), kuhn_cube(6), hub(9)};
  for (unsigned seed = 0; seed < 4; seed++) meshes.push_back(random_solid(4, 0.7, seed));
  Neighbours neighbours(host.memory);  // the same for all, as collapses have it
  for (const Mesh &mesh : meshes) {
    SolidComplex solid = solid_of(mesh);
    for (const bool whole : {true, false}) {
      if (!whole) take_away_some(solid, 1);
      for (std::int32_t v = 0; v < std::int32_t(solid.points.size()); v++) {
        solid.find_neighbours(v, neighbours);
        EXPECT_EQ(std::set<std::int32_t>(neighbours.begin(), neighbours.end()), brute_neighbours(solid, v)) << v;
      }
    }
  }
}

/// What comes again is looked at again.
TEST_F(SolidAround, HardlyANeighbourComesTwice) {
  const SolidComplex solid = solid_of(kuhn_cube(12));
  Neighbours neighbours(host.memory);
  std::ptrdiff_t found = 0, different = 0;
  for (std::int32_t v = 0; v < std::int32_t(solid.points.size()); v++) {
    solid.find_neighbours(v, neighbours);
    found += neighbours.end() - neighbours.begin();
    different += std::ptrdiff_t(std::set<std::int32_t>(neighbours.begin(), neighbours.end()).size());
  }
  EXPECT_LT(double(found), 1.1 * double(different));
}

/// Against the sum over the tets that each vertex began with, of which the quadrics are made.
TEST_F(SolidAround, RemovalsCostTheErrorsOfTheFunctionsAround) {
  Mesh mesh = kuhn_cube(4);
  std::mt19937 random(3);
  for (Vec3 &p : mesh.points) p += 0.05 * Vec3(double(random()), double(random()), double(random())) * 0x1p-32;
  set_scalars(mesh, waves);
  start_with(mesh);
  const FieldsAsLengths<1> fields(original.view(), 1, host.job);
  const SolidMesh<1> solid(put_in_order(original.view(), boundary, host.job), original.view().values<1>(),
                           fields.scales, 1, host.job);
  Neighbours neighbours(host.memory);
  std::size_t removals = 0;
  for (std::int32_t v = 0; v < std::int32_t(solid.points.size()); v++) {
    if (solid.on_boundary(v)) continue;
    solid.find_neighbours(v, neighbours);
    std::multiset<std::int32_t> visited;
    solid.for_removals(v, neighbours, [&](std::int32_t u, double cost) {
      const auto d = minus(solid.place(u), solid.place(v));
      double expected = 0;
      for (std::int32_t t : solid.tets_of.of(v)) {
        const Tet &tet = solid.tets[std::size_t(t)];
        const auto normals =
            upright_normals<1>({solid.place(tet[0]), solid.place(tet[1]), solid.place(tet[2]), solid.place(tet[3])});
        const double off = dot<4>(normals[0], d);
        expected += off * off + 1e-8 * length2(point_of(d));
      }
      EXPECT_NEAR(cost, expected, 1e-12 + 1e-9 * expected);
      visited.insert(u);
      removals++;
    });
    EXPECT_EQ(visited, std::multiset<std::int32_t>(neighbours.begin(), neighbours.end()));
  }
  EXPECT_GT(removals, 300u);
}

TEST_F(SolidAround, BlocksKnowTheirBorders) {
  SolidComplex solid = solid_of(kuhn_cube(26));
  take_away_some(solid, 2);
  Array<std::int32_t> all(solid.points.size(), 0, &host.memory);
  std::iota(all.begin(), all.end(), 0);
  SolidBlocks blocks(all.size(), host.memory);
  for (int round = 0; round < 3; round++) {
    blocks.cut(solid, all, round, SolidBlocks::most, host.job);
    ASSERT_GT(blocks.count(), 1u);
    std::vector<bool> inside(all.size(), true);
    for (const Tet &t : solid.tets) {
      if (t[0] < 0) continue;
      const auto away = [&](std::int32_t v) { return blocks.of(v) != blocks.of(t[0]); };
      if (std::any_of(t.begin(), t.end(), away))
        for (std::int32_t v : t) inside[std::size_t(v)] = false;
    }
    for (std::int32_t v : all) EXPECT_EQ(blocks.is_inside(v), inside[std::size_t(v)]) << v << " in round " << round;
  }
  blocks.cut(solid, all, 3, 1, host.job);
  EXPECT_TRUE(std::all_of(all.begin(), all.end(), [&](std::int32_t v) { return blocks.is_inside(v); }));
}

TEST_F(SolidAround, StatesLeaveRoomForWhatComesLater) {
  Mesh mesh = kuhn_cube(16);
  set_scalars(mesh, waves);
  start_with(mesh);
  const auto bytes_of_states = [&](std::size_t later, bool one_of_many) {
    host.memory.reset_peak();
    options.later = later;
    options.one_of_many = one_of_many;
    SolidHistory history(host.memory);
    CoarseSolid coarse(host.memory);
    EXPECT_TRUE(decimate(0.05, host, history, coarse)) << failure;
    std::size_t sum = 0;
    for (const SolidState<1> &state : history.states<1>(host.memory))
      sum += state.remains.bytes() + state.progress.bytes();
    return sum;
  };
  const std::size_t alone = bytes_of_states(0, false), peak = host.memory.peak(), later = peak - alone / 4;
  EXPECT_GT(alone, 0u);
  const std::size_t kept = bytes_of_states(later, false);
  EXPECT_LT(kept, alone);
  EXPECT_LE(later + kept, host.memory.peak());
  EXPECT_GT(bytes_of_states(later, true), kept) << "other sizes are likely to follow";
  EXPECT_EQ(bytes_of_states(2 * peak, true), 0u);
}

}  // namespace
}  // namespace tetlod
