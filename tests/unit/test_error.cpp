// 4  The field error: closed forms, and the histograms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "measure_error.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

class Measure : public testing::Test {
 protected:
  Host host;

  FieldError measure(const Mesh &original, double range, const Mesh &result, int samples = 3) {
    return measure_error(original.view(), range, as_result(result, host.memory), samples, 1, host.job);
  }

  static void expect_zero(const FieldError &e, double tolerance) {
    for (double value : {e.rms, e.max, e.rms_inner, e.max_inner}) EXPECT_NEAR(value, 0, tolerance);
    EXPECT_EQ(e.outside, 0);
    EXPECT_EQ(e.outside_inner, 0);
  }
};

double waves(const Vec3 &p) { return std::sin(6 * p.x) + p.y * p.z; }
double linear(const Vec3 &p) { return 3 * p.x - p.y + 2 * p.z; }

TEST_F(Measure, NothingForTheSameMesh) {
  Mesh mesh = kuhn_cube(6);
  set_scalars(mesh, waves);
  expect_zero(measure(mesh, 2, mesh), 1e-12);
  Mesh shuffled = mesh;
  shuffle(shuffled, 1);
  expect_zero(measure(shuffled, 2, mesh), 1e-12);
}

TEST_F(Measure, NothingForALinearFieldOnAnyMesh) {
  Mesh fine = kuhn_cube(6), coarse = kuhn_cube(2);
  set_scalars(fine, linear);
  set_scalars(coarse, linear);
  expect_zero(measure(fine, 6, coarse), 1e-12);
  expect_zero(measure(coarse, 6, fine), 1e-12);
}

TEST_F(Measure, NothingForALargeConstantOnAnyMesh) {
  Mesh fine = kuhn_cube(6), coarse = kuhn_cube(2);
  for (Mesh *mesh : {&fine, &coarse}) set_scalars(*mesh, [](const Vec3 &) { return 1e10 / 3; });
  expect_zero(measure(fine, 0, coarse), 0);
  expect_zero(measure(coarse, 0, fine), 0);
}

TEST_F(Measure, AShiftIsTheErrorEverywhere) {
  Mesh original = kuhn_cube(4), result = original;
  set_scalars(original, waves);
  set_scalars(result, [](const Vec3 &p) { return waves(p) - 0.25; });
  for (double range : {1.0, 2.5}) {
    const FieldError e = measure(original, range, result);
    for (double value : {e.rms, e.max, e.rms_inner, e.max_inner}) EXPECT_NEAR(value, 0.25 / range, 1e-12);
  }
  EXPECT_NEAR(measure(original, 0, result).rms, 0.25, 1e-12) << "absolute";
}

/// One value wrong by delta: 1 of the vertices is wrong, and inside the tets around it the error is delta times a
/// barycentric weight, whose square has the mean 1/10.
TEST_F(Measure, OneWrongValue) {
  Mesh original = kuhn_cube(4), result = original;
  constexpr double delta = 0.5;
  constexpr std::int32_t wrong = 62;  // the middle of 125
  result.scalars[wrong] = delta;
  double around = 0;
  for (const Tet &t : original.tets)
    for (std::int32_t v : t) around += v == wrong;
  const FieldError e = measure(original, 1, result, 100);
  EXPECT_NEAR(e.rms, delta / std::sqrt(125.0), 1e-12);
  EXPECT_NEAR(e.max, delta, 1e-12);
  EXPECT_NEAR(e.rms_inner, delta * std::sqrt(0.1 * around / double(original.tets.size())), 0.03 * e.rms_inner);
  EXPECT_LT(e.max_inner, delta);
  EXPECT_GT(e.max_inner, 0.7 * delta);
}

/// A quadratic field between the corners of one large tet: the error at each vertex is known.
TEST_F(Measure, OfAQuadraticField) {
  Mesh fine = kuhn_cube(8), coarse = kuhn_cube(1);
  const auto square = [](const Vec3 &p) { return p.x * p.x; };
  set_scalars(fine, square);
  set_scalars(coarse, square);  // between: x
  const FieldError e = measure(fine, 1, coarse, 50);
  double squares = 0;
  for (int i = 0; i <= 8; i++) squares += std::pow(i / 8.0 - i * i / 64.0, 2) / 9;
  EXPECT_NEAR(e.rms, std::sqrt(squares), 1e-12);
  EXPECT_NEAR(e.max, 0.25, 1e-12);
  // Inside, uniform by volume as the tets are equal: x - x^2 against steps that are linear over an eighth; the mean
  // of (x - x^2)^2 is 1/30.
  EXPECT_NEAR(e.rms_inner, std::sqrt(1 / 30.0), 0.02);
}

