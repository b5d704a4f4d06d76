// Several fields that steer, with weights.
#include <limits>
#include <string>

#include "steering_fixture.hpp"

namespace tetlod_test {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Nearly, where an edge of the cube is rounded off; exactly with the whole boundary.
TEST_F(Steering, LinearFieldsAreExact) {
  cube.values = field_of(cube, 1, linear);
  submit(context.get(), cube);
  const auto second = field_of(cube, 1, [](const Point &p, int) { return 1000 - 70 * p[1] + 9 * p[2]; });
  ASSERT_EQ(steer("second", 1, second), TETLOD_OK);
  run();
  for (const Error &error : {error_of(scalars(), cube.values), error_of("second", second)}) {
    EXPECT_LT(error.rms, 2e-3);
    EXPECT_LT(error.max, 0.02);
  }
  set_target(0);
  tetlod_set_sigma(context.get(), 1);
  tetlod_set_rho(context.get(), 0.3);
  run();
  EXPECT_LT(tets_out(), tets() / 2);
  EXPECT_LT(error_of(scalars(), cube.values).max, 1e-12);
  EXPECT_LT(error_of("second", second).max, 1e-12);
}

TEST_F(Steering, WeightZeroRidesAlong) {
  ASSERT_EQ(carry("z", z, 1), TETLOD_OK);
  run();
  const auto bytes = bytes_of(context.get());
  const auto carried = fetch("z", 1, points_out());
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  EXPECT_NE(bytes_of(context.get()), bytes);
  ASSERT_EQ(steer("z", 0, z), TETLOD_OK);
  run();
  EXPECT_EQ(bytes_of(context.get()), bytes);
  EXPECT_EQ(fetch("z", 1, points_out()), carried);
}

TEST_F(Steering, ItIsNoMatterWhichCameFirst) {
  const auto y = field_of(cube, 1, [](const Point &p, int) { return std::sin(5 * p[1]); });
  ASSERT_EQ(steer("y", 1, y), TETLOD_OK);
  ASSERT_EQ(steer("z", 2, z), TETLOD_OK);
  run();
  const auto bytes = bytes_of(context.get());
  ASSERT_EQ(carry("y", y, 1), TETLOD_OK);  // in its place z is the first, and y the last
  ASSERT_EQ(steer("y", 1, y), TETLOD_OK);
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  EXPECT_EQ(tetlod_measure_error(context.get(), 0, &error), TETLOD_OK) << "the run's input is submitted";
  run();
  EXPECT_EQ(bytes_of(context.get()), bytes);
}

TEST_F(Steering, AFrontThatSteersIsMuchNearer) {
  ASSERT_EQ(carry("z", z, 1), TETLOD_OK);
  run();
  const Error riding = error_of("z", z);
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  const Error x_steers = error_of(scalars(), x), z_steers = error_of("z", z);
  EXPECT_LT(z_steers.rms, 0.35 * riding.rms);
  EXPECT_LT(x_steers.rms, 0.35 * riding.rms) << "the tets are shared";
  // Of all fields; a vertex on the boundary is inside for one and, by rounding, outside for the other.
  const double largest = std::max(x_steers.max, z_steers.max);
  EXPECT_GE(report().max_error, largest - 1e-9);
  EXPECT_LT(report().max_error, 1.5 * largest);
}

TEST_F(Steering, WeightsDecideWhoIsNearer) {
  double last_x = 0, last_z = infinity;
  for (double weight : {0.1, 1.0, 10.0}) {
    ASSERT_EQ(steer("z", weight, z), TETLOD_OK);
    run();
    const double of_x = error_of(scalars(), x).rms, of_z = error_of("z", z).rms;
    EXPECT_GT(of_x, last_x) << weight;
    EXPECT_LT(of_z, last_z) << weight;
    last_x = of_x;
    last_z = of_z;
  }
}

/// Unit and origin of a field mean nothing.
TEST_F(Steering, OnlyThePartOfTheRangeCounts) {
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  const auto bytes = bytes_of(context.get());
  auto scaled = z;
  for (double &value : scaled) value = std::ldexp(value, 500);
  ASSERT_EQ(steer("z", 1, scaled), TETLOD_OK);
  run();
  EXPECT_EQ(bytes_of(context.get()), bytes) << "a power of two";
}

TEST_F(Steering, TheOrderMakesLittleDifference) {
  const auto third = field_of(cube, 1, bent);
  const auto errors = [&](const char *first, const char *second) {
    for (const char *name : {first, second}) EXPECT_EQ(steer(name, 1, name == std::string("z") ? z : third), TETLOD_OK);
    run();
    return std::array<double, 3>{error_of(scalars(), x).rms, error_of("z", z).rms, error_of("third", third).rms};
  };
  const auto one = errors("z", "third");
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  submit(context.get(), cube);
  const auto other = errors("third", "z");
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  cube.values = z;  // the scalars change places with a field of weight 1
  submit(context.get(), cube);
  EXPECT_EQ(steer("x", 1, x), TETLOD_OK);
  EXPECT_EQ(steer("third", 1, third), TETLOD_OK);
  run();
  const std::array<double, 3> swapped = {error_of("x", x).rms, error_of(scalars(), z).rms,
                                         error_of("third", third).rms};
  for (std::size_t k = 0; k < 3; k++) {
    EXPECT_NEAR(other[k], one[k], 0.2 * one[k]) << k;
    EXPECT_NEAR(swapped[k], one[k], 0.2 * one[k]) << k;
  }
}

/// Whatever the weights, and however many fields there are.
TEST_F(Steering, MaxErrorHoldsForEach) {
  const auto third = field_of(cube, 1, bent),
             fourth = field_of(cube, 1, [](const Point &p, int) { return 1e-6 * std::cos(6 * p[0] * p[1]); });
  set_target(0.05);
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.04), TETLOD_OK);
  ASSERT_EQ(steer("z", 1e-3, z), TETLOD_OK);
  ASSERT_EQ(steer("third", 1, third), TETLOD_OK);
  ASSERT_EQ(steer("fourth", 50, fourth), TETLOD_OK);
  run();
  EXPECT_LE(report().max_error, 0.04);
  EXPECT_GT(report().max_error, 0.004);
  EXPECT_LE(error_of(scalars(), x).max, 0.04);
  EXPECT_LE(error_of("z", z).max, 0.04);
  EXPECT_LE(error_of("third", third).max, 0.04);
  EXPECT_LE(error_of("fourth", fourth).max, 0.04);
}

