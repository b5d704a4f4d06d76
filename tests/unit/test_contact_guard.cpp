// Which changes would take a surface through itself: against all pairs of its triangles.
#include <gtest/gtest.h>

#include <random>

#include "brute_force.hpp"
#include "contact_guard.hpp"
#include "geometry.hpp"
#include "meshes.hpp"
#include "remesh_surfaces.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Blobs beside and in each other, whose vertices move, and whose triangles get vertices.
class Contacts : public testing::Test {
 protected:
  Host host;
  Surface surface{host.memory};
  std::mt19937_64 random{5};

  void start_with(unsigned seed) {
    surface = random_blob(host.memory, 3, seed);
    const Surface other = random_blob(host.memory, 3, seed + 1);
    for (const auto &[size, at] : {std::pair(0.4, Vec3(0)), {0.6, Vec3(1.8, 0, 0)}}) {
      const auto first = std::int32_t(surface.points.size());
      for (const Vec3 &p : other.points) surface.points.push_back(size * p + at);
      for (const Triangle &t : other.triangles) surface.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    ASSERT_TRUE(crossings(surface, host.memory).empty());
  }

  /// Triangles get a vertex each in their middle, which meets nothing.
  void divide(std::size_t times, ContactGuard &guard) {
    for (std::size_t i = 0; i < times; i++) {
      const auto t = std::int32_t(random() % surface.triangles.size());
      Change change = with_divided(t);
      surface.points.back() = TriangleInSpace(surface.points, surface.triangles[std::size_t(t)]).middle();
      make(change);
      guard.take({change.old.data(), change.old.size()});
    }
  }

  double uniform(double most) { return std::uniform_real_distribution<double>(-most, most)(random); }
  Vec3 somewhere() {
    const double most = random() % 4 ? 0.15 : 0.6;
    return {uniform(most), uniform(most), uniform(most)};
  }

  struct Change {
    std::vector<std::int32_t> old;
    std::vector<Triangle> fresh;
  };
  Change with_moved(std::int32_t v) {
    Change change;
    for (std::size_t t = 0; t < surface.triangles.size(); t++) {
      const Triangle &f = surface.triangles[t];
      if (std::find(f.begin(), f.end(), v) == f.end()) continue;
      change.old.push_back(std::int32_t(t));
      change.fresh.push_back(f);
    }
    surface.points[std::size_t(v)] += somewhere();
    return change;
  }
  Change with_divided(std::int32_t t) {
    const Triangle f = surface.triangles[std::size_t(t)];
    const auto v = std::int32_t(surface.points.size());
    Vec3 middle(0);
    for (std::int32_t corner : f) middle += surface.points[std::size_t(corner)] / 3.0;
    surface.points.push_back(middle + somewhere());
    return {{t}, {{v, f[1], f[2]}, {f[0], v, f[2]}, {f[0], f[1], v}}};
  }

  void make(const Change &change) {
    for (std::size_t i = 0; i < change.fresh.size(); i++)
      if (i < change.old.size())
        surface.triangles[std::size_t(change.old[i])] = change.fresh[i];
      else
        surface.triangles.push_back(change.fresh[i]);
  }
};

TEST_F(Contacts, AreThoseOfAllPairs) {
  std::size_t met = 0, made = 0, divided = 0;
  for (const auto &[seed, times, changes] : {std::tuple(1u, 0u, 150), {3u, 0u, 150}, {5u, 600u, 40}}) {
    start_with(seed);
    ContactGuard guard(surface.points, surface.triangles, host.job);
    divide(times, guard);
    for (int i = 0; i < changes; i++) {
      const bool moves = random() % 2 != 0;
      const Surface before = copy_of(surface, host);
      const auto any = [&](std::size_t count) { return std::int32_t(random() % count); };
      const Change change =
          moves ? with_moved(any(surface.points.size())) : with_divided(any(surface.triangles.size()));
      const bool is_met =
          guard.is_met({change.old.data(), change.old.size()}, {change.fresh.data(), change.fresh.size()});
      make(change);
      ASSERT_EQ(is_met, !crossings(surface, host.memory).empty()) << "seed " << seed << ", change " << i;
      met += is_met;
      if (is_met) {
        surface.points = before.points;
        surface.triangles = before.triangles;
      } else {
        guard.take({change.old.data(), change.old.size()});
        made++;
        divided += !moves;
      }
    }
  }
  EXPECT_GT(met, 50u);
  EXPECT_GT(made, 50u);
  EXPECT_GT(divided, 10u);
}

}  // namespace
}  // namespace tetlod
