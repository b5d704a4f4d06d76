// Collapses whose tets would turn over, unless tets beyond give way.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "decimate_solid_fixture.hpp"
#include "solid_rules.hpp"
#include "widen_cavity.hpp"

namespace tetlod {
namespace {

using namespace test;

class WidenCavity : public DecimateSolid {
 protected:
  SolidComplex solid_of(const Mesh &mesh) {
    start_with(mesh);
    return SolidComplex(put_in_order(original.view(), boundary, host.job), host.job);
  }

  /// visit(edge, place) of edges whose end that goes is inside, at a place near them where tets turn over.
  template <class Visit>
  void for_turning_edges(const SolidComplex &solid, unsigned seed, const Visit &visit) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-0.4, 0.4);
    Neighbours neighbours(host.memory);
    for (std::int32_t a = 0; a < std::int32_t(solid.points.size()); a++) {
      solid.find_neighbours(a, neighbours);
      for (std::int32_t b : neighbours) {
        SolidEdge edge;
        if (solid.rank(b) != Rank::inner || !look_around(solid, a, b, edge)) continue;
        const Vec3 d = solid.point(b) - solid.point(a);
        const Vec3 step = glm::length(d) * Vec3(any(random), any(random), any(random));
        const Vec3 place = solid.rank(a) == Rank::inner ? solid.point(a) + 0.5 * d + step : solid.point(a);
        if (flattens(solid, edge, place, {1, 0})) visit(edge, place);
      }
    }
  }

  SolidBlocks whole{1, host.memory};  // one block
};

double volume6(const SolidComplex &solid, const Tet &t, std::int32_t moved = -1, const Vec3 &to = Vec3(0)) {
  const auto at = [&](std::size_t i) { return t[i] == moved ? to : solid.point(t[i]); };
  return det(at(0), at(1), at(2), at(3));
}

using Face = std::set<std::int32_t>;

/// Those of one of the tets alone, without a vertex.
template <class Tets>
std::set<Face> outer_faces(const Tets &tets, const std::set<std::int32_t> &without) {
  std::map<Face, int> count;
  for (const Tet &t : tets)
    for (std::size_t k = 0; k < 4; k++) {
      Face face(t.begin(), t.end());
      face.erase(t[k]);
      count[face]++;
    }
  std::set<Face> outer;
  for (const auto &[face, times] : count) {
    const bool has_end = std::any_of(face.begin(), face.end(), [&](std::int32_t v) { return without.count(v) > 0; });
    if (times == 1 && !has_end) outer.insert(face);
  }
  return outer;
}

std::vector<Tet> tets_at(const SolidComplex &solid, const Cavity &numbers) {
  std::vector<Tet> tets;
  for (std::int32_t t : numbers) tets.push_back(solid.tets[std::size_t(t)]);
  return tets;
}

TEST_F(WidenCavity, FillsWhatItTakesWithPositiveTets) {
  int widened = 0, refused = 0, beyond = 0;
  for (unsigned seed = 0; seed < 6; seed++) {
    Mesh mesh = kuhn_cube(5);
    jitter(mesh, 0.04, seed);
    const SolidComplex solid = solid_of(mesh);
    for_turning_edges(solid, seed, [&](SolidEdge &edge, const Vec3 &place) {
      if (!widen_cavity(solid, whole, place, edge)) {
        EXPECT_FALSE(edge.is_widened());
        refused++;
        return;
      }
      widened++;
      beyond += int(edge.cavity.size() - edge.tets_around());
      EXPECT_GE(2 * edge.tets_saved(), edge.edge_tets.size());
      const std::vector<Tet> old = tets_at(solid, edge.cavity);
      double before = 0, after = 0;
      for (const Tet &t : old) before += volume6(solid, t);
      for (const Tet &t : edge.fresh) {
        EXPECT_GT(volume6(solid, t, edge.stays, place), 0);
        after += volume6(solid, t, edge.stays, place);
      }
      EXPECT_NEAR(after, before, 1e-12);
      EXPECT_EQ(outer_faces(edge.fresh, {edge.stays}), outer_faces(old, {edge.stays, edge.gone}));
    });
  }
  EXPECT_GT(widened, 500);
  EXPECT_GT(refused, 500);
  EXPECT_GT(beyond, widened);
}

