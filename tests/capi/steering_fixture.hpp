// A cube with several fields that steer, and what they are off by in a result.
#pragma once
#include <algorithm>
#include <cmath>

#include "fields_fixture.hpp"

namespace tetlod_test {

/// Fronts across the cube: steep where p is near a plane, flat elsewhere.
inline double front_x(const Point &p, int) { return std::tanh(15 * (p[0] + 0.2 * p[1] - 0.4)); }
inline double front_z(const Point &p, int) { return 100 + 5 * std::tanh(15 * (p[2] - 0.3 * p[1] - 0.5)); }

class Steering : public Fields {
 protected:
  Steering() { cube = Cube(10); }

  std::vector<double> x = field_of(Cube(10), 1, front_x), z = field_of(Cube(10), 1, front_z);

  void SetUp() override {
    cube.values = x;
    submit(context.get(), cube);
    set_target(0.15);
  }

  void set_target(double ratio) {
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
  }

  tetlod_status steer(const char *name, double weight, const std::vector<double> &field) {
    const tetlod_array array = array_of(TETLOD_FLOAT64, field.size(), 1, field.data());
    return tetlod_submit_steering(context.get(), name, weight, &array);
  }

  tetlod_run_report report() const {
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
    return report;
  }

  struct Error {
    double rms = 0, max = 0;
  };

  std::vector<double> scalars() const {
    std::vector<double> values(points_out());
    tetlod_array array = array_of(TETLOD_FLOAT64, values.size(), 1, values.data());
    EXPECT_EQ(tetlod_fetch_scalars(context.get(), &array), TETLOD_OK);
    return values;
  }

  /// Of the result's values against the original's, at the original vertices in it, over the range.
  Error error_of(const std::vector<double> &result, const std::vector<double> &original) const {
    const auto at = result_points();
    std::vector<std::int32_t> corners(4 * tets_out());
    tetlod_array array = array_of(TETLOD_INT32, tets_out(), 4, corners.data());
    EXPECT_EQ(tetlod_fetch_tets(context.get(), 0, &array), TETLOD_OK);
    const auto [low, high] = std::minmax_element(original.begin(), original.end());
    Error error;
    std::size_t inside = 0;
    for (std::size_t v = 0; v < original.size(); v++) {
      double value = 0;
      if (!value_at(cube.xyz.data() + 3 * v, at, corners, result, value)) continue;
      const double off = std::abs(value - original[v]) / (*high > *low ? *high - *low : 1);
      error.rms += off * off;
      error.max = std::max(error.max, off);
      inside++;
    }
    EXPECT_GT(inside, original.size() / 2);
    error.rms = std::sqrt(error.rms / double(inside));
    return error;
  }
  Error error_of(const char *name, const std::vector<double> &original) {
    return error_of(fetch(name, 1, points_out()), original);
  }

 private:
  static double det(const double *a, const double *b, const double *c, const double *d) {
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  }

  /// In the tet that p is least outside of; false where that is beyond rounding.
  static bool value_at(const double *p, const std::vector<Point> &at, const std::vector<std::int32_t> &corners,
                       const std::vector<double> &values, double &value) {
    double best = -1e-9;
    bool found = false;
    for (std::size_t t = 0; t < corners.size(); t += 4) {
      const double *c[4];
      for (std::size_t k = 0; k < 4; k++) c[k] = at[std::size_t(corners[t + k])].data();
      const double whole = det(c[0], c[1], c[2], c[3]);
      const double w[4] = {det(p, c[1], c[2], c[3]) / whole, det(c[0], p, c[2], c[3]) / whole,
                           det(c[0], c[1], p, c[3]) / whole, det(c[0], c[1], c[2], p) / whole};
      const double least = std::min({w[0], w[1], w[2], w[3]});
      if (least <= best) continue;
      best = least;
      found = true;
      value = 0;
      for (std::size_t k = 0; k < 4; k++) value += w[k] * values[std::size_t(corners[t + k])];
    }
    return found;
  }
};

}  // namespace tetlod_test
