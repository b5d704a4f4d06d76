// Boxes that lie askew: what they are clear of is apart, and thin things side by side are clear of each other.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "predicates.hpp"
#include "turned_box.hpp"

namespace tetlod {
namespace {

using Corners = std::array<Vec3, 3>;

class TurnedBoxes : public testing::Test {
 protected:
  std::mt19937_64 random{3};
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  Vec3 somewhere() { return {uniform(), uniform(), uniform()}; }
  /// Along a direction, `thick` times as thick as long.
  Corners needle(const Vec3 &from, const Vec3 &along, double thick) {
    return {from, from + along + thick * somewhere(), from + 0.5 * along + thick * somewhere()};
  }
};

TEST_F(TurnedBoxes, AreClearOfNothingThatMeetsTheirTriangle) {
  int clear = 0, meeting = 0;
  for (int i = 0; i < 20000; i++) {
    const Vec3 along = somewhere(), far = i % 2 ? Vec3(0) : 1e6 * somewhere();
    const Corners a = needle(far + somewhere(), along, 0.1), b = needle(far + somewhere(), somewhere(), 0.5);
    const bool are_apart = triangles_apart(a.data(), {0, 1, 2}, b.data(), {3, 4, 5});
    const bool is_clear = TurnedBox({a.data(), a.size()}).is_clear_of(b.data());
    ASSERT_TRUE(are_apart || !is_clear);
    clear += is_clear;
    meeting += !are_apart;
  }
  EXPECT_GT(clear, 5000);
  EXPECT_GT(meeting, 100);
}

TEST_F(TurnedBoxes, AreClearOfNothingThatTouchesThem) {
  for (int i = 0; i < 5000; i++) {
    const Corners a = needle(somewhere(), somewhere(), 0.01);
    const Vec3 outward = a[0] - 0.5 * (a[1] + a[2]);
    const Corners beyond = {a[0], a[0] + outward + 0.1 * somewhere(), a[0] + outward + 0.1 * somewhere()};
    ASSERT_FALSE(TurnedBox({a.data(), a.size()}).is_clear_of(beyond.data()));
  }
}

TEST_F(TurnedBoxes, OfNeedlesSideBySideAreClearOfEachOther) {
  const Vec3 along(1, 0.9, 0.8), across = glm::normalize(glm::cross(along, Vec3(0.3, 1, -0.2)));
  const Corners a = needle(Vec3(0), along, 0.001);
  for (int i = 0; i < 1000; i++) {
    const Corners b = needle(0.01 * across + 0.3 * uniform() * along, along, 0.001);
    ASSERT_TRUE(TurnedBox({a.data(), a.size()}).is_clear_of(b.data()));
  }
}

TEST_F(TurnedBoxes, OfAPointOrALineAreClearOfNothingBesideIt) {
  const Vec3 p(0.1, 0.2, 0.3);
  const Corners point = {p, p, p}, line = {p, p + Vec3(1, 2, 3), p + Vec3(2, 4, 6)}, beside = {p, p + 1.0, p + 2.0};
  EXPECT_FALSE(TurnedBox({point.data(), point.size()}).is_clear_of(beside.data()));
  EXPECT_FALSE(TurnedBox({line.data(), line.size()}).is_clear_of(beside.data()));
}

}  // namespace
}  // namespace tetlod
