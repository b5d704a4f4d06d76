// A context that has had runs, beside one that has had none.
#pragma once
#include <cmath>
#include <functional>

#include "fixtures.hpp"

namespace tetlod_test {

class Reuse : public testing::Test {
 protected:
  Cube cube{8};
  std::vector<std::uint8_t> flags;
  std::vector<double> second;  // steers, too, with a weight
  double weight = 1;
  Context context = make_context();
  std::vector<std::function<void(tetlod_context *)>> options;

  void set_up(tetlod_context *of) {
    tetlod_set_sigma(of, 0.3);
    tetlod_set_rho(of, 0.1);
    for (const auto &option : options) option(of);
    submit(of, cube);
    if (!second.empty()) {
      const tetlod_array array = array_of(TETLOD_FLOAT64, second.size(), 1, second.data());
      EXPECT_EQ(tetlod_submit_steering(of, "second", weight, &array), TETLOD_OK);
    }
    if (flags.empty()) return;
    const tetlod_array array = array_of(TETLOD_UINT8, flags.size(), 1, flags.data());
    EXPECT_EQ(tetlod_submit_point_flags(of, &array), TETLOD_OK);
  }

  /// A run of the context, which has had others, gives what a context that has had none gives.
  tetlod_run_report expect_fresh_bytes() {
    set_up(context.get());
    const Context fresh = make_context();
    set_up(fresh.get());
    const tetlod_status status = tetlod_run(fresh.get());
    EXPECT_EQ(tetlod_run(context.get()), status) << message_of(context.get());
    if (status != TETLOD_OK) {
      EXPECT_EQ(message_of(context.get()), message_of(fresh.get()));
      return {};
    }
    EXPECT_EQ(bytes_of(context.get()), bytes_of(fresh.get()));
    const tetlod_run_report again = report_of(context.get()), first = report_of(fresh.get());
    EXPECT_EQ(first.reused_tets, 0);
    expect_same_counts(again, first);
    return again;
  }

  /// The report counts the same, from the original's points to the retries of the boundary.
  static void expect_same_counts(const tetlod_run_report &a, const tetlod_run_report &b) {
    for (const std::int64_t *x = &a.points_in, *y = &b.points_in; x <= &a.boundary_retries; x++, y++)
      EXPECT_EQ(*x, *y) << "count " << x - &a.points_in;
    EXPECT_EQ(a.hash, b.hash);
    EXPECT_EQ(a.max_deviation, b.max_deviation);
    EXPECT_EQ(a.max_error, b.max_error);
    EXPECT_EQ(a.scalar_min, b.scalar_min);
    EXPECT_EQ(a.scalar_max, b.scalar_max);
  }

  void new_values(double phase) {
    for (std::size_t v = 0; v < cube.values.size(); v++)
      cube.values[v] = std::sin(3 * cube.xyz[3 * v] + phase) + cube.xyz[3 * v + 1];
  }

  std::int64_t tets() const { return std::int64_t(cube.corners.size() / 4); }
};

}  // namespace tetlod_test
