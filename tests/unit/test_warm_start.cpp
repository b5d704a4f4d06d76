// New values on what collapses of earlier ones left: the quadrics are those of the original, and the result is near.
#include "decimate_solid_fixture.hpp"
#include "renew_quadrics.hpp"
#include "solid_places.hpp"
#include "tet_frame.hpp"

namespace tetlod {
namespace {

using namespace test;

class WarmStart : public DecimateSolid {
 protected:
  WarmStart() { options.warm_start = 0.1; }

  static double front(const Vec3 &p, double at) { return std::tanh(8 * (glm::length(p) - at)); }

  void start_with_front(int cells, double at) {
    Mesh mesh = kuhn_cube(cells);
    set_scalars(mesh, [&](const Vec3 &p) { return front(p, at); });
    start_with(mesh);
  }

  /// Another field on the same mesh, of which the history has the one before.
  std::int64_t go_on_with(const Field &field, double ratio, Host &on, SolidHistory &history, CoarseSolid &coarse) {
    set_scalars(original, field);
    start_with(original);
    history.begin(original.view(), {false, false, true}, on.job);
    EXPECT_TRUE(decimate(ratio, on, history, coarse)) << failure;
    return coarse.reused;
  }

  /// What the tets that became a part of a vertex say of its value, as they are continued to it.
  double squared_error(const SolidState<1> &state, const FieldsAsLengths<1> &fields, std::int32_t vertex,
                       double length) const {
    double sum = 0;
    const Vec3 at = state.remains.points[std::size_t(vertex)];
    for (const Tet &t : original.tets) {
      Vec3 p[4];
      double value[4];
      for (std::size_t k = 0; k < 4; k++) {
        p[k] = original.points[std::size_t(t[k])];
        value[k] = fields.scales[0] * original.scalars[std::size_t(t[k])];
      }
      double w[4];
      TetFrame(p[0], p[1], p[2], p[3]).weights(at, w);
      const double off = length - (w[0] * value[0] + w[1] * value[1] + w[2] * value[2] + w[3] * value[3]);
      for (std::int32_t v : t) sum += state.progress.home[std::size_t(v)] == vertex ? off * off : 0;
    }
    for (const Triangle &t : boundary.triangles) {
      const auto p = [&](std::size_t k) { return original.points[std::size_t(t[k])]; };
      const double off = glm::dot(glm::normalize(area_vector(p(0), p(1), p(2))), at - p(0));
      for (std::int32_t v : t)
        if (state.progress.home[std::size_t(v)] == vertex) sum += state.remains.measures.weight_of_planes * off * off;
    }
    return sum;
  }
};

TEST_F(WarmStart, QuadricsAreThoseOfTheOriginal) {
  start_with_front(8, 0.6);
  transform(original, [](const Vec3 &p) { return p + 0.05 * Vec3(std::sin(7 * p.y), 0, std::sin(6 * p.x)); });
  start_with(original);
  SolidHistory history(host.memory);
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.1, host, history, coarse)) << failure;
  const Array<SolidState<1>> &states = history.states<1>(host.memory);
  ASSERT_FALSE(states.empty());
  set_scalars(original, waves);
  const FieldsAsLengths<1> fields(original.view(), 1, host.job);
  for (const SolidState<1> &state : states) {
    ASSERT_TRUE(state.progress.follows());
    SolidRemains<1> remains(state.remains, host.memory);
    const double error = renew_quadrics<1>(original.view(), boundary, fields, state.progress.home, host.job, remains);
    double sum = 0;
    for (std::size_t v = 0; v < remains.points.size(); v++) {
      const double length = remains.lengths[v][0];
      const double at = squared_error(state, fields, std::int32_t(v), length);
      sum += at;
      const LocalQuadric<4> &quadric = remains.quadrics[v];
      for (double step : {0.01, -0.02}) {
        const double change = squared_error(state, fields, std::int32_t(v), length + step) - at;
        EXPECT_NEAR(quadric.a.back() * step * step + 2 * quadric.g[3] * step, change, 1e-9);
        const bool has_moved = remains.points[v] != original.points[std::size_t(remains.origin[v])];
        EXPECT_TRUE(!has_moved || change > -1e-9) << "its value is the best";
      }
    }
    EXPECT_NEAR(error, sum, 1e-9 * (1 + sum));
  }
}

/// Those of other values may begin there, and rules do not hold there any more.
TEST_F(WarmStart, KeepsNoStateOfSharpFolds) {
  Mesh flat = flat_body();
  set_scalars(flat, waves);
  start_with(flat);
  options.may_relax = true;
  SolidHistory history(host.memory);
  CoarseSolid coarse(host.memory);
  ASSERT_TRUE(decimate(0.03, host, history, coarse)) << failure;
  ASSERT_FALSE(history.states<1>(host.memory).empty());
  for (const SolidState<1> &state : history.states<1>(host.memory))
    EXPECT_LT(state.progress.relaxed, SolidPlaces<1>::most_for_slivers);
}

/// Another way from there on: no coarser state begins it, and it leaves none.
TEST_F(WarmStart, WhereRulesGiveWayEarlyAHistoryServesNoLess) {
  Mesh flat = flat_body();
  set_scalars(flat, waves);
  start_with(flat);
  options.may_relax = true;
  options.warm_start = 0;
  SolidHistory history(host.memory);
  CoarseSolid late(host.memory), early(host.memory), again(host.memory);
  decimate(0.1, host, history, late);
  const std::size_t states = history.states<1>(host.memory).size();
  decimate(0.1, host, history, again);
  EXPECT_GT(again.reused, 0);
  options.relaxed_from = std::int64_t(flat.tets.size());
  EXPECT_TRUE(decimate(0.1, host, early)) << failure;
  expect_sound(early);
  EXPECT_NE(early.mesh.points, late.mesh.points);
  decimate(0.1, host, history, again);
  expect_same(again.mesh, early.mesh);
  EXPECT_EQ(history.states<1>(host.memory).size(), states);
}

