// Values at the ends of doubles, and tets that doubles see the other way round.
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

class Extremes : public testing::Test {
 protected:
  Cube cube{6};
  Context context = make_context();

  /// Steep, in [-1, 1].
  double steep(std::size_t v) const {
    return std::tanh(8 * (cube.xyz[3 * v] - 0.5 + 0.3 * std::sin(6 * cube.xyz[3 * v + 1])));
  }
  void set(std::int32_t option, double value) { ASSERT_EQ(tetlod_set_real(context.get(), option, value), TETLOD_OK); }
  void keep(const std::vector<std::uint8_t> &flags) {
    const tetlod_array array = array_of(TETLOD_UINT8, flags.size(), 1, flags.data());
    ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK);
  }
  tetlod_run_report report() const {
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
    return report;
  }
  std::vector<double> reals(tetlod_status (*view)(const tetlod_context *, tetlod_array *)) const {
    tetlod_array array{};
    array.struct_size = sizeof array;
    EXPECT_EQ(view(context.get(), &array), TETLOD_OK);
    const auto *const data = static_cast<const double *>(array.data);
    return {data, data + array.tuples * array.components};
  }
};

/// Errors of a field that is 1e-260 of the scalars cannot be told from rounding in their units.
TEST_F(Extremes, ABoundIsRefusedWhereItCouldNotBeSeenToFail) {
  std::vector<double> second(cube.values.size());
  for (std::size_t v = 0; v < second.size(); v++) {
    cube.values[v] = 1e260 * cube.xyz[3 * v];
    second[v] = steep(v);
  }
  submit(context.get(), cube);
  const tetlod_array array = array_of(TETLOD_FLOAT64, second.size(), 1, second.data());
  ASSERT_EQ(tetlod_submit_steering(context.get(), "second", 1, &array), TETLOD_OK);
  set(TETLOD_OPT_TARGET_RATIO, 0.1);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  set(TETLOD_OPT_MAX_ERROR, 1e-3);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MAX_ERROR);
  EXPECT_NE(message_of(context.get()).find("second"), std::string::npos) << message_of(context.get());
}

/// The bound times the range is less than the least double.
TEST_F(Extremes, ABoundThatUnderflowsIsNotForgotten) {
  for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = 5e-320 * steep(v);
  submit(context.get(), cube);
  set(TETLOD_OPT_TARGET_RATIO, 0.1);
  set(TETLOD_OPT_MAX_ERROR, 1e-6);
  const tetlod_status status = tetlod_run(context.get());
  if (status == TETLOD_OK)
    EXPECT_LE(report().max_error, 1e-6);
  else
    EXPECT_EQ(status, TETLOD_ERR_MAX_ERROR) << message_of(context.get());
}

TEST_F(Extremes, TheLargestValuesStayWithinTheirRange) {
  for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = -1.5e308 - 0.2e308 * cube.xyz[3 * v];
  for (double &x : cube.xyz) x *= x * x;  // some edges are short
  submit(context.get(), cube);
  set(TETLOD_OPT_TARGET_RATIO, 0.5);
  set(TETLOD_OPT_CLEAN_EDGES, 0.05);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_GT(report().cleaned_edges, 0);
  for (double value : reals(tetlod_view_scalars)) {
    EXPECT_LE(value, -1.5e308);
    EXPECT_GE(value, -1.7e308);
  }
}

/// The range is no double, nor are differences of values; what part of it an error is, is one.
TEST_F(Extremes, TheLargestErrorIsAPartOfTheRangeThatIsNoDouble) {
  for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = v % 3 == 0 ? -1.7e308 : 1.7e308;
  submit(context.get(), cube);
  for (double ratio : {0.5, 0.1})
    for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
      set(TETLOD_OPT_TARGET_RATIO, ratio);
      ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, effort), TETLOD_OK);
      ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
      EXPECT_GT(report().max_error, 0);
      EXPECT_LE(report().max_error, 1);
      for (double value : reals(tetlod_view_scalars)) EXPECT_LE(std::abs(value), 1.7e308);
    }
}

/// Squares of these values are no doubles any more.
TEST_F(Extremes, KeptVerticesKeepTheSmallestValues) {
  cube = Cube(4);
  std::vector<std::uint8_t> flags(cube.values.size(), 0);
  for (std::size_t v = 0; v < flags.size(); v += 7) flags[v] = TETLOD_FLAG_KEEP;
  for (double scale : {1e-156, 1e-158, 1e-159, 1e-160, 1e-161, 1e-200})
    for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
      for (std::size_t v = 0; v < flags.size(); v++) {
        const double *const p = &cube.xyz[3 * v];
        cube.values[v] = scale * (p[0] * p[0] + 0.5 * p[1] * p[2]);
      }
      submit(context.get(), cube);
      keep(flags);
      set(TETLOD_OPT_TARGET_RATIO, 0.1);
      ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, effort), TETLOD_OK);
      ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
      const std::vector<double> xyz = reals(tetlod_view_points), values = reals(tetlod_view_scalars);
      std::map<std::array<double, 3>, double> at;
      for (std::size_t v = 0; v < values.size(); v++) at[{xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]}] = values[v];
      for (std::size_t v = 0; v < flags.size(); v += 7)
        EXPECT_EQ((at[{cube.xyz[3 * v], cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]}]), cube.values[v]) << scale;
    }
}

