// Option remesh at 0: what is left where no process may be started.
#include "fixtures.hpp"

namespace tetlod_test {
namespace {

tetlod_config without_remesher() {
  tetlod_config config = default_config();
  config.remesher = "/nonexistent";
  return config;
}

class WithoutRemesher : public testing::Test {
 protected:
  tetlod_status run(double ratio) {
    tetlod_set_int(context.get(), TETLOD_OPT_REMESH, 0);
    tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio);
    submit(context.get(), cube);
    return tetlod_run(context.get());
  }

  std::int64_t tets() const { return std::int64_t(cube.corners.size() / 4); }

  Cube cube{6};
  const Context context = make_context(without_remesher());
};

/// So few that `fast` would take samples.
TEST_F(WithoutRemesher, AFewPercentAreMet) {
  cube = large_cube_with_front();
  tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
  ASSERT_EQ(run(0.02), TETLOD_OK) << message_of(context.get());
  EXPECT_NEAR(double(report_of(context.get()).tets_out), 0.02 * double(tets()), 0.03 * 0.02 * double(tets()));
  tetlod_set_int(context.get(), TETLOD_OPT_REMESH, 1);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_BACKEND_MISSING);
}

TEST_F(WithoutRemesher, CleanEdgesAskForNone) {
  tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 0.01);
  ASSERT_EQ(run(0.3), TETLOD_OK) << message_of(context.get());
  EXPECT_NEAR(double(report_of(context.get()).tets_out), 0.3 * double(tets()), 0.03 * 0.3 * double(tets()));
}

TEST_F(WithoutRemesher, ABoundHolds) {
  tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.01);
  tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 0.01);  // with which it would be remeshed
  ASSERT_EQ(run(0), TETLOD_OK) << message_of(context.get());
  EXPECT_LE(report_of(context.get()).max_error, 0.01);
  EXPECT_EQ(report_of(context.get()).remesh_attempts, 0);
}

/// Half of the vertices stay: no such size is there.
TEST_F(WithoutRemesher, ASizeThatCannotBeHadIsMissed) {
  std::vector<std::uint8_t> flags(cube.values.size(), 0);
  for (std::size_t v = 0; v < flags.size(); v += 2) flags[v] = TETLOD_FLAG_KEEP;
  const tetlod_array array = array_of(TETLOD_UINT8, flags.size(), 1, flags.data());
  ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK);
  ASSERT_EQ(run(0.05), TETLOD_OK) << message_of(context.get());
  EXPECT_GT(report_of(context.get()).tets_out, std::int64_t(0.1 * double(tets())));
  EXPECT_LT(report_of(context.get()).tets_out, tets());
}

/// But where they have collapsed.
TEST_F(WithoutRemesher, TetsThatOverlapLeadToNone) {
  for (std::size_t k = 0; k < 3; k++) cube.xyz[3 * std::size_t((3 * 7 + 3) * 7 + 3) + k] = 0.9;
  EXPECT_EQ(run(0.01), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(run(0.9), TETLOD_ERR_REMESH);
  EXPECT_EQ(message_of(context.get()).find("edges collapsed in vain: "), 0U) << message_of(context.get());
}

/// No crossing is made by a collapse, so that it is the original's.
TEST_F(WithoutRemesher, AnOriginalThatCrossesItselfIsToBlame) {
  const Cube other(6);
  for (const double shift : {0.45, 3.0 / 12}) {  // through the side; half as large, within
    cube = other;
    const double size = shift > 0.3 ? 1 : 0.5;
    for (const double x : other.xyz) cube.xyz.push_back(shift + size * x);
    cube.values.insert(cube.values.end(), other.values.begin(), other.values.end());
    for (const std::int32_t v : other.corners) cube.corners.push_back(v + std::int32_t(other.values.size()));
    EXPECT_EQ(run(0.3), TETLOD_ERR_MESH_INTERSECTING) << message_of(context.get());
  }
}

TEST_F(WithoutRemesher, ThePublishedMethodIsRefused) {
  EXPECT_EQ(run(0), TETLOD_ERR_BACKEND_MISSING);
  EXPECT_NE(message_of(context.get()).find("remesh is 0, and neither"), std::string::npos) << message_of(context.get());
}

}  // namespace
}  // namespace tetlod_test
