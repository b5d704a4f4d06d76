// What the run report counts, against what the result says.
#include <array>
#include <cmath>
#include <random>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Of this many cells along x, y and z, those whose x and y are the same: they touch along edges alone.
Cube diagonal(int n) {
  Cube cube(n);
  const std::vector<std::int32_t> all = std::move(cube.corners);
  cube.corners.clear();
  for (std::size_t cell = 0; cell < all.size() / 24; cell++) {
    const auto x = std::ptrdiff_t(cell) % n, y = std::ptrdiff_t(cell) / n % n;
    if (x == y) cube.corners.insert(cube.corners.end(), &all[24 * cell], &all[24 * cell] + 24);
  }
  return cube;
}

TEST(RunReport, CountsWhereTheSolidTouchesItself) {
  for (int n : {2, 3}) {
    const Cube cube = diagonal(n);
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 1), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const tetlod_run_report report = report_of(context.get());
    EXPECT_EQ(report.components, n);
    EXPECT_EQ(report.nonmanifold_edges, (n - 1) * n);
    EXPECT_EQ(report.nonmanifold_points, (n - 1) * (n + 1));
    EXPECT_EQ(report.unused_points, (n + 1) * (n + 1) * (n + 1) - (n * 4 - (n - 1)) * (n + 1));
  }
}

/// A ball, and what the paper's method makes of it with every vertex inside as a sample.
struct Ball {
  Ball() {
    make_ball(cube);
    for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = double(v * v);
    submit(context.get(), cube);
    tetlod_set_rho(context.get(), 0);
    tetlod_set_sigma(context.get(), 0.006);
  }

  tetlod_run_report run(double min_distance) {
    tetlod_set_min_distance(context.get(), min_distance);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    read_boundary();
    return report_of(context.get());
  }

  void read_boundary() {
    std::int64_t points = 0, count = 0;
    tetlod_fetch_counts(context.get(), &points, nullptr, &count);
    xyz.resize(std::size_t(points));
    triangles.resize(std::size_t(count));
    tetlod_array array = array_of(TETLOD_FLOAT64, xyz.size(), 3, xyz.data());
    EXPECT_EQ(tetlod_fetch_points(context.get(), &array), TETLOD_OK);
    array = array_of(TETLOD_INT32, triangles.size(), 3, triangles.data());
    EXPECT_EQ(tetlod_fetch_boundary(context.get(), 0, &array), TETLOD_OK);
  }

  /// The sum of solid angles [Van Oosterom and Strackee 1983].
  bool is_inside(const double *p) const {
    double sum = 0;
    for (const auto &t : triangles) {
      std::array<std::array<double, 3>, 3> w{};
      std::array<double, 3> length{};
      for (std::size_t k = 0; k < 3; k++) {
        for (std::size_t i = 0; i < 3; i++) w[k][i] = xyz[std::size_t(t[k])][i] - p[i];
        length[k] = std::hypot(w[k][0], w[k][1], w[k][2]);
      }
      const auto dot = [&](std::size_t a, std::size_t b) {
        return w[a][0] * w[b][0] + w[a][1] * w[b][1] + w[a][2] * w[b][2];
      };
      const double det = w[0][0] * (w[1][1] * w[2][2] - w[1][2] * w[2][1]) +
                         w[0][1] * (w[1][2] * w[2][0] - w[1][0] * w[2][2]) +
                         w[0][2] * (w[1][0] * w[2][1] - w[1][1] * w[2][0]);
      sum += 2 * std::atan2(det, length[0] * length[1] * length[2] + dot(0, 1) * length[2] + dot(1, 2) * length[0] +
                                     dot(2, 0) * length[1]);
    }
    return sum > 2 * pi;
  }

  /// Of the original's vertices inside, those outside of the result.
  std::int64_t count_outside() const {
    std::int64_t count = 0;
    for (std::size_t v = 0; v < cube.values.size(); v++) {
      const double *const p = &cube.xyz[3 * v];
      if (std::hypot(p[0], p[1], p[2]) < 1 - 1e-9) count += !is_inside(p);
    }
    return count;
  }

  Cube cube{16};
  Context context = make_context();
  std::vector<std::array<double, 3>> xyz;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

TEST(RunReport, CountsSamplesThatAreRemoved) {
  Ball ball;
  const tetlod_run_report all = ball.run(0), apart = ball.run(0.03);
  const std::int64_t outside = ball.count_outside();
  EXPECT_GT(outside, 0);
  EXPECT_GT(apart.samples_too_near, all.samples_too_near);
  for (const tetlod_run_report &report : {all, apart}) {
    EXPECT_EQ(report.selected_samples, 15 * 15 * 15);
    EXPECT_EQ(report.samples_outside, outside);
    EXPECT_EQ(report.samples, report.selected_samples - outside - report.samples_too_near);
  }
  EXPECT_EQ(apart.points_out, apart.boundary_points_out + apart.samples + apart.steiner_points);
  EXPECT_GT(apart.worker_peak_bytes, 1U << 20);
}

TEST(RunReport, ThePeakIsOfTheLastRun) {
  const Context context = make_context();
  const auto peak_of = [&](int cells) {
    const Cube cube(cells);
    submit(context.get(), cube);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_EQ(tetlod_clear(context.get()), TETLOD_OK);
    return report_of(context.get()).peak_bytes;
  };
  const std::uint64_t large = peak_of(16);
  EXPECT_LT(peak_of(4), large / 2);
}

TEST(RunReport, CountsInsertedPoints) {
  Ball ball;
  tetlod_set_preset(ball.context.get(), TETLOD_PRESET_ACCURATE);
  ASSERT_EQ(tetlod_run(ball.context.get()), TETLOD_OK) << message_of(ball.context.get());
  const tetlod_run_report report = report_of(ball.context.get());
  EXPECT_GT(report.inserted_points, 0);
  EXPECT_EQ(report.points_out,
            report.boundary_points_out + report.samples + report.steiner_points + report.inserted_points);
}

/// Walls that are plane to within a few times rounding: a vertex may come to be inside as its tet gets higher.
TEST(RunReport, TheLargestErrorIsWhatIsMeasured) {
  for (unsigned seed = 0; seed < 60; seed++) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 1), jitter(-4e-7, 4e-7);
    Cube cube(6);
    for (double &x : cube.xyz) x += jitter(random) * (x == 0 || x == 1);
    for (double &value : cube.values) value = any(random);
    const Context context = make_context();
    submit(context.get(), cube);
    tetlod_set_preset(context.get(), seed % 2 ? TETLOD_PRESET_FAST : TETLOD_PRESET_ACCURATE);
    tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.3);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    tetlod_error_report measured{};
    measured.struct_size = sizeof measured;
    ASSERT_EQ(tetlod_measure_error(context.get(), 0, &measured), TETLOD_OK);
    EXPECT_LE(measured.max, report_of(context.get()).max_error + 1e-5) << seed << ": by more than rounding of weights";
  }
}

}  // namespace
}  // namespace tetlod_test
