// What each member of the C++ wrapper hands on: to its own function, under its own name, with every argument.
#include <gtest/gtest.h>

#include <map>

#include "wrapper_fixture.hpp"

namespace {

using wrapper_test::Cube;

template <class Call>
void expect_throws(tetlod_status status, Call call) {
  try {
    call();
    FAIL() << "status " << status << " was expected";
  } catch (const tetlod::Error &error) {
    EXPECT_EQ(error.status(), status) << error.what();
  }
}

TEST(Wrapper, TheVersionIsTheHeaders) {
  const tetlod::Version version = tetlod::version();
  EXPECT_EQ(version.major, TETLOD_VERSION_MAJOR);
  EXPECT_EQ(version.minor, TETLOD_VERSION_MINOR);
  EXPECT_EQ(version.patch, TETLOD_VERSION_PATCH);
}

TEST(Wrapper, TextsAreTheLibrarys) {
  EXPECT_STREQ(tetlod::build_info(), tetlod_build_info());
  EXPECT_STREQ(tetlod::status_text(TETLOD_ERR_STATE), tetlod_status_text(TETLOD_ERR_STATE));
  EXPECT_STRNE(tetlod::status_text(TETLOD_ERR_STATE), tetlod::status_text(TETLOD_OK));
  EXPECT_STREQ(tetlod::stage_name(1), "boundary");
}

TEST(Wrapper, OptionsHaveNames) {
  EXPECT_EQ(tetlod::option_from_name("min-distance"), TETLOD_OPT_MIN_DISTANCE);
  EXPECT_STREQ(tetlod::option_name(TETLOD_OPT_MIN_DISTANCE), "min-distance");
  EXPECT_EQ(tetlod::option_from_name("no-such"), 0);
  EXPECT_EQ(tetlod::option_name(0), nullptr);
}

std::map<std::int32_t, double> options_of(const tetlod::Context &lod) {
  std::map<std::int32_t, double> values;
  for (std::int32_t option = 1; tetlod::option_name(option) != nullptr; option++)
    values[option] = tetlod::option_bounds(option).is_integer ? double(lod.get_int(option)) : lod.get_real(option);
  return values;
}

TEST(Wrapper, EachSetterSetsItsOptionAlone) {
  using Setter = void (*)(tetlod::Context &, double);
  const std::map<std::int32_t, Setter> setters = {
      {TETLOD_OPT_RHO, [](tetlod::Context &lod, double value) { lod.set_rho(value); }},
      {TETLOD_OPT_SIGMA, [](tetlod::Context &lod, double value) { lod.set_sigma(value); }},
      {TETLOD_OPT_LAMBDA, [](tetlod::Context &lod, double value) { lod.set_lambda(value); }},
      {TETLOD_OPT_MIN_DISTANCE, [](tetlod::Context &lod, double value) { lod.set_min_distance(value); }},
      {TETLOD_OPT_CLEAN_EDGES, [](tetlod::Context &lod, double value) { lod.set_real(TETLOD_OPT_CLEAN_EDGES, value); }},
  };
  for (const auto &[option, set] : setters) {
    tetlod::Context lod;
    auto wanted = options_of(lod);
    wanted[option] = 0.0625;
    set(lod, 0.0625);
    EXPECT_EQ(options_of(lod), wanted) << tetlod::option_name(option);
  }
}

TEST(Wrapper, IntegersKeepAllOfTheirBits) {
  tetlod::Context lod;
  constexpr std::int64_t seed = (std::int64_t(1) << 53) - 1;
  lod.set_int(TETLOD_OPT_SEED, seed);
  EXPECT_EQ(lod.get_int(TETLOD_OPT_SEED), seed);
}

TEST(Wrapper, OptionsOfTheOtherKindAreRefused) {
  tetlod::Context lod;
  expect_throws(TETLOD_ERR_OPTION, [&] { lod.get_int(TETLOD_OPT_RHO); });
  expect_throws(TETLOD_ERR_OPTION, [&] { lod.get_real(TETLOD_OPT_SEED); });
  expect_throws(TETLOD_ERR_OPTION, [&] { lod.set_int(TETLOD_OPT_RHO, 1); });
  expect_throws(TETLOD_ERR_OPTION, [&] { lod.set_real(TETLOD_OPT_SEED, 1); });
}

TEST(Wrapper, APresetSetsWhatItGoverns) {
  tetlod::Context lod;
  lod.set_preset(TETLOD_PRESET_FAST);
  EXPECT_EQ(lod.get_int(TETLOD_OPT_EFFORT), TETLOD_EFFORT_FAST);
  EXPECT_EQ(lod.get_real(TETLOD_OPT_TARGET_RATIO), 0.1);
  expect_throws(TETLOD_ERR_OPTION, [&] { lod.set_preset(17); });
}

TEST(Wrapper, AConfigsRemesherIsTheOne) {
  const Cube cube;
  tetlod_config config = {};
  config.remesher = "/no/such/program";
  tetlod::Context lod = cube.submitted(tetlod::Context(config));
  expect_throws(TETLOD_ERR_BACKEND_MISSING, [&] { lod.run(); });
}

TEST(Wrapper, AConfigsMemoryLimitHolds) {
  const Cube cube;
  tetlod_config config = {};
  config.memory_limit = 10000;
  tetlod::Context lod = cube.submitted(tetlod::Context(config));
  expect_throws(TETLOD_ERR_MEMORY_LIMIT, [&] { lod.run(); });
}

TEST(Wrapper, AConfigThatIsRefusedIsToldWithoutAContext) {
  tetlod_config config = {};
  config.remesher = "";
  try {
    const tetlod::Context lod(config);
    FAIL() << "an empty path was taken";
  } catch (const tetlod::Error &error) {
    EXPECT_EQ(error.status(), TETLOD_ERR_ARGUMENT);
    EXPECT_NE(std::string(error.what()).find("remesher"), std::string::npos) << error.what();
  }
}

TEST(Wrapper, ComponentsMayBeApart) {
  const Cube cube;
  std::vector<double> planes;
  for (std::size_t axis = 0; axis < 3; axis++)
    for (std::size_t at = axis; at < cube.xyz.size(); at += 3) planes.push_back(cube.xyz[at]);
  tetlod::Context packed = cube.submitted(), apart = cube.submitted();
  const auto size = std::int64_t(sizeof(double));
  apart.submit_points({planes.data(), cube.points(), 3, size, size * cube.points()});
  packed.run();
  apart.run();
  EXPECT_EQ(packed.fetch_report().hash, apart.fetch_report().hash);
}

TEST(Wrapper, TetsMayCountFromOne) {
  const Cube cube;
  const std::vector<std::int64_t> zero(cube.corners.begin(), cube.corners.end());
  std::vector<std::int64_t> one = zero;
  for (std::int64_t &corner : one) corner++;
  tetlod::Context from_zero = cube.submitted(), from_one = cube.submitted();
  from_zero.submit_tets({zero.data(), cube.tets(), 4}, 0);
  from_one.submit_tets({one.data(), cube.tets(), 4}, 1);
  from_zero.run();
  from_one.run();
  EXPECT_EQ(from_zero.fetch_report().hash, from_one.fetch_report().hash);
}

TEST(Wrapper, AFlaggedPointSurvives) {
  const Cube cube;
  constexpr int kept = 3 + 9 * (4 + 9 * 5);
  std::vector<std::uint8_t> flags(std::size_t(cube.points()), 0);
  tetlod::Context lod = cube.submitted();
  lod.set_rho(1);
  lod.submit_point_flags({flags.data(), cube.points()});
  const auto is_there = [&] {
    const auto points = lod.view_points();
    for (std::int64_t i = 0; i < points.tuples(); i++)
      if (points(i, 0) == 3 && points(i, 1) == 4 && points(i, 2) == 5) return true;
    return false;
  };
  lod.run();
  EXPECT_FALSE(is_there());
  flags[kept] = TETLOD_FLAG_KEEP;
  lod.run();
  EXPECT_TRUE(is_there());
}

TEST(Wrapper, ClearForgetsTheInputAndKeepsTheResult) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  lod.run();
  const tetlod::Counts before = lod.fetch_counts();
  lod.clear();
  expect_throws(TETLOD_ERR_STATE, [&] { lod.run(); });
  EXPECT_EQ(lod.fetch_counts().tets, before.tets);
}