/// One collapse after another: the mesh hangs together as its tets say, and covers the same.
TEST_F(WidenCavity, ManyLeaveASolidWhole) {
  Mesh mesh = kuhn_cube(6);
  jitter(mesh, 0.05, 3);
  SolidComplex solid = solid_of(mesh);
  CollapseRoom room(host.memory);
  const auto count_tets = [&] {
    return std::count_if(solid.tets.begin(), solid.tets.end(), [](const Tet &t) { return t[0] >= 0; });
  };
  int widened = 0;
  for (unsigned seed = 0; seed < 4; seed++)
    for_turning_edges(solid, seed, [&](SolidEdge &edge, const Vec3 &place) {
      if (!widen_cavity(solid, whole, place, edge)) return;
      const auto before = count_tets();
      solid.collapse(edge, place, room);
      EXPECT_EQ(count_tets(), before - std::int64_t(edge.tets_saved()));
      EXPECT_FALSE(solid.has_vertex(edge.gone));
      EXPECT_FALSE(solid.has_edge(edge.stays, edge.gone));
      widened++;
    });
  EXPECT_GT(widened, 40);
  double volume = 0;
  std::map<Face, int> faces;
  std::vector<std::set<std::int32_t>> star(solid.points.size());
  for (std::size_t i = 0; i < solid.tets.size(); i++) {
    const Tet &t = solid.tets[i];
    if (t[0] < 0) continue;
    volume += volume6(solid, t) / 6;
    EXPECT_GT(volume6(solid, t), 0);
    for (std::size_t k = 0; k < 4; k++) {
      Face face(t.begin(), t.end());
      face.erase(t[k]);
      faces[face]++;
      star[std::size_t(t[k])].insert(std::int32_t(i));
    }
  }
  EXPECT_NEAR(volume, solid.measures.volume, 1e-12);
  for (const auto &[face, times] : faces) EXPECT_LE(times, 2);
  std::size_t once = 0;
  for (const auto &[face, times] : faces) once += times == 1;
  EXPECT_EQ(once, solid.triangles.size());
  for (std::size_t v = 0; v < star.size(); v++) {
    std::set<std::int32_t> found;
    for (std::int32_t t : solid.tets_of.of(std::int32_t(v)))
      if (solid.has_tet(t)) found.insert(t);
    EXPECT_EQ(found, star[v]) << v;
  }
}

/// What another thread may change stays out of it.
TEST_F(WidenCavity, StaysInItsBlock) {
  Mesh mesh = kuhn_cube(26);
  jitter(mesh, 0.01, 1);
  const SolidComplex solid = solid_of(mesh);
  Array<std::int32_t> all(solid.points.size(), 0, &host.memory);
  std::iota(all.begin(), all.end(), 0);
  SolidBlocks blocks(all.size(), host.memory);
  blocks.cut(solid, all, 0, SolidBlocks::most, host.job);
  ASSERT_GT(blocks.count(), 1u);
  int inside = 0, refused = 0;
  for_turning_edges(solid, 1, [&](SolidEdge &edge, const Vec3 &place) {
    if (!blocks.is_inside(edge.stays) || !blocks.is_inside(edge.gone)) return;
    if (!widen_cavity(solid, blocks, place, edge)) {
      refused += widen_cavity(solid, whole, place, edge);
      return;
    }
    inside++;
    for (const Tet &t : tets_at(solid, edge.cavity))
      for (std::int32_t v : t) EXPECT_EQ(blocks.of(v), blocks.of(edge.stays));
  });
  EXPECT_GT(inside, 1000);
  EXPECT_GT(refused, 10);
}

/// Eight rooms with walls of one cell: edges hardly collapse there but where tets would turn over, as both sides are in
/// the way.
TEST_F(WidenCavity, ThinWallsReachASmallSize) {
  for (const auto &[n, ratio] : {std::pair(12, 0.05), {16, 0.03}, {20, 0.02}}) {
    const auto is_wall = [last = n - 1](const Cell &c) {
      return std::any_of(c.begin(), c.end(), [&](int i) { return i == 0 || i == last || i == (last + 1) / 2; });
    };
    Mesh rooms = kuhn_solid({n, n, n}, is_wall);
    set_scalars(rooms, waves);
    start_with(rooms);
    CoarseSolid coarse(host.memory);
    EXPECT_TRUE(decimate(ratio, host, coarse)) << failure;
    expect_sound(coarse);
    EXPECT_LT(coarse.deviation, far_off * box_of(surface.points).diagonal());
  }
}

}  // namespace
}  // namespace tetlod
