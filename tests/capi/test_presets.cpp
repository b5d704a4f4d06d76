// What a preset says, beside what is said otherwise.
#include <cmath>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

class Presets : public testing::Test {
 protected:
  Cube cube{10};

  void SetUp() override {
    for (std::size_t v = 0; v < cube.values.size(); v++)
      cube.values[v] = std::sin(6 * cube.xyz[3 * v]) * std::cos(5 * cube.xyz[3 * v + 1]);
  }
  /// Of a run in a context of its own.
  template <class Settings>
  tetlod_run_report report_with(const Settings &settings) const {
    const Context context = make_context();
    submit(context.get(), cube);
    settings(context.get());
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
    return report;
  }
};

TEST_F(Presets, KeepATenthWhereNothingElseIsSaid) {
  const auto report = report_with([](tetlod_context *of) { tetlod_set_preset(of, TETLOD_PRESET_FAST); });
  EXPECT_NEAR(double(report.tets_out) / double(report.tets_in), 0.1, 0.003);
}

TEST_F(Presets, LeaveTheSizeToABoundWhicheverIsSetFirst) {
  const auto preset = [](tetlod_context *of) { tetlod_set_preset(of, TETLOD_PRESET_FAST); };
  const auto bound = [](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, 0.1); };
  const auto alone = report_with([&](tetlod_context *of) {
    tetlod_set_int(of, TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
    bound(of);
  });
  const auto first = report_with([&](tetlod_context *of) { preset(of), bound(of); });
  const auto last = report_with([&](tetlod_context *of) { bound(of), preset(of); });
  EXPECT_EQ(first.hash, alone.hash);
  EXPECT_EQ(last.hash, alone.hash);
  const auto without_bound = report_with(preset);
  const auto no_more = report_with([&](tetlod_context *of) {
    preset(of), bound(of);
    tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, 0);
  });
  EXPECT_EQ(no_more.hash, without_bound.hash);
}

TEST_F(Presets, TellWhichRatioHolds) {
  const Context context = make_context();
  double ratio = -1;
  tetlod_set_preset(context.get(), TETLOD_PRESET_ACCURATE);
  for (double bound : {0.0, 0.1, 0.0}) {
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
    ASSERT_EQ(tetlod_get_real(context.get(), TETLOD_OPT_TARGET_RATIO, &ratio), TETLOD_OK);
    EXPECT_EQ(ratio, bound > 0 ? 0 : 0.1);
  }
}

TEST_F(Presets, LeaveARatioAsItIs) {
  const auto report = report_with([](tetlod_context *of) {
    tetlod_set_preset(of, TETLOD_PRESET_FAST);
    tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, 0.3);
    tetlod_set_preset(of, TETLOD_PRESET_ACCURATE);
    tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, 0.9);
  });
  EXPECT_NEAR(double(report.tets_out) / double(report.tets_in), 0.3, 0.009);
}

/// Nothing to take away is nothing to change.
TEST_F(Presets, KeepTheOriginalWhereAllIsKept) {
  for (std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 1), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const tetlod_run_report report = report_of(context.get());
    ASSERT_EQ(report.points_out, std::int64_t(cube.values.size()));
    EXPECT_EQ(report.tets_out, std::int64_t(cube.corners.size() / 4));
    EXPECT_EQ(report.max_error, 0);
    std::vector<double> xyz(cube.xyz.size()), values(cube.values.size());
    tetlod_array array = array_of(TETLOD_FLOAT64, values.size(), 3, xyz.data());
    ASSERT_EQ(tetlod_fetch_points(context.get(), &array), TETLOD_OK);
    array = array_of(TETLOD_FLOAT64, values.size(), 1, values.data());
    ASSERT_EQ(tetlod_fetch_scalars(context.get(), &array), TETLOD_OK);
    const auto in_order = [](const std::vector<double> &points, const std::vector<double> &at) {
      std::vector<std::array<double, 4>> all;
      for (std::size_t v = 0; v < at.size(); v++)
        all.push_back({points[3 * v], points[3 * v + 1], points[3 * v + 2], at[v]});
      std::sort(all.begin(), all.end());
      return all;
    };
    EXPECT_EQ(in_order(xyz, values), in_order(cube.xyz, cube.values));
  }
}

/// A collapse takes several tets, and a vertex brings three or more.
TEST_F(Presets, AFewTetsAreMetToo) {
  Cube cube(6);
  make_ball(cube);
  const double tets = double(cube.corners.size() / 4);
  for (const std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
    for (int size = 25; size < 70; size++) {
      ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, (size + 0.5) / tets), TETLOD_OK);
      ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
      EXPECT_GE(double(report_of(context.get()).tets_out), 0.97 * size) << preset;
      EXPECT_LE(report_of(context.get()).tets_out, size + 1) << preset;
    }
  }
}

/// Not even where the field is constant, so that the boundary's cost cannot see it.
TEST_F(Presets, WhatIsOfThePaperHasNoMeaningWithASize) {
  make_ball(cube);
  for (const bool constant : {false, true}) {
    if (constant) std::fill(cube.values.begin(), cube.values.end(), 1.0);
    const auto hash_with = [&](double lambda, double other) {
      const auto report = report_with([&](tetlod_context *of) {
        tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, 0.1);
        tetlod_set_real(of, TETLOD_OPT_CLEAN_EDGES, 1e-6);
        tetlod_set_lambda(of, lambda);
        for (const auto set : {tetlod_set_sigma, tetlod_set_rho, tetlod_set_min_distance}) set(of, other);
      });
      return report.hash;
    };
    EXPECT_EQ(hash_with(100, 0.3), hash_with(0.1, 0.01)) << constant;
  }
}

}  // namespace
}  // namespace tetlod_test