TEST_F(Measure, CountsWhatIsOutside) {
  Mesh whole = kuhn_solid({4, 4, 4}, [](const Cell &) { return true; });
  Mesh half = kuhn_solid({4, 4, 4}, [](const Cell &c) { return c[0] < 2; });
  set_scalars(whole, [](const Vec3 &p) { return p.x > 2 ? 1e6 : 1.0; });
  set_scalars(half, [](const Vec3 &) { return 1.0; });
  const FieldError e = measure(whole, 1, half, 2);
  EXPECT_NEAR(e.outside, 2.0 / 5, 1e-12);
  EXPECT_NEAR(e.outside_inner, 0.5, 1e-12);
  expect_zero({e.rms, e.max, 0, e.rms_inner, e.max_inner, 0}, 1e-12);
  transform(half, [](const Vec3 &p) { return p + Vec3(100); });
  const FieldError off = measure(whole, 1, half, 2);
  EXPECT_EQ(off.outside, 1);
  EXPECT_EQ(off.outside_inner, 1);
  expect_zero({off.rms, off.max, 0, off.rms_inner, off.max_inner, 0}, 0);
}

TEST_F(Measure, IgnoresPointsThatNoTetUses) {
  Mesh mesh = kuhn_cube(3);
  set_scalars(mesh, waves);
  const Mesh result = mesh;
  mesh.points.push_back(Vec3(0.5));
  mesh.points.push_back(Vec3(7));
  mesh.scalars.insert(mesh.scalars.end(), 2, std::numeric_limits<double>::quiet_NaN());
  expect_zero(measure(mesh, 1, result), 1e-12);
}

TEST_F(Measure, WithoutSamplesInside) {
  Mesh original = kuhn_cube(3), result = original;
  set_scalars(result, [](const Vec3 &) { return 1.0; });
  const FieldError e = measure(original, 1, result, 0);
  EXPECT_NEAR(e.rms, 1, 1e-12);
  EXPECT_EQ(e.rms_inner, 0);
  EXPECT_EQ(e.outside_inner, 0);
}

TEST_F(Measure, ThreadsDoNotMatterAndSeedsDo) {
  Mesh fine = kuhn_cube(12), coarse = kuhn_cube(5);
  set_scalars(fine, waves);
  set_scalars(coarse, waves);
  const TetMesh result = as_result(coarse, host.memory);
  Host two(2);
  const FieldError a = measure_error(fine.view(), 2, result, 2, 1, host.job);
  const FieldError b = measure_error(fine.view(), 2, result, 2, 1, two.job);
  const FieldError c = measure_error(fine.view(), 2, result, 2, 2, host.job);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  EXPECT_EQ(a.rms, c.rms);
  EXPECT_NE(a.rms_inner, c.rms_inner);
  EXPECT_NEAR(a.rms_inner, c.rms_inner, 0.05 * a.rms_inner);
}

/// From the caller's arrays: coincident points are merged first, the range is that of the used vertices.
TEST_F(Measure, OfSubmittedArrays) {
  Mesh mesh = kuhn_cube(3);
  set_scalars(mesh, [](const Vec3 &p) { return 10 * p.x; });
  Mesh result = mesh;
  for (double &s : result.scalars) s += 1;
  Result whole(host.memory);
  whole.mesh = as_result(result, host.memory);
  whole.original = fingerprint_of_mesh(input_of(mesh), Options(), host.job);
  Prepared prepared(host.memory);
  const FieldError e = measure_error(input_of(mesh), Options(), whole, 2, prepared, host.job);
  EXPECT_NEAR(e.rms, 0.1, 1e-12);
  EXPECT_NEAR(e.max_inner, 0.1, 1e-12);
}

// Histograms

std::vector<std::int64_t> bins(const std::vector<double> &values, double low, double high, std::size_t count) {
  std::vector<std::int64_t> counts(count, 0);
  histogram({values.data(), values.size()}, low, high, {counts.data(), counts.size()});
  return counts;
}

TEST(Histogram, KnownBins) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bins({0, 0.24, 0.25, 0.5, 0.99, 1, 1.01, -0.01, nan}, 0, 1, 4), (std::vector<std::int64_t>{2, 1, 1, 2}));
  EXPECT_EQ(bins({5, 5, 5}, 5, 5, 3), (std::vector<std::int64_t>{3, 0, 0}));
  EXPECT_EQ(bins({1, 2, 3}, 0, 4, 1), std::vector<std::int64_t>{3});
}

TEST(Histogram, CountsEveryValueOnce) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(1e-7, 1e-8);
  std::vector<double> values;
  for (int i = 0; i < 10000; i++) values.push_back(normal(random));
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  for (std::size_t count : {1u, 2u, 7u, 1000u}) {
    const auto counts = bins(values, *low, *high, count);
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::int64_t(0)), 10000);
    const double width = (*high - *low) / double(count);
    std::int64_t below = 0, expected = 0;
    for (std::size_t b = 0; b < count / 2; b++) below += counts[b];
    for (double v : values) expected += v < *low + width * double(count / 2);
    EXPECT_LE(std::abs(below - expected), 1) << count << " bins";
  }
}

TEST(Histogram, AddsToWhatIsThere) {
  std::vector<std::int64_t> counts{5, 7};
  const std::vector<double> values{0.1, 0.9};
  histogram({values.data(), values.size()}, 0, 1, {counts.data(), counts.size()});
  EXPECT_EQ(counts, (std::vector<std::int64_t>{6, 8}));
}

}  // namespace
}  // namespace tetlod