/// As published: values where samples and the boundary's own vertices are stay those of the original, of each field.
TEST_F(Steering, ThePaperSamplesBoth) {
  set_target(0);
  tetlod_set_sigma(context.get(), 1);
  tetlod_set_rho(context.get(), 0.2);
  run();
  const std::int64_t alone = report().selected_samples;
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  EXPECT_GT(report().selected_samples, alone + alone / 4);
  const auto at = result_points();
  const auto of_x = scalars(), of_z = fetch("z", 1, points_out());
  std::size_t known = 0;
  for (std::size_t i = 0; i < at.size(); i++)
    for (std::size_t v = 0; v < points(); v++)
      if (std::memcmp(cube.xyz.data() + 3 * v, at[i].data(), sizeof(Point)) == 0) {
        EXPECT_EQ(of_x[i], x[v]);
        EXPECT_EQ(of_z[i], z[v]);
        known++;
      }
  EXPECT_GE(known, at.size() - std::size_t(report().steiner_points));
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  for (double value : of_z) EXPECT_TRUE(value >= *low && value <= *high);
}

/// A constant field gains nothing and costs nothing, also as the scalars.
TEST_F(Steering, ConstantFields) {
  const std::vector<double> constant(points(), -3e7);
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.1), TETLOD_OK);
  run();
  const Error alone = error_of(scalars(), x);
  ASSERT_EQ(steer("constant", 1, constant), TETLOD_OK);
  run();
  EXPECT_NEAR(error_of(scalars(), x).rms, alone.rms, 0.3 * alone.rms);
  for (double value : fetch("constant", 1, points_out())) EXPECT_EQ(value, -3e7);
  cube.values = constant;
  submit(context.get(), cube);
  ASSERT_EQ(steer("constant", 0, constant), TETLOD_OK);
  ASSERT_EQ(steer("x", 1, x), TETLOD_OK);
  run();
  EXPECT_LT(error_of("x", x).rms, 2 * alone.rms);
  EXPECT_LE(report().max_error, 0.1);
  for (double value : scalars()) EXPECT_EQ(value, -3e7);
}

TEST_F(Steering, ExtremeRanges) {
  auto huge = z, tiny = field_of(cube, 1, bent);
  for (double &value : huge) value *= 1e200;
  for (double &value : tiny) value *= 1e-200;
  ASSERT_EQ(steer("huge", 1e-6, huge), TETLOD_OK);
  ASSERT_EQ(steer("tiny", 1e6, tiny), TETLOD_OK);
  run();
  EXPECT_LT(error_of("tiny", tiny).rms, 0.02);
  EXPECT_LT(error_of("huge", huge).rms, 0.3);
  EXPECT_LE(report().max_error, 1);
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0), TETLOD_OK);
  run();
  EXPECT_LT(error_of("huge", huge).max, 1);
}