/// As from another thread, at a moment that is the same in each run.
TEST(Wrapper, CancelEndsTheRun) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  lod.set_progress([&lod](std::int32_t, double) {
    lod.cancel();
    return false;
  });
  expect_throws(TETLOD_ERR_CANCELLED, [&] { lod.run(); });
}

TEST(Wrapper, ProgressIsToldTheStages) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  std::map<std::string, int> stages;
  lod.set_progress([&stages](std::int32_t stage, double fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1) << fraction;
    stages[tetlod::stage_name(stage)]++;
    return false;
  });
  lod.run();
  for (const char *stage : {"boundary", "decimate", "values"}) EXPECT_GT(stages[stage], 0) << stage;
}

/// What is told of a size that cannot be had.
std::map<std::int32_t, std::string> told(std::int32_t min_level) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  std::map<std::int32_t, std::string> all;
  lod.set_real(TETLOD_OPT_TARGET_RATIO, 1e-6);
  lod.set_log([&all](std::int32_t level, const char *message) { all[level] += message; }, min_level);
  lod.run();
  return all;
}

TEST(Wrapper, TheLogHearsFromItsLevelOn) {
  const auto everything = told(0);
  ASSERT_FALSE(everything.empty()) << "the test looks at nothing";
  const std::int32_t highest = everything.rbegin()->first;
  EXPECT_EQ(told(highest).count(highest), 1u);
  EXPECT_TRUE(told(highest + 1).empty());
}

