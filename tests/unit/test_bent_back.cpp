// Runs on meshes that are bent back to themselves: their boundary touches or crosses itself, but not by much.
#include "contacts.hpp"
#include "validate.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class BentBack : public WholeRun {
 protected:
  /// A ring, whose ends reach into each other so far, for each unit of the radius. The field jumps there.
  static Mesh ring(double reach) {
    Mesh mesh = kuhn_solid({24, 6, 6}, [](const Cell &) { return true; });
    for (Vec3 &p : mesh.points) {
      const double angle = p.x / 24 * (6.283185307179586 + reach), radius = 1 + p.y / 12;
      p = Vec3(radius * std::cos(angle), radius * std::sin(angle), p.z / 6);
    }
    set_scalars(mesh, [](const Vec3 &p) { return std::atan2(p.y, p.x) + 0.3 * std::sin(3 * p.z); });
    return mesh;
  }

  Status verdict(const Mesh &original) {
    const Input input = input_of(original);
    return verdict_on(input, options, find_defects(input, options, host.job), host.job).status();
  }
};

TEST_F(BentBack, AreSimplifiedLikeOthers) {
  const Mesh original = ring(1e-3);
  for (const std::int64_t effort : {effort_fast, effort_accurate})
    for (const double ratio : {0.5, 0.1, 0.03}) {
      options.effort = effort;
      options.target_ratio = ratio;
      EXPECT_EQ(verdict(original), Status::ok);
      simplify(original);
      const SurfaceFacts is = facts_of(mesh().boundary);
      EXPECT_TRUE(is.closed);
      EXPECT_EQ(is.components, 1);
      EXPECT_EQ(is.euler, 2) << "the ring stays open";
      EXPECT_NEAR(double(report().tets_out), ratio * double(report().tets_in), 0.03 * ratio * double(report().tets_in));
      EXPECT_LT(report().max_deviation, 0.04);
      EXPECT_NEAR(volume_of(copy_of_result()) / volume_of(original), 1, 0.02);
    }
}

TEST_F(BentBack, AreRefusedWhereThatIsAnErrorOrFar) {
  options.target_ratio = 0.3;
  EXPECT_EQ(status(ring(0.05)), Status::mesh_intersecting);
  EXPECT_EQ(verdict(ring(0.05)), Status::mesh_intersecting);
  options.on_overlap = policy_error;
  EXPECT_EQ(status(ring(1e-3)), Status::mesh_intersecting);
  EXPECT_EQ(verdict(ring(1e-3)), Status::mesh_intersecting);
}

}  // namespace
}  // namespace tetlod