/// Where rules may relax further the way is another one from there on: nothing that comes after is kept.
TEST_F(WarmStart, KeepsNoStateThatIsNotOnTheWayOfAll) {
  Mesh slab = slab_with_slits(30, 8);
  transform(slab, [](const Vec3 &p) { return Vec3(p.x, p.y, p.z - 0.9 * std::min(std::max(p.z - 0.4, 0.0), 0.002)); });
  set_scalars(slab, waves);
  start_with(slab);
  std::vector<std::size_t> kept[2];
  for (const bool may_relax : {false, true}) {
    options.may_relax = may_relax;
    SolidHistory history(host.memory);
    CoarseSolid coarse(host.memory);
    decimate(0.02, host, history, coarse);
    for (const SolidState<1> &state : history.states<1>(host.memory))
      kept[may_relax].push_back(state.remains.tets.size());
  }
  EXPECT_FALSE(kept[0].empty());
  EXPECT_EQ(kept[0], kept[1]);
}

TEST_F(WarmStart, BeginsWhereASlowFrontLeftTheSolid) {
  Host one;
  CoarseSolid with_one_thread(one.memory);
  for (int threads : {1, 2, 3}) {
    start_with_front(20, 0.6);
    Host on(threads);
    SolidHistory history(on.memory);
    CoarseSolid first(on.memory);
    history.begin(original.view(), {false, false, true}, on.job);
    ASSERT_TRUE(decimate(0.1, on, history, first));
    const std::size_t near = history.states<1>(on.memory).back().remains.tets.size();
    EXPECT_LT(near, std::size_t(2 * options.tets)) << "little is left to do";
    EXPECT_GT(near, std::size_t(options.tets));
    for (double at : {0.601, 0.603}) {
      CoarseSolid next(on.memory);
      const auto moved = [at](const Vec3 &p) { return front(p, at); };
      EXPECT_GT(go_on_with(moved, 0.1, on, history, next), std::int64_t(original.points.size() / 2)) << at;
      expect_sound(next);
      EXPECT_NEAR(double(next.mesh.tets.size()), double(options.tets), 2e-3 * double(options.tets));
      if (threads == 1)
        with_one_thread.mesh = next.mesh;
      else if (at == 0.603)
        expect_same(next.mesh, with_one_thread.mesh);
    }
  }
}

/// Where new values may begin other sizes of the same values may not.
TEST_F(WarmStart, OtherSizesOfTheSameValuesHaveTheirOwnBytes) {
  start_with_front(20, 0.6);
  for (bool hasty : {false, true}) {
    options.hasty = hasty;
    SolidHistory history(host.memory);
    history.begin(original.view(), {false, hasty, true}, host.job);
    for (double ratio :
         {0.1, 0.03, 0.06, 0.2, 0.01, 0.05, 0.11, 0.12, 0.13, 0.14, 0.15, 0.02, 0.022, 0.024, 0.026, 0.028}) {
      CoarseSolid next(host.memory), alone(host.memory);
      ASSERT_TRUE(decimate(ratio, host, history, next)) << failure;
      ASSERT_TRUE(decimate(ratio, host, alone)) << failure;
      expect_same(next.mesh, alone.mesh);
    }
  }
}

/// What is much to a rough field's error is little to a smooth one's.
TEST_F(WarmStart, BeginsAnewWhereTheValuesAreMuchSmoother) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1, 1);
  Mesh rough = kuhn_cube(12);
  set_scalars(rough, [&](const Vec3 &) { return noise(random); });
  start_with(rough);
  SolidHistory history(host.memory);
  CoarseSolid first(host.memory), next(host.memory), alone(host.memory);
  history.begin(original.view(), {false, false, true}, host.job);
  ASSERT_TRUE(decimate(0.1, host, history, first)) << failure;
  EXPECT_EQ(go_on_with([](const Vec3 &p) { return front(p, 0.6); }, 0.1, host, history, next), 0);
  ASSERT_TRUE(decimate(0.1, host, alone));
  expect_same(next.mesh, alone.mesh);
}

/// Nothing but what the caller's allocator gives.
TEST_F(WarmStart, TakesNoOtherMemory) {
  start_with_front(8, 0.6);
  std::pmr::memory_resource *const usual = std::pmr::set_default_resource(std::pmr::null_memory_resource());
  {
    SolidHistory history(host.memory);
    CoarseSolid first(host.memory), next(host.memory);
    history.begin(original.view(), {false, false, true}, host.job);
    EXPECT_NO_THROW(decimate(0.1, host, history, first));
    EXPECT_NO_THROW(go_on_with([](const Vec3 &p) { return front(p, 0.601); }, 0.1, host, history, next));
  }
  std::pmr::set_default_resource(usual);
}

TEST_F(WarmStart, BeginsAnewWhereTheValuesAreOthers) {
  start_with_front(12, 0.6);
  SolidHistory history(host.memory);
  CoarseSolid first(host.memory), next(host.memory), alone(host.memory);
  history.begin(original.view(), {false, false, true}, host.job);
  ASSERT_TRUE(decimate(0.1, host, history, first));
  EXPECT_EQ(go_on_with(waves, 0.1, host, history, next), 0);
  ASSERT_TRUE(decimate(0.1, host, alone));
  expect_same(next.mesh, alone.mesh);
}

}  // namespace
}  // namespace tetlod