TEST(Wrapper, AnEmptyFunctionIsNoLog) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  int calls = 0;
  lod.set_real(TETLOD_OPT_TARGET_RATIO, 1e-6);
  lod.set_log([&calls](std::int32_t, const char *) { calls++; }, 0);
  lod.run();
  const int before = calls;
  EXPECT_GT(before, 0) << "the test looks at nothing";
  lod.set_log({}, 0);
  lod.run();
  EXPECT_EQ(calls, before);
}

TEST(Wrapper, WhatIsMovedFromIsNoContext) {
  tetlod::Context lod;
  const tetlod::Context taken = std::move(lod);
  EXPECT_EQ(lod.get(), nullptr);
  EXPECT_NE(taken.get(), nullptr);
  expect_throws(TETLOD_ERR_ARGUMENT, [&] { lod.set_rho(0.5); });
  expect_throws(TETLOD_ERR_ARGUMENT, [&] { lod.set_log([](std::int32_t, const char *) {}); });
  expect_throws(TETLOD_ERR_ARGUMENT, [&] { lod.run(); });
  lod.cancel();
}

TEST(Wrapper, AssigningMovesTheOptions) {
  tetlod::Context lod, other;
  other.set_rho(0.375);
  bool is_gone = false;
  lod.set_log([ends = std::shared_ptr<void>(nullptr, [&](void *) { is_gone = true; })](std::int32_t, const char *) {});
  lod = std::move(other);
  EXPECT_EQ(lod.get_real(TETLOD_OPT_RHO), 0.375);
  EXPECT_EQ(other.get(), nullptr);
  EXPECT_TRUE(is_gone);
  tetlod::Context &itself = lod;
  lod = std::move(itself);
  EXPECT_EQ(lod.get_real(TETLOD_OPT_RHO), 0.375);
}

TEST(Wrapper, IntegersAreKnownByTheirWidth) {
  EXPECT_EQ(tetlod::element_type<long long>, TETLOD_INT64);
  EXPECT_EQ(tetlod::element_type<std::int64_t>, TETLOD_INT64);
  EXPECT_EQ(tetlod::element_type<int>, TETLOD_INT32);
  EXPECT_EQ(tetlod::element_type<unsigned>, 0);
  EXPECT_EQ(tetlod::element_type<short>, 0);
  EXPECT_EQ(tetlod::element_type<long double>, 0);
}

}  // namespace
