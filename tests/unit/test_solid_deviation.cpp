// Edges of a solid that collapse within a limit to the deviation of the boundary.
#include "decimate_solid_fixture.hpp"
#include "deviation.hpp"

namespace tetlod {
namespace {

using namespace test;

class SolidDeviation : public DecimateSolid {
 protected:
  /// With a boundary that is nowhere flat.
  void start_with_waves(int n) {
    Mesh mesh = kuhn_cube(n);
    transform(mesh,
              [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(7 * p.y), std::sin(5 * p.z), std::sin(6 * p.x)); });
    set_scalars(mesh, waves);
    start_with(mesh);
  }

  double deviation_of(const CoarseSolid &coarse) {
    return largest_deviation(surface, tree, coarse.surface, TreeOnDemand(coarse.surface), Samples::between_too,
                             host.job);
  }
};

TEST_F(SolidDeviation, StaysWithinItsLimit) {
  start_with_waves(10);
  CoarseSolid free(host.memory);
  options.measured_at = Samples::between_too;
  ASSERT_TRUE(decimate(0.2, host, free));
  for (double part : {0.5, 0.3}) {
    options.max_deviation = part * free.deviation;
    CoarseSolid held(host.memory);
    ASSERT_TRUE(decimate(0.2, host, held)) << part;
    expect_sound(held);
    EXPECT_LE(held.deviation, options.max_deviation);
    EXPECT_EQ(held.deviation, deviation_of(held));
  }
}

/// Blocks collapse at the same time, each with its part of the boundary.
TEST_F(SolidDeviation, SameBytesForAnyNumberOfThreads) {
  start_with_waves(22);
  CoarseSolid free(host.memory), one(host.memory);
  ASSERT_TRUE(decimate(0.2, host, free));
  options.max_deviation = 0.3 * deviation_of(free);
  ASSERT_TRUE(decimate(0.2, host, one)) << failure;
  EXPECT_LE(one.deviation, options.max_deviation);
  for (int threads : {2, 3}) {
    Host several(threads);
    CoarseSolid other(several.memory);
    ASSERT_TRUE(decimate(0.2, several, other));
    expect_same(one.mesh, other.mesh);
  }
}

/// A field that changes along them would dent them a little.
TEST_F(SolidDeviation, IsNoneWhereWallsArePlane) {
  for (bool single : {false, true}) {
    Mesh mesh = kuhn_cube(12);
    transform(mesh, [&](const Vec3 &p) {
      const Vec3 turned(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, 2 * p.z + 0.3 * p.x);
      return single ? Vec3(float(turned.x), float(turned.y), float(turned.z)) : turned;
    });
    set_scalars(mesh, waves);
    start_with(mesh);
    for (double ratio : {0.5, 0.3}) {
      CoarseSolid coarse(host.memory);
      ASSERT_TRUE(decimate(ratio, host, coarse)) << failure;
      expect_sound(coarse);
      EXPECT_LT(deviation_of(coarse), single ? 1e-6 : 1e-12) << ratio;
    }
  }
}

}  // namespace
}  // namespace tetlod
