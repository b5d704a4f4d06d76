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
  EXPECT_GT(run(0.0005, 0.07, 1).remesh_attempts, 0);
  EXPECT_EQ(run(0.0005, 0.07, 0).remesh_attempts, 0);
}

/// Remeshing finds no volume in it, as doubles round; collapses alone have a result, and it is that.
TEST_F(FlatBody, IsWhatCollapsesMakeOfItWhereRemeshingFindsNoVolume) {
  Cube box(8);
  std::vector<tetlod_run_report> reports;
  for (std::size_t v = 0; v < box.values.size(); v++) {
    double *const p = box.xyz.data() + 3 * v;
    box.values[v] = std::sin(5 * p[0]) * std::cos(4 * p[1]) + p[2] * p[2];
    p[2] *= 1e-15;
  }
  for (int remesh : {1, 0}) {
    const Context context = make_context();
    tetlod_set_preset(context.get(), TETLOD_PRESET_ACCURATE);
    tetlod_set_int(context.get(), TETLOD_OPT_REMESH, remesh);
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.05);
    submit(context.get(), box);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    reports.push_back(report_of(context.get()));
  }
  EXPECT_EQ(reports[0].tets_out, reports[1].tets_out);
}

/// Where edges are to be cleaned it is remeshed alone, which may not come to the size.
TEST_F(FlatBody, TheLogTellsASizeThatRemeshingMisses) {
  for (std::size_t v = 0; v < cube.values.size(); v++) cube.xyz[3 * v + 2] *= 0.01;
  const Context context = make_context();
  std::string told;
  const auto tell = [](void *user, int32_t, const char *message) { *static_cast<std::string *>(user) += message; };
  tetlod_set_log(context.get(), tell, &told, 1);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.02);
  tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 1e-15);
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  const std::int64_t asked = std::int64_t(cube.corners.size()) / 4 / 50, tets = report_of(context.get()).tets_out;
  ASSERT_GT(tets, asked + asked / 10) << "the size is met: the test looks at nothing";
  EXPECT_EQ(told.find("the result has "), 0U) << told;
  EXPECT_NE(told.find(" tets, not " + std::to_string(asked)), std::string::npos) << told;
}

}  // namespace
}  // namespace tetlod_test
