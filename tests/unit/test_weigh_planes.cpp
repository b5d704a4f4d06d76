#include <cmath>

#include "decimate_solid_fixture.hpp"
#include "weigh_planes.hpp"

namespace tetlod::test {
namespace {

class WeighPlanes : public DecimateSolid {
 protected:
  double weight_of(const Mesh &mesh) {
    start_with(mesh);
    const FieldsAsLengths<1> fields(original.view(), box_of(original.view().points).diagonal(), host.job);
    const SolidMesh<1> solid(put_in_order(original.view(), boundary, host.job), original.view().values<1>(),
                             fields.scales, 1, host.job);
    return solid.measures.weight_of_planes;
  }

  /// Walls that are plane, or uneven by `height`.
  double weight_of_cube(int n, double height, const Field &field) {
    Mesh mesh = kuhn_cube(n);
    set_scalars(mesh, field);
    transform(mesh, [height](const Vec3 &p) {
      return p + height * Vec3(std::sin(7 * p.y), std::sin(5 * p.z), std::sin(6 * p.x));
    });
    return weight_of(mesh);
  }
};

TEST_F(WeighPlanes, HoldsPlaneWalls) {
  const double plane = weight_of_cube(10, 0, waves), uneven = weight_of_cube(10, 0.05, waves),
               more_uneven = weight_of_cube(10, 0.1, waves);
  EXPECT_GT(plane, 1.5 * uneven);
  EXPECT_GT(uneven, 1.5 * more_uneven);
}

TEST_F(WeighPlanes, HoldsUnevenWallsLessTheLessTheFieldChanges) {
  const auto weaker = [](const Vec3 &p) { return p.x + 0.01 * waves(p); };
  EXPECT_GT(weight_of_cube(10, 0.1, waves), 3 * weight_of_cube(10, 0.1, weaker));
}

/// With fewer cells more than the quarter that stays longest is next to the cube's edges, where planes are lost.
TEST_F(WeighPlanes, HoldsPlaneWallsWhateverTheFieldChanges) {
  const auto weaker = [](const Vec3 &p) { return p.x + 0.01 * waves(p); };
  EXPECT_EQ(weight_of_cube(14, 0, waves), weight_of_cube(14, 0, weaker)) << "plane walls cost nothing to hold";
}

/// Or jumps: most vertices lose nothing of it, a few do.
TEST_F(WeighPlanes, HoldsWallsWhereTheFieldIsLinearInPieces) {
  const auto linear = [](const Vec3 &p) { return p.x; };
  const auto bent = [](const Vec3 &p) { return std::abs(p.x - 0.53); };
  const auto jumping = [](const Vec3 &p) { return p.x < 0.53 ? 0.0 : 1.0; };
  const double uneven = weight_of_cube(10, 0.05, linear);
  EXPECT_GT(weight_of_cube(10, 0.05, bent), 2 * uneven);
  EXPECT_GT(weight_of_cube(10, 0.05, jumping), 2 * uneven);
}

/// The field and the boundary get smoother alike.
TEST_F(WeighPlanes, DependsLittleOnTheResolution) {
  const auto per_share = [&](int n) {
    const double inside = std::pow((n - 1.0) / (n + 1.0), 3);
    return weight_of_cube(n, 0.1, waves) / (1 + std::pow(0.7 / (1 - inside), 6.5));
  };
  EXPECT_NEAR(per_share(16) / per_share(10), 1, 0.3);
}

/// What a coarse mesh is left with has its boundary all the same.
TEST_F(WeighPlanes, HoldsWallsOfFewVerticesNoMoreThanOfAThird) {
  EXPECT_NEAR(weight_of_cube(40, 0.1, waves) / weight_of_cube(22, 0.1, waves), 1, 0.3);
}

TEST_F(WeighPlanes, DependsOnNeitherUnitNorPlace) {
  Mesh mesh = kuhn_cube(8);
  transform(mesh, [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(7 * p.y), 0, std::sin(6 * p.x)); });
  set_scalars(mesh, waves);
  const double weight = weight_of(mesh);
  transform(mesh, [](const Vec3 &p) { return 1024.0 * Vec3(p.y, p.z, p.x); });
  set_scalars(mesh, [](const Vec3 &p) { return 7 + 3 * waves(Vec3(p.z, p.x, p.y) / 1024.0); });
  EXPECT_NEAR(weight_of(mesh) / weight, 1, 1e-9);
}

TEST_F(WeighPlanes, HoldsWallsMoreTheMoreIsKept) {
  EXPECT_EQ(planes_at_size(0.02), planes_at_size(0.1));
  double before = planes_at_size(0.1);
  for (const double kept : {0.11, 0.2, 0.5, 1.0}) {
    EXPECT_GT(planes_at_size(kept), before);
    before = planes_at_size(kept);
  }
}

/// An uneven cube, of which a half is kept.
TEST_F(DecimateSolid, WherePlanesWeighMoreWallsStay) {
  Mesh mesh = kuhn_cube(12);
  set_scalars(mesh, waves);
  transform(mesh,
            [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(7 * p.y), std::sin(5 * p.z), std::sin(6 * p.x)); });
  start_with(mesh);
  CoarseSolid usual(host.memory), held(host.memory);
  decimate(0.5, host, usual);
  options.planes = planes_at_size(0.5);
  decimate(0.5, host, held);
  EXPECT_LT(held.deviation, 0.5 * usual.deviation);
}

/// Its quadrics are others.
TEST_F(DecimateSolid, OfAnAttemptNoStatesComeAndGo) {
  Mesh mesh = kuhn_cube(12);
  set_scalars(mesh, waves);
  start_with(mesh);
  SolidHistory history(host.memory);
  CoarseSolid alone(host.memory), first(host.memory), later(host.memory), again(host.memory);
  options.planes = 0.3;
  options.is_attempt = true;
  decimate(0.05, host, alone);
  decimate(0.05, host, history, first);
  EXPECT_TRUE(history.states<1>(host.memory).empty());
  options.planes = 1;
  options.is_attempt = false;
  decimate(0.05, host, history, later);
  EXPECT_NE(later.mesh.points, alone.mesh.points);
  EXPECT_EQ(later.reused, 0);
  ASSERT_FALSE(history.states<1>(host.memory).empty());
  options.planes = 0.3;
  options.is_attempt = true;
  decimate(0.05, host, history, again);
  EXPECT_EQ(again.reused, 0);
  expect_same(again.mesh, alone.mesh);
}

}  // namespace
}  // namespace tetlod::test
