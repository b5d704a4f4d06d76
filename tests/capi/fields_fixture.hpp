// A cube with fields that ride along.
#pragma once
#include <cmath>
#include <functional>

#include "fixtures.hpp"

namespace tetlod_test {

using Point = std::array<double, 3>;

/// A field of the cube's points, packed.
inline std::vector<double> field_of(const Cube &cube, int components,
                                    const std::function<double(const Point &, int)> &value) {
  std::vector<double> field;
  for (std::size_t v = 0; v < cube.values.size(); v++)
    for (int c = 0; c < components; c++) {
      const double *const p = cube.xyz.data() + 3 * v;
      field.push_back(value({p[0], p[1], p[2]}, c));
    }
  return field;
}

inline double linear(const Point &p, int c) { return 1 + c + 2 * p[0] - (c + 1) * p[1] + 0.5 * p[2]; }
inline double bent(const Point &p, int c) { return std::sin(5 * p[0] + c) * p[1] + p[2]; }

/// Decimation places vertices that are not in the cube; they take what is nearest.
inline Point nearest_inside(Point p) {
  for (double &x : p) x = std::min(std::max(x, 0.0), 1.0);
  return p;
}

struct Stencil {
  std::vector<std::int32_t> ids;
  std::vector<double> weights;
};

class Fields : public testing::Test {
 protected:
  Cube cube{5};
  CountingAllocator allocator;
  Context context = make_context(allocator.config());

  void SetUp() override {
    submit(context.get(), cube);
    tetlod_set_sigma(context.get(), 0.5);
    tetlod_set_rho(context.get(), 0.2);
  }

  std::size_t points() const { return cube.values.size(); }
  std::size_t tets() const { return cube.corners.size() / 4; }

  std::int64_t count(int which) const {
    std::int64_t counts[2] = {0, 0};
    EXPECT_EQ(tetlod_fetch_counts(context.get(), counts, counts + 1, nullptr), TETLOD_OK);
    return counts[which];
  }
  std::size_t points_out() const { return std::size_t(count(0)); }
  std::size_t tets_out() const { return std::size_t(count(1)); }

  void run() { ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get()); }

  tetlod_status carry(const char *name, const std::vector<double> &field, int components,
                      int association = TETLOD_POINT_FIELD) {
    const tetlod_array array =
        array_of(TETLOD_FLOAT64, field.size() / std::size_t(components), components, field.data());
    return tetlod_submit_field(context.get(), name, association, &array);
  }

  std::vector<double> fetch(const char *name, int components, std::size_t tuples) {
    std::vector<double> field(tuples * std::size_t(components), -99);
    tetlod_array array = array_of(TETLOD_FLOAT64, tuples, components, field.data());
    EXPECT_EQ(tetlod_fetch_field(context.get(), name, &array), TETLOD_OK) << message_of(context.get());
    return field;
  }

  template <class T>
  tetlod_status carry_integers(const char *name, std::int32_t type, const std::vector<T> &field, int components,
                               int association) {
    const tetlod_array array = array_of(type, field.size() / std::size_t(components), components, field.data());
    return tetlod_submit_field(context.get(), name, association, &array);
  }

  template <class T>
  std::vector<T> fetch_integers(const char *name, std::int32_t type, int components, std::size_t tuples) {
    std::vector<T> field(tuples * std::size_t(components), T(99));
    tetlod_array array = array_of(type, tuples, components, field.data());
    EXPECT_EQ(tetlod_fetch_field(context.get(), name, &array), TETLOD_OK) << message_of(context.get());
    return field;
  }

  std::vector<double> move(const std::vector<double> &field, int components) {
    std::vector<double> moved(points_out() * std::size_t(components), -99);
    const tetlod_array from = array_of(TETLOD_FLOAT64, points(), components, field.data());
    tetlod_array to = array_of(TETLOD_FLOAT64, points_out(), components, moved.data());
    EXPECT_EQ(tetlod_transfer(context.get(), &from, &to), TETLOD_OK) << message_of(context.get());
    return moved;
  }

  Stencil stencil(std::int32_t base = 0) {
    Stencil s;
    s.ids.resize(4 * points_out());
    s.weights.resize(4 * points_out());
    tetlod_array ids = array_of(TETLOD_INT32, points_out(), 4, s.ids.data());
    tetlod_array weights = array_of(TETLOD_FLOAT64, points_out(), 4, s.weights.data());
    EXPECT_EQ(tetlod_fetch_stencil(context.get(), base, &ids, &weights), TETLOD_OK) << message_of(context.get());
    return s;
  }

  std::vector<Point> result_points() const {
    std::vector<Point> xyz(points_out());
    tetlod_array array = array_of(TETLOD_FLOAT64, xyz.size(), 3, xyz.data());
    EXPECT_EQ(tetlod_fetch_points(context.get(), &array), TETLOD_OK);
    return xyz;
  }

  void expect_failure(tetlod_status got, tetlod_status wanted, const char *part) {
    EXPECT_EQ(got, wanted);
    EXPECT_NE(message_of(context.get()).find(part), std::string::npos) << message_of(context.get()) << "\n" << part;
  }
};

}  // namespace tetlod_test
