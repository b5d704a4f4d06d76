// How a surface hangs together that touches itself in many places, by several threads.
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory_resource>

#include "meshes.hpp"
#include "remesh_surfaces.hpp"
#include "status.hpp"
#include "surface_topology.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Pairs of cubes with a common edge, so many that all threads have some.
class ManyContacts : public testing::Test {
 protected:
  static constexpr int pairs = 3000, triangles_a_pair = 24;
  Host host;

  /// Of some a triangle is turned round.
  Surface with_turned(std::initializer_list<int> turned) {
    Surface pair = box(host.memory, 1), all(host.memory);
    append(pair, box(host.memory, 1, Vec3(1, 1, 0), Vec3(2, 2, 1)));
    pair = welded(host.memory, pair);
    for (int i = 0; i < pairs; i++) {
      append(all, pair);
      transform(pair, [](const Vec3 &p) { return p + Vec3(3, 0, 0); });
    }
    for (int i : turned) {
      Triangle &t = all.triangles[std::size_t(triangles_a_pair * i)];
      std::swap(t[0], t[1]);
    }
    return all;
  }

  static std::string told_of(const Surface &surface, int threads) {
    Host other(threads);
    SurfaceTopology topology(other.memory);
    try {
      find_topology(surface.points, surface.triangles, other.job, topology);
      return {};
    } catch (const Error &error) {
      return error.what();
    }
  }
};

/// In nothing but what the caller's allocator gives.
TEST_F(ManyContacts, AreTheSameForAnyNumberOfThreads) {
  const Surface surface = with_turned({});
  SurfaceTopology topology(host.memory);
  std::pmr::memory_resource *const usual = std::pmr::set_default_resource(std::pmr::null_memory_resource());
  EXPECT_NO_THROW(find_topology(surface.points, surface.triangles, host.job, topology));
  for (int threads : {2, 3}) {
    Host several(threads);
    SurfaceTopology other(several.memory);
    EXPECT_NO_THROW(find_topology(surface.points, surface.triangles, several.job, other));
    EXPECT_EQ(other.mate, topology.mate);
    EXPECT_EQ(other.edges, topology.edges);
  }
  std::pmr::set_default_resource(usual);
  EXPECT_EQ(topology.components, 2 * pairs);
  EXPECT_EQ(topology.nonmanifold_edges, pairs);
  EXPECT_EQ(topology.edges, pairs * (2 * 18 - 1));
}

TEST_F(ManyContacts, TheFirstThatIsWrongIsToldOf) {
  const std::string first = told_of(with_turned({700}), 1), last = told_of(with_turned({2500}), 1);
  const Surface both = with_turned({700, 2500});
  EXPECT_NE(first, "");
  EXPECT_NE(first, last);
  for (int threads : {1, 2, 3}) EXPECT_EQ(told_of(both, threads), first) << threads;
}

}  // namespace
}  // namespace tetlod
