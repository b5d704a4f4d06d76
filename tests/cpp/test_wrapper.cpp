// The C++ wrapper on a cube of tets with a linear field.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "wrapper_fixture.hpp"

namespace {

using wrapper_test::Cube;

TEST(Wrapper, SimplifiesAndKeepsALinearField) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  EXPECT_EQ(lod.check().status, TETLOD_OK);
  EXPECT_GT(lod.estimate_memory(), 0u);
  lod.run();
  const tetlod::Counts n = lod.fetch_counts();
  const auto points = lod.view_points();
  const auto values = lod.view_scalars();
  EXPECT_LT(n.tets, cube.tets());
  EXPECT_EQ(lod.view_tets().tuples(), n.tets);
  EXPECT_EQ(lod.fetch_report().tets_out, n.tets);
  for (std::int64_t i = 0; i < n.points; i++)
    EXPECT_NEAR(values(i), points(i, 0) + 2 * points(i, 1) - 3 * points(i, 2), 1e-9);
  EXPECT_LT(lod.measure_error(1).max, 1e-9);
  std::int64_t counted = 0;
  for (std::int64_t count : lod.histogram(1, 10)) counted += count;
  EXPECT_EQ(counted, n.points);
  for (std::int32_t bins : {std::numeric_limits<std::int32_t>::min(), 0, std::numeric_limits<std::int32_t>::max()})
    EXPECT_THROW(lod.histogram(1, bins), tetlod::Error) << "and no memory for them";
}

TEST(Wrapper, AFurtherFieldSteers) {
  const Cube cube;
  std::vector<float> second;
  for (std::int64_t i = 0; i < cube.points(); i++) second.push_back(float(cube.xyz[3 * std::size_t(i)]));
  tetlod::Context lod = cube.submitted();
  lod.run();
  const std::int64_t alone = lod.fetch_report().selected_samples;
  lod.submit_steering("x", 30, {second.data(), cube.points()});
  lod.run();
  EXPECT_GT(lod.fetch_report().selected_samples, alone);
  std::vector<double> x(std::size_t(lod.fetch_counts().points));
  lod.fetch_field("x", {x.data(), std::int64_t(x.size())});
  for (std::size_t i = 0; i < x.size(); i++) EXPECT_NEAR(x[i], lod.view_points()(std::int64_t(i), 0), 1e-6);
  EXPECT_THROW(lod.submit_steering("x", -1, {second.data(), cube.points()}), tetlod::Error);
  lod.withdraw_field("x");
  lod.run();
  EXPECT_EQ(lod.fetch_report().selected_samples, alone);
  EXPECT_THROW(lod.withdraw_field("x"), tetlod::Error);
}

TEST(Wrapper, FetchesIntoStridedMemory) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  lod.run();
  const tetlod::Counts n = lod.fetch_counts();
  std::vector<float> planes(3 * std::size_t(n.points));
  lod.fetch_points({planes.data(), n.points, 3, sizeof(float), std::int64_t(sizeof(float)) * n.points});
  std::vector<std::int64_t> tets(4 * std::size_t(n.tets));
  lod.fetch_tets(1, {tets.data(), n.tets, 4});
  for (std::int64_t i = 0; i < n.points; i++)
    EXPECT_EQ(planes[std::size_t(n.points + i)], float(lod.view_points()(i, 1)));
  for (std::size_t i = 0; i < tets.size(); i++) EXPECT_EQ(tets[i], lod.view_tets().data()[i] + 1);
}

TEST(Wrapper, SeparateCoordinatesGiveTheSameBytes) {
  const Cube cube;
  tetlod::Context packed = cube.submitted(), apart = cube.submitted();
  const std::int64_t stride = 3 * sizeof(double), n = cube.points();
  apart.submit_points_xyz({cube.xyz.data(), n, 1, stride}, {cube.xyz.data() + 1, n, 1, stride},
                          {cube.xyz.data() + 2, n, 1, stride});
  packed.run();
  apart.run();
  EXPECT_EQ(packed.fetch_report().hash, apart.fetch_report().hash);
}

