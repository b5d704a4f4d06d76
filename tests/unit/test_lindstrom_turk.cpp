// 3.2  Placement and cost against their definitions, term by term over the triangles, and the queue against a set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "edge_queue.hpp"
#include "lindstrom_turk.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

/// The triangles around an edge and the vertices of its link, as random as they come near a smooth surface.
struct Fan {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<Vec3> ring;
  Vec3 from, to;
  VolumeSums volume;
  LinkSums link;

  void sum_up() {
    for (const auto &t : triangles) volume.add(plane_of(t[0], t[1], t[2]));
    for (const Vec3 &p : ring) link.add(p);
  }
  double length2_e() const { return length2(to - from); }

  /// Six times the volume between the old triangles and the new vertex.
  double volume_change(const Vec3 &x) const {
    double sum = 0;
    for (const auto &t : triangles) sum += glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), x - t[0]);
    return sum;
  }
  double shape(const Vec3 &x) const {
    double sum = 0;
    for (const Vec3 &p : ring) sum += glm::dot(p - x, p - x);
    return sum;
  }
  /// f_v + w_s f_s, volumes in units of the edge's length.
  double objective(const Vec3 &x, double lambda) const {
    double sum = 0;
    for (const auto &t : triangles) {
      const double v = glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), x - t[0]);
      sum += v * v;
    }
    return sum + lambda * length2_e() * length2_e() * shape(x);
  }
  Vec3 constraint() const {
    Vec3 n(0);
    for (const auto &t : triangles) n += glm::cross(t[1] - t[0], t[2] - t[0]);
    return n;
  }
};

/// `height`: how far from flat. The edge runs between two points near the middle of the ring.
Fan random_fan(double height, double scale, std::mt19937_64 &random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto lift = [&](double x, double y) { return scale * (Vec3(x, y, height * uniform(random)) + Vec3(3, -2, 1)); };
  Fan fan;
  fan.from = lift(-0.3, 0.05 * uniform(random));
  fan.to = lift(0.3, 0.05 * uniform(random));
  constexpr int count = 9;
  for (int i = 0; i < count; i++) {
    const double angle = 2 * M_PI * (i + 0.3 * uniform(random)) / count;
    fan.ring.push_back(lift(std::cos(angle), std::sin(angle)));
  }
  // Ring vertices 2 and 7 are the apexes: on one side of them triangles hang on `to`, on the other on `from`.
  for (int i = 0; i < count; i++) {
    const Vec3 &a = fan.ring[std::size_t(i)], &b = fan.ring[std::size_t((i + 1) % count)];
    fan.triangles.push_back({i >= 2 && i < 7 ? fan.from : fan.to, a, b});
  }
  fan.triangles.push_back({fan.from, fan.to, fan.ring[2]});
  fan.triangles.push_back({fan.to, fan.from, fan.ring[7]});
  fan.sum_up();
  return fan;
}

double size_of_terms(const Fan &fan, const Vec3 &x) {
  double sum = 0;
  for (const auto &t : fan.triangles)
    sum += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) * (glm::length(x) + glm::length(t[0]));
  return sum;
}

TEST(Placement, KeepsTheVolume) {
  std::mt19937_64 random(1);
  for (double height : {0.01, 0.1, 0.5})
    for (double scale : {1e-6, 1.0, 1e6})
      for (double lambda : {0.0, 1e-3, 0.1, 10.0})
        for (int i = 0; i < 50; i++) {
          const Fan fan = random_fan(height, scale, random);
          const Vec3 x = place_vertex(fan.volume, fan.link, fan.length2_e(), lambda);
          ASSERT_NEAR(fan.volume_change(x), 0, 1e-11 * size_of_terms(fan, x)) << height << " " << scale;
        }
}

/// No other point that keeps the volume has a lower objective: none in any direction, near or far.
TEST(Placement, IsTheBestThatKeepsTheVolume) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (double height : {0.05, 0.5})
    for (double lambda : {1e-3, 0.1, 10.0})
      for (int i = 0; i < 100; i++) {
        const Fan fan = random_fan(height, 1, random);
        const Vec3 x = place_vertex(fan.volume, fan.link, fan.length2_e(), lambda);
        const Vec3 n = glm::normalize(fan.constraint());
        const double least = fan.objective(x, lambda);
        for (double step : {1e-3, 0.1, 3.0})
          for (int k = 0; k < 20; k++) {
            Vec3 d(normal(random), normal(random), normal(random));
            d -= glm::dot(d, n) * n;
            ASSERT_GE(fan.objective(x + step * glm::normalize(d), lambda), least);
          }
      }
}