/// A size is met all the same, and the log says so; a bound is refused.
TEST_F(Steering, RangesTooFarApart) {
  std::string told;
  const auto tell = [](void *user, int32_t, const char *message) { *static_cast<std::string *>(user) += message; };
  ASSERT_EQ(tetlod_set_log(context.get(), tell, &told, 2), TETLOD_OK);
  for (double factor : {1e200, 1e-200}) {
    auto other = z;
    for (std::size_t v = 0; v < points(); v++) cube.values[v] = factor * x[v];
    for (double &value : other) value /= factor;
    submit(context.get(), cube);
    ASSERT_EQ(steer("other", 1, other), TETLOD_OK);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0), TETLOD_OK);
    told.clear();
    run();
    EXPECT_LE(report().max_error, 1);
    EXPECT_EQ(told.find("the smaller one does not steer: field other: its range and the scalars', 1.99"), 0U) << told;
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.1), TETLOD_OK);
    expect_failure(tetlod_run(context.get()), TETLOD_ERR_MAX_ERROR, "max-error cannot be held for field other: its ra");
    std::uint64_t bytes = 0;
    EXPECT_EQ(tetlod_estimate_memory(context.get(), &bytes), TETLOD_ERR_MAX_ERROR);
  }
}

/// It has no errors, whatever its value.
TEST_F(Steering, AConstantIsNotTooFarApart) {
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.1), TETLOD_OK);
  for (double value : {0.0, 5.0, 1e200}) {
    const std::vector<double> constant(points(), value);
    for (const auto &scalars : {std::vector<double>(points(), 0), x}) {
      cube.values = scalars;
      submit(context.get(), cube);
      ASSERT_EQ(steer("constant", 1, constant), TETLOD_OK);
      EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << value << ": " << message_of(context.get());
    }
  }
}

TEST_F(Steering, ANameIsOneField) {
  ASSERT_EQ(carry("z", z, 1), TETLOD_OK);
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  const auto steered = fetch("z", 1, points_out());
  const auto bytes = bytes_of(context.get());
  EXPECT_NE(steered, move(z, 1)) << "fitted";
  const std::vector<double> pairs(2 * points(), 4);
  ASSERT_EQ(carry("z", pairs, 2), TETLOD_OK);
  run();
  EXPECT_NE(bytes_of(context.get()), bytes);
  EXPECT_EQ(fetch("z", 2, points_out()), std::vector<double>(2 * points_out(), 4));
  ASSERT_EQ(steer("z", 2, x), TETLOD_OK);
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  run();
  EXPECT_EQ(bytes_of(context.get()), bytes);
  EXPECT_EQ(fetch("z", 1, points_out()), steered);
}

TEST_F(Steering, WithdrawnFieldsAreGoneAndTheMeshIsStillKnown) {
  run();
  const auto alone = bytes_of(context.get());
  {
    const std::vector<double> steering = z, carried(3 * points(), 4);  // which are no more when it runs again
    ASSERT_EQ(steer("steering", 1, steering), TETLOD_OK);
    ASSERT_EQ(carry("carried", carried, 3), TETLOD_OK);
    run();
    EXPECT_NE(bytes_of(context.get()), alone);
    ASSERT_EQ(tetlod_withdraw_field(context.get(), "steering"), TETLOD_OK);
    ASSERT_EQ(tetlod_withdraw_field(context.get(), "carried"), TETLOD_OK);
    EXPECT_EQ(fetch("carried", 3, points_out()), std::vector<double>(3 * points_out(), 4)) << "the result has it";
  }
  run();
  EXPECT_EQ(bytes_of(context.get()), alone);
  EXPECT_EQ(report().reused_tets, report().tets_in);
  double room = 0;
  tetlod_array array = array_of(TETLOD_FLOAT64, 1, 1, &room);
  expect_failure(tetlod_fetch_field(context.get(), "carried", &array), TETLOD_ERR_ARGUMENT, "carried no field carried");
}

