// Sets of parts that are joined, but for those that stay apart: as by looking at all pairs each time.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "meshes.hpp"
#include "torn_sets.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST(TornSets, AreJoinedAsByBruteForce) {
  constexpr std::int32_t count = 60;
  for (const int pairs : {0, 1, 10, 60, 300})
    for (unsigned seed = 0; seed < 20; seed++) {
      std::mt19937 random(seed);
      const auto any = [&] { return std::int32_t(random() % count); };
      Host host;
      Torn torn(&host.memory);
      for (int i = 0; i < pairs; i++) torn.push_back(std::minmax({any(), any()}));
      DisjointSets parts(count, host.memory), expected(count, host.memory);
      for (int i = 0; i < 5; i++) {  // before
        const std::int32_t a = any(), b = any();
        parts.join(a, b);
        expected.join(a, b);
      }
      TornSets sets(torn, parts, host.memory);
      for (int i = 0; i < 200; i++) {
        const std::int32_t a = any(), b = any();
        sets.join(a, b);
        const auto between = std::minmax({expected.lowest(a), expected.lowest(b)});
        const bool stay_apart = std::any_of(torn.begin(), torn.end(), [&](const auto &pair) {
          return std::minmax({expected.lowest(pair.first), expected.lowest(pair.second)}) == between;
        });
        if (!stay_apart) expected.join(a, b);
        for (std::int32_t v = 0; v < count; v++) ASSERT_EQ(parts.lowest(v), expected.lowest(v)) << pairs << ' ' << seed;
      }
    }
}

/// Slabs of very many parts each, between which a field jumps.
TEST(TornSets, OfManyAreSoonJoined) {
  constexpr std::int32_t slabs = 2, side = 300, of_slab = side * side;
  Host host;
  Torn torn(&host.memory);
  for (std::int32_t i = 0; i < of_slab; i++) torn.push_back({i, i + of_slab});
  DisjointSets parts(slabs * of_slab, host.memory);
  TornSets sets(torn, parts, host.memory);
  for (std::int32_t v = 0; v < slabs * of_slab; v++) {
    if (v % side > 0) sets.join(v, v - 1);
    if (v % of_slab >= side) sets.join(v, v - side);
    sets.join(v, (v + of_slab) % (slabs * of_slab));
  }
  EXPECT_EQ(parts.count(), slabs);
}

}  // namespace
}  // namespace tetlod
