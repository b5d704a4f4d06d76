// Bodies whose rims are sharper than a fold may get: collapses that keep all rules come to no small size.
#include "fixtures.hpp"

namespace tetlod_test {
namespace {

class FlatBody : public testing::Test {
 protected:
  FlatBody() { make_ball(cube); }

  /// Of the ball, pressed.
  tetlod_run_report run(double press, double ratio, int remesh) const {
    Cube flat = cube;
    for (std::size_t v = 0; v < flat.values.size(); v++) flat.xyz[3 * v + 2] *= press;
    const Context context = make_context();
    tetlod_set_int(context.get(), TETLOD_OPT_REMESH, remesh);
    tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio);
    submit(context.get(), flat);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    return report_of(context.get());
  }

  Cube cube{8};
};

TEST_F(FlatBody, ReachesAnySize) {
  const double tets = double(cube.corners.size() / 4);
  for (double press : {0.1, 0.02, 0.002})
    for (double ratio : {0.2, 0.1, 0.05, 0.02})
      for (int remesh : {0, 1})
        EXPECT_NEAR(double(run(press, ratio, remesh).tets_out), ratio * tets, 0.03 * ratio * tets)
            << press << ' ' << ratio << ' ' << remesh;
}

/// Which loses less, on the whole.
TEST_F(FlatBody, IsRemeshedBeforeItsFoldsGetSharper) {
  EXPECT_GT(run(0.01, 0.07, 1).remesh_attempts, 0);
  EXPECT_EQ(run(0.01, 0.07, 0).remesh_attempts, 0);
}

}  // namespace
}  // namespace tetlod_test