/// The paper's last resort: the best shape that keeps the volume.
TEST(Placement, OfShapeAlone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; i++) {
    const Fan fan = random_fan(0.3, 1, random);
    const Vec3 x = optimize_shape(fan.volume, fan.link);
    ASSERT_NEAR(fan.volume_change(x), 0, 1e-11 * size_of_terms(fan, x));
    const Vec3 n = glm::normalize(fan.constraint());
    for (int k = 0; k < 20; k++) {
      Vec3 d(normal(random), normal(random), normal(random));
      d -= glm::dot(d, n) * n;
      ASSERT_GE(fan.shape(x + 0.01 * d), fan.shape(x));
    }
  }
}

TEST(Placement, InAPlaneStaysInIt) {
  std::mt19937_64 random(4);
  for (double lambda : {0.0, 0.1})
    for (int i = 0; i < 100; i++) {
      const Fan fan = random_fan(0, 1, random);  // in the plane z = 1
      const Vec3 x = place_vertex(fan.volume, fan.link, fan.length2_e(), lambda);
      ASSERT_NEAR(x.z, 1, 1e-9);
      ASSERT_TRUE(std::isfinite(x.x) && std::isfinite(x.y));
      ASSERT_LT(length2(x - Vec3(3, -2, 1)), 1) << "not among its neighbours";
    }
}

TEST(Placement, IsTheSameAtEveryScale) {
  for (double scale : {1e-9, 1e-3, 1e4}) {
    std::mt19937_64 random(5), same(5);
    for (int i = 0; i < 50; i++) {
      const Fan one = random_fan(0.3, 1, random), other = random_fan(0.3, scale, same);
      const Vec3 x = place_vertex(one.volume, one.link, one.length2_e(), 0.1);
      const Vec3 y = place_vertex(other.volume, other.link, other.length2_e(), 0.1);
      ASSERT_LT(glm::length(y - scale * x), 1e-6 * scale);
    }
  }
}

TEST(Cost, IsShapeTimesSquaredLength) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 200; i++) {
    const Fan fan = random_fan(0.5, 1, random);
    const Vec3 x = 0.5 * (fan.from + fan.to);
    const double expected = fan.shape(x) * fan.length2_e();
    ASSERT_NEAR(collapse_cost(fan.link, x, fan.length2_e()), expected, 1e-11 * expected);
  }
}

TEST(Sums, TakeBackWhatWasAdded) {
  std::mt19937_64 random(7);
  const Fan fan = random_fan(0.5, 1, random);
  VolumeSums volume;
  LinkSums link;
  for (const auto &t : fan.triangles) volume.add(plane_of(t[0], t[1], t[2]));
  volume.add(plane_of(fan.from, fan.to, Vec3(9)));
  volume.add(plane_of(fan.from, fan.to, Vec3(9)), -1);
  for (const Vec3 &p : fan.ring) link.add(p);
  link.add(fan.from);
  link.add(fan.from, -1);
  EXPECT_EQ(link.count, fan.link.count);
  const Vec3 x = place_vertex(fan.volume, fan.link, fan.length2_e(), 0.1);
  EXPECT_LT(glm::length(place_vertex(volume, link, fan.length2_e(), 0.1) - x), 1e-9);
}

// The queue

TEST(EdgeQueue, AgainstASet) {
  std::mt19937_64 random(1);
  constexpr std::int32_t edges = 300;
  test::Host host;
  EdgeQueue queue(edges, host.job);
  std::set<std::pair<double, std::int32_t>> expected;
  std::vector<double> cost(edges, -1);
  const auto forget = [&](std::int32_t e) { expected.erase({cost[std::size_t(e)], e}); };
  for (int step = 0; step < 100000; step++) {
    const auto e = std::int32_t(random() % edges);
    switch (random() % 4) {
      case 0:
      case 1:
        forget(e);
        cost[std::size_t(e)] = double(random() % 50);  // ties in great number
        expected.insert({cost[std::size_t(e)], e});
        queue.set(e, cost[std::size_t(e)]);
        ASSERT_EQ(queue.cost(e), cost[std::size_t(e)]);
        break;
      case 2:
        forget(e);
        queue.remove(e);
        break;
      default:
        if (!expected.empty()) {
          queue.remove(expected.begin()->second);
          expected.erase(expected.begin());
        }
    }
    ASSERT_EQ(queue.empty(), expected.empty());
    ASSERT_TRUE(expected.empty() || queue.top() == expected.begin()->second);
  }
  while (!expected.empty()) {
    ASSERT_EQ(queue.top(), expected.begin()->second);
    queue.remove(queue.top());
    expected.erase(expected.begin());
  }
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace tetlod