TEST_F(Steering, WhatCannotBeWithdrawn) {
  ASSERT_EQ(steer("a", 1, x), TETLOD_OK);
  ASSERT_EQ(carry("b", z, 1), TETLOD_OK);
  ASSERT_EQ(carry("c", z, 1), TETLOD_OK);
  expect_failure(tetlod_withdraw_field(context.get(), "u"), TETLOD_ERR_ARGUMENT,
                 "field u is not submitted, but to ride along b, c, to steer a");
  expect_failure(tetlod_withdraw_field(context.get(), "heat"), TETLOD_ERR_ARGUMENT, "field heat");
  expect_failure(tetlod_withdraw_field(context.get(), ""), TETLOD_ERR_ARGUMENT, "name is empty");
  expect_failure(tetlod_withdraw_field(context.get(), nullptr), TETLOD_ERR_ARGUMENT, "name is NULL");
  run();
  EXPECT_EQ(fetch("b", 1, points_out()).size(), points_out());
}

TEST_F(Steering, WhatIsRefused) {
  expect_failure(steer("z", -1, z), TETLOD_ERR_ARGUMENT, "field z: weight -1 is not in [0, 1e+06]");
  expect_failure(steer("z", nan_value, z), TETLOD_ERR_ARGUMENT, "field z: weight nan");
  expect_failure(steer("z", infinity, z), TETLOD_ERR_ARGUMENT, "field z: weight inf");
  expect_failure(steer("z", 1.1e6, z), TETLOD_ERR_ARGUMENT, "field z: weight 1100000 is not");
  expect_failure(steer(nullptr, 1, z), TETLOD_ERR_ARGUMENT, "name is NULL");
  expect_failure(steer("", 1, z), TETLOD_ERR_ARGUMENT, "name is empty");
  expect_failure(steer("bent", 1, z), TETLOD_ERR_ARGUMENT, "field bent: the scalars have this name");
  tetlod_array array = array_of(TETLOD_FLOAT64, points(), 2, z.data());
  expect_failure(tetlod_submit_steering(context.get(), "z", 1, &array), TETLOD_ERR_ARGUMENT, "field z: 2 components");
  expect_failure(tetlod_submit_steering(context.get(), "z", 1, nullptr), TETLOD_ERR_ARGUMENT, "field z is NULL");
  for (const char *name : {"a", "b", "c"}) ASSERT_EQ(steer(name, 1, z), TETLOD_OK);
  expect_failure(steer("d", 1, z), TETLOD_ERR_ARGUMENT,
                 "field d: 3 fields beside the scalars steer at most, and there are a, b, c");
  EXPECT_EQ(steer("d", 0, z), TETLOD_OK) << "it rides along";
  EXPECT_EQ(steer("b", 3, x), TETLOD_OK) << "in the place of itself";
  array = array_of(TETLOD_FLOAT64, points(), 1, x.data());
  expect_failure(tetlod_submit_scalars(context.get(), "a", &array), TETLOD_ERR_ARGUMENT,
                 "scalars: field a steers by this name already");
  EXPECT_EQ(tetlod_submit_scalars(context.get(), nullptr, &array), TETLOD_OK);
  const std::vector<double> few(7, 1);
  ASSERT_EQ(steer("c", 1, few), TETLOD_OK);
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT, "field c: 7 tuples for 1331 points");
  tetlod_mesh_report found{};
  found.struct_size = sizeof found;
  expect_failure(tetlod_check(context.get(), &found), TETLOD_ERR_ARGUMENT, "field c: 7 tuples for 1331 points");
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  EXPECT_EQ(steer("d", 1, z), TETLOD_OK) << "nothing is there after clear";
}

TEST_F(Steering, ValuesThatAreNotFinite) {
  z[17] = nan_value;
  ASSERT_EQ(steer("z", 1, z), TETLOD_OK);
  tetlod_mesh_report found{};
  found.struct_size = sizeof found;
  ASSERT_EQ(tetlod_check(context.get(), &found), TETLOD_OK);
  EXPECT_EQ(found.status, TETLOD_ERR_MESH_NONFINITE);
  EXPECT_EQ(found.nonfinite_values.count, 1);
  EXPECT_EQ(found.nonfinite_values.first, 17);
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_MESH_NONFINITE, "the value of field z of vertex 17 is nan (on");
  z[18] = z[40] = nan_value;
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_MESH_NONFINITE,
                 "the value of field z of vertex 17 is nan, and 2 more vertices have none (on-nonfinite: error)");
  z[18] = z[40] = 0;
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR), TETLOD_OK);
  run();
  EXPECT_EQ(report().nonfinite_points, 1);
  for (double value : fetch("z", 1, points_out())) ASSERT_TRUE(std::isfinite(value));
  ASSERT_EQ(carry("z", z, 1), TETLOD_OK);  // what rides along may be anything
  run();
  EXPECT_EQ(report().nonfinite_points, 0);
}

}  // namespace
}  // namespace tetlod_test