/// What a determinant in doubles says of a tet's corners, by its sign.
double sign_in_doubles(const std::vector<double> &xyz, const std::array<int, 4> &tet) {
  double d[3][3];
  for (std::size_t k = 0; k < 3; k++)
    for (std::size_t i = 0; i < 3; i++)
      d[k][i] = xyz[3 * std::size_t(tet[k + 1]) + i] - xyz[3 * std::size_t(tet[0]) + i];
  return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

/// Where coordinates have few bits left, a result is what it is said to be as it is rounded, or there is none.
TEST_F(Extremes, NothingIsRoundedFlatNextToZero) {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  int refused = 0;
  for (double scale : {1e-300, 1e12 * least, 1e3 * least, 4 * least})
    for (int preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
      cube = Cube(4);
      for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = steep(v);
      for (double &x : cube.xyz) x *= scale;
      submit(context.get(), cube);
      ASSERT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
      const tetlod_status status = tetlod_run(context.get());
      refused += status == TETLOD_ERR_MESH_DEGENERATE;
      EXPECT_TRUE(status == TETLOD_OK || (scale < 1e-310 && status == TETLOD_ERR_MESH_DEGENERATE))
          << scale << ' ' << status << ' ' << message_of(context.get());
      if (status != TETLOD_OK) continue;
      std::vector<double> xyz = reals(tetlod_view_points);
      for (double &x : xyz) x /= scale;
      tetlod_array tets{};
      tets.struct_size = sizeof tets;
      ASSERT_EQ(tetlod_view_tets(context.get(), &tets), TETLOD_OK);
      const auto *const corners = static_cast<const std::array<int, 4> *>(tets.data);
      for (std::int64_t t = 0; t < tets.tuples; t++) EXPECT_GT(sign_in_doubles(xyz, corners[t]), 0) << scale;
    }
  EXPECT_GT(refused, 0);
}

/// Of a scale whose powers are no doubles errors are those of any other scale.
TEST_F(Extremes, ErrorsAreMeasuredAtAnyScale) {
  cube = Cube(5);
  tetlod_set_preset(context.get(), TETLOD_PRESET_FAST);
  std::vector<std::vector<double>> errors;
  for (int exponent : {0, 400, -400}) {
    Cube scaled = cube;
    for (double &x : scaled.xyz) x = std::ldexp(x, exponent);
    submit(context.get(), scaled);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    tetlod_error_report error{};
    error.struct_size = sizeof error;
    ASSERT_EQ(tetlod_measure_error(context.get(), 2, &error), TETLOD_OK) << message_of(context.get());
    errors.push_back({error.rms, error.max, error.outside, error.rms_inner, error.outside_inner});
    EXPECT_EQ(errors.back(), errors.front()) << exponent;
  }
  EXPECT_GT(errors.front()[0], 0);
}

/// Some of the places that a result's vertices were given are no doubles.
TEST_F(Extremes, WhatIsRoundedFarAwayIsRefused) {
  for (int exponent : {-1070, -1068}) {
    Cube scaled = cube;
    for (double &x : scaled.xyz) x = std::ldexp(std::round(18 * x), exponent);
    submit(context.get(), scaled);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MESH_DEGENERATE);
    EXPECT_NE(message_of(context.get()).find("rounded far away"), std::string::npos) << message_of(context.get());
  }
}

/// On a side of a cube that is turned lies a tet of 3e-35, exactly; doubles see it of -9e-19. Its corners are kept.
TEST_F(Extremes, ASliverThatDoublesSeeTheOtherWayRoundKeepsTheBoundaryClosed) {
  constexpr double ca = -0.543820, sa = 0.839202, cb = -0.739185, sb = 0.673503;
  const std::array<int, 4> sliver{0, 5, 1, 4};
  cube = Cube(3);
  for (double *p = cube.xyz.data(); p != cube.xyz.data() + cube.xyz.size(); p += 3) {
    const double x = p[0] * ca - p[1] * sa, y = p[0] * sa + p[1] * ca, z = p[2];
    p[0] = x;
    p[1] = y * cb - z * sb;
    p[2] = y * sb + z * cb;
  }
  ASSERT_LT(sign_in_doubles(cube.xyz, sliver), 0);
  cube.corners.insert(cube.corners.end(), sliver.begin(), sliver.end());
  std::vector<std::uint8_t> flags(cube.values.size(), 0);
  for (int v : sliver) flags[std::size_t(v)] = TETLOD_FLAG_KEEP;
  for (double ratio : {0.9, 0.3})
    for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
      submit(context.get(), cube);
      keep(flags);
      set(TETLOD_OPT_TARGET_RATIO, ratio);
      ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, effort), TETLOD_OK);
      ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
      std::vector<std::int32_t> triangles(3 * std::size_t(report().boundary_triangles_out));
      tetlod_array array = array_of(TETLOD_INT32, triangles.size() / 3, 3, triangles.data());
      ASSERT_EQ(tetlod_fetch_boundary(context.get(), 0, &array), TETLOD_OK) << message_of(context.get());
      std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
      for (std::size_t i = 0; i < triangles.size(); i++) edges[{triangles[i], triangles[i % 3 == 2 ? i - 2 : i + 1]}]++;
      for (const auto &[edge, count] : edges) {
        EXPECT_EQ(count, 1) << edge.first << ' ' << edge.second;
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << edge.first << ' ' << edge.second;
      }
    }
}

}  // namespace
}  // namespace tetlod_test
