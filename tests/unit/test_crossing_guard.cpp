// Which collapses would take a surface through itself: against all pairs of triangles, and winding numbers.
#include <gtest/gtest.h>

#include <random>

#include "boundary_limits.hpp"
#include "brute_force.hpp"
#include "meshes.hpp"
#include "remesh_surfaces.hpp"

namespace tetlod {
namespace {

using namespace test;

/// A blob with small solids around and in it; what is left of it, with numbers as they were.
class Crossings : public testing::Test {
 protected:
  Host host;
  Surface surface{host.memory};
  std::vector<std::uint8_t> gone;  // of triangles
  std::mt19937_64 random{7};

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 somewhere(double most) { return {uniform(-most, most), uniform(-most, most), uniform(-most, most)}; }

  void start_with(unsigned seed, int solids) {
    surface = random_blob(host.memory, 4, seed);
    for (int i = 0; i < solids; i++) add_small_tet(surface.points[random() % 90] + somewhere(0.15));
    complete(surface, [](const Vec3 &p) { return p.x; });
    gone.assign(surface.triangles.size(), 0);
  }

  /// Where it meets nothing.
  void add_small_tet(const Vec3 &at) {
    Surface with(host.memory);
    with = surface;
    const auto v = std::int32_t(with.points.size());
    for (const Vec3 &corner : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
      with.points.push_back(at + 0.02 * corner);
    for (const Triangle &t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
      with.triangles.push_back({v + t[0], v + t[1], v + t[2]});
    if (crossings(with, host.memory).empty()) surface = std::move(with);
  }

  const Triangle &triangle(std::int32_t t) const { return surface.triangles[std::size_t(t)]; }
  std::vector<std::int32_t> triangles_with(std::int32_t v) const {
    std::vector<std::int32_t> found;
    for (std::int32_t t = 0; t < std::int32_t(surface.triangles.size()); t++)
      if (!gone[std::size_t(t)] && std::count(triangle(t).begin(), triangle(t).end(), v)) found.push_back(t);
    return found;
  }

  /// The edge collapses to `place`. False: it is none of a triangle, or its ends have more than two common neighbours.
  bool look_at(std::int32_t stays, std::int32_t goes, const Vec3 &place, Star &star) const {
    star.clear();
    star.centre = place;
    star.centre_id = stays;
    std::map<std::int32_t, std::pair<std::int32_t, std::int32_t>> next;  // and the triangle between
    for (std::int32_t end : {stays, goes})
      for (std::int32_t t : triangles_with(end)) {
        const Triangle f = triangle(t);
        const auto k = std::size_t(std::find(f.begin(), f.end(), end) - f.begin());
        if (std::count(f.begin(), f.end(), stays) && std::count(f.begin(), f.end(), goes)) {
          if (end == stays) star.old_faces.push_back(t);
        } else if (!next.insert({f[(k + 1) % 3], {f[(k + 2) % 3], t}}).second) {
          return false;
        }
      }
    if (star.old_faces.size() != 2 || next.size() < 3) return false;
    for (std::int32_t v = next.begin()->first; star.size() < next.size(); v = next[v].first) {
      if (!next.count(v)) return false;
      star.ring.push_back(surface.points[std::size_t(v)]);
      star.ring_id.push_back(v);
      star.old_faces.push_back(next[v].second);
    }
    star.find_spokes();
    return std::set<std::int32_t>(star.ring_id.begin(), star.ring_id.end()).size() == star.size();
  }

  Surface left() const {
    Surface left(host.job.memory);
    left = surface;
    left.triangles.clear();
    for (std::size_t t = 0; t < gone.size(); t++)
      if (!gone[t]) left.triangles.push_back(surface.triangles[t]);
    return left;
  }

  void collapse(const Star &star) {
    surface.points[std::size_t(star.centre_id)] = star.centre;
    for (std::size_t k = 0; k < 2; k++) gone[std::size_t(star.old_faces[k])] = 1;
    for (std::size_t i = 0; i < star.size(); i++)
      surface.triangles[std::size_t(star.spoke_face(i))] = {star.centre_id, star.ring_id[i],
                                                            star.ring_id[star.after(i)]};
  }

  /// Between the two surfaces: vertices of neither the star before nor after whose winding numbers differ.
  bool differs_somewhere(const Surface &before, const Surface &after) const {
    std::set<std::int32_t> vertices;
    for (const Triangle &t : after.triangles) vertices.insert(t.begin(), t.end());
    return std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) {
      const Vec3 &p = after.points[std::size_t(v)];
      return p == before.points[std::size_t(v)] && std::abs(winding_number(before.points, before.triangles, p) -
                                                            winding_number(after.points, after.triangles, p)) > 0.9;
    });
  }
};

TEST_F(Crossings, AreThoseOfAllPairsAndWhatIsPassedOver) {
  std::size_t made = 0, crossed = 0, passed_over = 0;
  for (unsigned seed : {1u, 2u}) {
    start_with(seed, 30);
    CrossingGuard guard(surface.points, surface.triangles, {}, host.job);
    Star star(host.memory);
    for (int i = 0; i < 120; i++) {
      const Triangle t = triangle(std::int32_t(random() % surface.triangles.size()));
      const Vec3 middle = 0.5 * (surface.points[std::size_t(t[0])] + surface.points[std::size_t(t[1])]);
      if (!look_at(t[0], t[1], middle + somewhere(0.2), star)) continue;
      const Surface before = left(), kept = copy_of(surface, host);
      const std::vector<std::uint8_t> kept_gone = gone;
      const bool is_passed = guard.is_passed(star);
      collapse(star);
      const Surface after = left();
      const bool crosses = !crossings(after, host.memory).empty();
      const bool passes = !crosses && differs_somewhere(before, after);
      ASSERT_EQ(is_passed, crosses || passes) << "seed " << seed << ", collapse " << i;
      crossed += crosses;
      passed_over += passes;
      made += !is_passed;
      if (is_passed) {
        std::copy(kept.points.begin(), kept.points.end(), surface.points.begin());
        std::copy(kept.triangles.begin(), kept.triangles.end(), surface.triangles.begin());
        gone = kept_gone;
      } else {
        guard.move_on(star);
      }
    }
  }
  EXPECT_GT(made, 20u);
  EXPECT_GT(crossed, 5u);
  EXPECT_GT(passed_over, 5u);
}

}  // namespace
}  // namespace tetlod