TEST(Wrapper, FailuresThrowTheirStatus) {
  tetlod::Context lod;
  try {
    lod.set_rho(2);
    FAIL() << "rho 2 was taken";
  } catch (const tetlod::Error &error) {
    EXPECT_EQ(error.status(), TETLOD_ERR_OPTION);
    EXPECT_EQ(error.what(), lod.last_message());
  }
  EXPECT_THROW(lod.run(), tetlod::Error);
  EXPECT_THROW(tetlod::option_bounds(-1), tetlod::Error);
  EXPECT_EQ(tetlod::option_bounds(TETLOD_OPT_RHO).most, 1.0);
}

TEST(Wrapper, ProgressCancels) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  int calls = 0;
  lod.set_progress([&calls](std::int32_t, double) { return ++calls > 0; });
  tetlod::Context moved = std::move(lod);  // the function stays where the library looks for it
  try {
    moved.run();
    FAIL() << "not cancelled";
  } catch (const tetlod::Error &error) {
    EXPECT_EQ(error.status(), TETLOD_ERR_CANCELLED);
  }
  EXPECT_GE(calls, 1);
  moved.set_progress({});
  EXPECT_NO_THROW(moved.run());
}

TEST(Wrapper, ACallbacksExceptionComesOutOfTheCall) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  lod.set_progress([](std::int32_t, double) -> bool { throw std::logic_error("the host's own"); });
  EXPECT_THROW(lod.run(), std::logic_error);
  lod.set_progress({});
  EXPECT_NO_THROW(lod.run());
}

/// A log that throws is told more until the run ends.
TEST(Wrapper, TheFirstExceptionComesOut) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  int calls = 0;
  lod.set_real(TETLOD_OPT_TARGET_RATIO, 1e-6);  // which cannot be had, as is told
  lod.set_log([&](std::int32_t, const char *) { throw std::runtime_error(std::to_string(calls++)); }, 0);
  try {
    lod.run();
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error &error) {
    EXPECT_STREQ(error.what(), "0");
  }
  EXPECT_GT(calls, 1) << "the test looks at nothing";
}

/// Runs with a progress function that lets its Context go at the first call; whether that function lived through its
/// calls, and no longer than the run.
template <class LetGo>
void expect_lives_until_the_run_ends(tetlod::Context &lod, LetGo let_go) {
  const auto calls = std::make_shared<int>(0);
  std::weak_ptr<int> owned;
  {
    auto token = std::make_shared<int>(0);
    owned = token;
    lod.set_progress([token = std::move(token), calls, owned, let_go](std::int32_t, double) {
      const auto counted = calls;
      const auto watched = owned;
      if (++*counted == 1) let_go();
      EXPECT_FALSE(watched.expired());
      return false;
    });
  }
  lod.run();
  EXPECT_GT(*calls, 1);
  EXPECT_TRUE(owned.expired());
}

TEST(Wrapper, ACallbackMayAssignToItsContext) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  expect_lives_until_the_run_ends(lod, [&lod] { lod = tetlod::Context(); });
  EXPECT_THROW(lod.run(), tetlod::Error) << "nothing is submitted to the new one";
  lod = cube.submitted();
  EXPECT_NO_THROW(lod.run());
}

TEST(Wrapper, ACallbackMayEndItsContext) {
  const Cube cube;
  auto lod = std::make_unique<tetlod::Context>(cube.submitted());
  expect_lives_until_the_run_ends(*lod, [&lod] { lod.reset(); });
}

TEST(Wrapper, ACallbackMayMoveItsContext) {
  const Cube cube;
  tetlod::Context lod = cube.submitted();
  auto moved = std::make_unique<tetlod::Context>();
  lod.set_progress([&](std::int32_t, double) {
    if (lod.get()) moved = std::make_unique<tetlod::Context>(std::move(lod));
    return false;
  });
  lod.run();
  EXPECT_EQ(lod.get(), nullptr);
  EXPECT_GT(moved->fetch_counts().tets, 0);
}

}  // namespace
