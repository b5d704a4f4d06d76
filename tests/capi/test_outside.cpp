// A bound holds for original vertices just outside of the result, too: at the nearest point of its boundary.
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

using Point = std::array<double, 3>;

Point minus(const Point &a, const Point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point &a, const Point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double det(const Point &a, const Point &b, const Point &c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

struct Nearest {
  double distance2 = std::numeric_limits<double>::infinity(), value = 0;
};

/// The nearest point of a triangle with values at its corners: of its plane, if that is inside, or of an edge; of
/// slivers, too, whose planes are what rounding makes of them.
Nearest nearest_in(const Point corners[3], const double values[3], const Point &p) {
  const Point u = minus(corners[1], corners[0]), v = minus(corners[2], corners[0]), x = minus(p, corners[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), xu = dot(x, u), xv = dot(x, v);
  const double area2 = uu * vv - uv * uv, b = (vv * xu - uv * xv) / area2, c = (uu * xv - uv * xu) / area2;
  Nearest nearest;
  const auto look_at = [&](double w0, double w1, double w2) {
    Point q;
    for (std::size_t k = 0; k < 3; k++)  // as seen from p: exact, where the corners are near
      q[k] = w0 * (corners[0][k] - p[k]) + w1 * (corners[1][k] - p[k]) + w2 * (corners[2][k] - p[k]);
    if (dot(q, q) < nearest.distance2) nearest = {dot(q, q), w0 * values[0] + w1 * values[1] + w2 * values[2]};
  };
  if (b >= 0 && c >= 0 && b + c <= 1) look_at(1 - b - c, b, c);
  for (std::size_t i = 0; i < 3; i++) {
    const std::size_t j = (i + 1) % 3;
    const Point e = minus(corners[j], corners[i]);
    const double t = std::min(1.0, std::max(0.0, dot(minus(p, corners[i]), e) / dot(e, e)));
    double w[3] = {0, 0, 0};
    w[i] = 1 - t;
    w[j] = t;
    look_at(w[0], w[1], w[2]);
  }
  return nearest;
}

/// The last result of a context.
struct LastResult {
  std::vector<Point> points;
  std::vector<double> values;
  std::vector<std::array<std::int32_t, 4>> tets;
  std::vector<std::array<std::int32_t, 3>> boundary;

  explicit LastResult(const tetlod_context *context) {
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_fetch_report(context, &report), TETLOD_OK);
    points.resize(std::size_t(report.points_out));
    values.resize(points.size());
    tets.resize(std::size_t(report.tets_out));
    boundary.resize(std::size_t(report.boundary_triangles_out));
    tetlod_array array = array_of(TETLOD_FLOAT64, points.size(), 3, points.data());
    EXPECT_EQ(tetlod_fetch_points(context, &array), TETLOD_OK);
    array = array_of(TETLOD_FLOAT64, values.size(), 1, values.data());
    EXPECT_EQ(tetlod_fetch_scalars(context, &array), TETLOD_OK);
    array = array_of(TETLOD_INT32, tets.size(), 4, tets.data());
    EXPECT_EQ(tetlod_fetch_tets(context, 0, &array), TETLOD_OK);
    array = array_of(TETLOD_INT32, boundary.size(), 3, boundary.data());
    EXPECT_EQ(tetlod_fetch_boundary(context, 0, &array), TETLOD_OK);
  }

  bool is_outside(const Point &p, double tolerance = 1e-6) const {
    return std::none_of(tets.begin(), tets.end(), [&](const auto &tet) {
      Point d[4];
      for (std::size_t k = 0; k < 4; k++) d[k] = minus(points[std::size_t(tet[k])], p);
      const double part[4] = {det(d[1], d[2], d[3]), -det(d[0], d[2], d[3]), det(d[0], d[1], d[3]),
                              -det(d[0], d[1], d[2])};
      const double whole = part[0] + part[1] + part[2] + part[3];
      return std::all_of(part, part + 4, [&](double of_corner) { return of_corner / whole >= -tolerance; });
    });
  }

  /// Of each triangle of the boundary.
  std::vector<Nearest> nearest_to(const Point &p) const {
    std::vector<Nearest> all;
    for (const auto &triangle : boundary) {
      Point corners[3];
      double at[3];
      for (std::size_t k = 0; k < 3; k++) {
        corners[k] = points[std::size_t(triangle[k])];
        at[k] = values[std::size_t(triangle[k])];
      }
      all.push_back(nearest_in(corners, at, p));
    }
    return all;
  }
  static bool is_nearer(const Nearest &a, const Nearest &b) { return a.distance2 < b.distance2; }

  double value_on_boundary(const Point &p) const {
    const std::vector<Nearest> all = nearest_to(p);
    return std::min_element(all.begin(), all.end(), is_nearer)->value;
  }

  /// From another value. At an edge several triangles are as near, as far as rounding goes, and a sliver's value there
  /// is what rounding makes of it: the least counts.
  double error_on_boundary(const Point &p, double value) const {
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::sqrt(dot(p, p));
    const std::vector<Nearest> all = nearest_to(p);
    const double distance = std::sqrt(std::min_element(all.begin(), all.end(), is_nearer)->distance2);
    double error = std::numeric_limits<double>::infinity();
    for (const Nearest &nearest : all)
      if (std::sqrt(nearest.distance2) <= distance + rounding) error = std::min(error, std::abs(nearest.value - value));
    return error;
  }
};

/// Graded, or a thin sheet askew, and somewhere else: a vertex inserted for a point outside may come to lie just
/// beneath the boundary.
void expect_bound_from_outside(int n, const std::function<Point(const Point &)> &moved) {
  constexpr double bound = 0.001;
  Cube cube(n);
  std::vector<Point> points(cube.values.size());
  for (std::size_t v = 0; v < points.size(); v++) {
    const Point p{cube.xyz[3 * v], cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]};
    cube.values[v] = std::tanh(6 * (p[0] - 0.5 + 0.3 * std::sin(6 * p[1]))) + 0.3 * std::cos(5 * p[2]);
    points[v] = moved(p);
    std::copy(points[v].begin(), points[v].end(), &cube.xyz[3 * v]);
  }
  const Context context = make_context();
  submit(context.get(), cube);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.02);
  tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  const LastResult result(context.get());
  const auto [low, high] = std::minmax_element(cube.values.begin(), cube.values.end());
  int outside = 0;
  for (std::size_t v = 0; v < points.size(); v++) {
    if (!result.is_outside(points[v])) continue;
    outside++;
    EXPECT_LE(result.error_on_boundary(points[v], cube.values[v]), bound * (*high - *low)) << v;
  }
  EXPECT_GT(outside, 0);
}

TEST(Outside, ABoundHoldsAtTheNearestPointOfTheBoundary) {
  expect_bound_from_outside(10, [](const Point &p) { return Point{1000 + p[0] * p[0], 1000 + p[1], 1000 + p[2]}; });
  for (int n : {7, 10})
    expect_bound_from_outside(n, [n](const Point &p) {
      const double x = n == 7 ? 0.02 * (p[0] * p[0] * p[0]) : 0.1 * p[0], y = 0.2 * p[1];
      const double u = 0.8 * x - 0.6 * y, v = 0.6 * x + 0.8 * y;
      return Point{1000 + u, 1000 + 0.8 * v - 0.6 * p[2], 1000 + 0.6 * v + 0.8 * p[2]};
    });
}

/// Behind a sliver of the wall is another field: a vertex a hair outside is out of the sliver by more than of the tet
/// behind it, where readers find it, measure_error() among them.
TEST(Outside, ABoundHoldsBehindSlivers) {
  constexpr double bound = 0.003;
  for (unsigned seed : {11u, 12u, 18u}) {
    Cube cube(10);
    std::mt19937 random(seed);
    for (double &x : cube.xyz) x = std::pow(x, 5) + 1e-5 * x;
    for (double &value : cube.values) value = double(random()) / double(random.max());
    const Context context = make_context();
    submit(context.get(), cube);
    tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, TETLOD_EFFORT_ACCURATE);
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    tetlod_error_report error{};
    error.struct_size = sizeof error;
    ASSERT_EQ(tetlod_measure_error(context.get(), 0, &error), TETLOD_OK) << message_of(context.get());
    EXPECT_LE(error.max, bound) << seed;
  }
}

/// A plate so thin and so far from the origin that coordinates are rounded by 1e-8 of its thickness: on which side of
/// the boundary a vertex lies is a matter of that, and behind the boundary there are slivers.
TEST(Outside, ABoundHoldsWhereRoundingSaysWhoIsOutside) {
  constexpr double bound = 0.01, thickness = 1e-3, offset = 1e5;
  std::uint64_t state = 88172645494436360;
  const auto random = [&] {  // Marsaglia's xorshift
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return double(std::uint32_t(state >> 16) % 1000003) / 1000003;
  };
  random();
  Cube cube(5);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    const bool inner = std::all_of(p, p + 3, [](double x) { return x > 0 && x < 1; });
    for (double *x = p; inner && x < p + 3; x++) *x += 0.08 * (random() - 0.5);
    cube.values[v] = std::sin(0.8 * double(v % 7)) * std::cos(0.4 * double(v % 11)) + double(v % 13) / 13;
    p[1] = offset + thickness * p[1];
  }
  const auto [low, high] = std::minmax_element(cube.values.begin(), cube.values.end());
  for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
    const Context context = make_context();
    submit(context.get(), cube);
    tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, effort);
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const LastResult result(context.get());
    int outside = 0;
    for (std::size_t v = 0; v < cube.values.size(); v++) {
      const Point p{cube.xyz[3 * v], cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]};
      if (!result.is_outside(p, 0)) continue;
      outside++;
      EXPECT_LE(std::abs(result.value_on_boundary(p) - cube.values[v]), bound * (*high - *low)) << v;
    }
    EXPECT_GT(outside, 0);
  }
}

/// The faces that a single tet has.
std::vector<std::array<Point, 3>> boundary_of(const Cube &cube) {
  std::map<std::array<std::int32_t, 3>, int> uses;
  for (std::size_t t = 0; t < cube.corners.size(); t += 4)
    for (std::size_t k = 0; k < 4; k++) {
      std::array<std::int32_t, 3> face;
      for (std::size_t i = 0; i < 3; i++) face[i] = cube.corners[t + (k + 1 + i) % 4];
      std::sort(face.begin(), face.end());
      uses[face]++;
    }
  std::vector<std::array<Point, 3>> boundary;
  for (const auto &[face, count] : uses) {
    if (count > 1) continue;
    boundary.emplace_back();
    for (std::size_t i = 0; i < 3; i++) std::copy_n(cube.xyz.data() + 3 * face[i], 3, boundary.back()[i].data());
  }
  return boundary;
}

double distance_to(const std::vector<std::array<Point, 3>> &triangles, const Point &p) {
  constexpr double none[3] = {0, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (const auto &corners : triangles) least = std::min(least, nearest_in(corners.data(), none, p).distance2);
  return std::sqrt(least);
}

/// A block with a rough skin. Where a vertex is inserted on it for the bound's sake, new middles have to keep near,
/// too.
TEST(Outside, DeviationIsBoundedAtTheMiddlesOfDividedTriangles) {
  constexpr double bound = 0.03, limit = 0.003;
  Cube cube(7);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    p[2] += 0.02 * std::sin(40 * p[0]) * std::cos(32 * p[1]);
    cube.values[v] = std::tanh(8 * (p[0] - 0.5 + 0.3 * std::sin(6 * p[1]))) + 0.3 * std::cos(5 * p[2]);
  }
  const auto original = boundary_of(cube);
  Point low = original[0][0], high = low;
  for (const auto &corners : original)
    for (const Point &p : corners)
      for (std::size_t k = 0; k < 3; k++) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double diagonal = std::sqrt(dot(minus(high, low), minus(high, low)));
  for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
    const Context context = make_context();
    submit(context.get(), cube);
    tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, effort);
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
    tetlod_set_real(context.get(), TETLOD_OPT_MAX_DEVIATION, limit);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const LastResult result(context.get());
    EXPECT_LT(result.boundary.size(), original.size());
    double largest = 0;
    for (const auto &triangle : result.boundary) {
      const Point &a = result.points[std::size_t(triangle[0])], &b = result.points[std::size_t(triangle[1])],
                  &c = result.points[std::size_t(triangle[2])];
      Point middle, side[3];
      for (std::size_t k = 0; k < 3; k++) {
        middle[k] = (a[k] + b[k] + c[k]) / 3;
        side[0][k] = 0.5 * (a[k] + b[k]), side[1][k] = 0.5 * (b[k] + c[k]), side[2][k] = 0.5 * (c[k] + a[k]);
      }
      for (const Point &p : {a, middle, side[0], side[1], side[2]})
        largest = std::max(largest, distance_to(original, p));
    }
    EXPECT_LE(largest, limit * diagonal * (1 + 1e-9)) << effort;
  }
}

/// Elements that pad an array, or hang on the solid without a volume, name a node far away, with a value that nobody
/// meant.
TEST(Outside, ABoundIsOfWhatRepairsLeave) {
  for (const int kind : {0, 1, 2, 3}) {
    const bool later = kind % 2 == 1, flat = kind / 2 == 1;
    Cube cube(6);
    for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = std::sin(5 * cube.xyz[3 * v]);
    const auto run = [&](tetlod_context *context) {
      submit(context, cube);
      tetlod_set_real(context, TETLOD_OPT_MAX_ERROR, 0.01);
      EXPECT_EQ(tetlod_run(context), TETLOD_OK) << message_of(context);
      tetlod_run_report report{};
      report.struct_size = sizeof report;
      EXPECT_EQ(tetlod_fetch_report(context, &report), TETLOD_OK);
      return report;
    };
    const Context sound = make_context(), padded = make_context();
    const auto rms_of = [](tetlod_context *context) {
      tetlod_error_report error{};
      error.struct_size = sizeof error;
      EXPECT_EQ(tetlod_measure_error(context, 1, &error), TETLOD_OK) << message_of(context);
      return error.rms;
    };
    const tetlod_run_report expected = run(sound.get());
    const double rms = rms_of(sound.get());
    const auto padding = std::int32_t(cube.values.size());
    cube.xyz.insert(cube.xyz.end(), {1000, 1000, flat ? 0.0 : 1000.0});
    cube.values.push_back(1e6);
    if (flat)
      cube.corners.insert(cube.corners.begin() + 40, {0, 1, 8, padding});
    else
      cube.corners.insert(cube.corners.end(), 4, padding);
    if (later) {  // other values before, so that the mesh is reused
      Cube other = cube;
      for (double &value : other.values) value *= 2;
      std::swap(other.values, cube.values);
      run(padded.get());
      std::swap(other.values, cube.values);
    }
    const tetlod_run_report report = run(padded.get());
    EXPECT_EQ(report.hash, expected.hash);
    EXPECT_EQ(report.scalar_max, expected.scalar_max);
    EXPECT_EQ(report.dropped_tets, 1);
    EXPECT_EQ(report.reused_tets > 0, later);
    EXPECT_EQ(rms_of(padded.get()), rms);
  }
}

/// A slit inside, open by less than what a weight is rounded by, with another value on its upper side.
TEST(Outside, ABoundThatCannotBeHeldNamesAVertex) {
  Cube cube(6);
  std::map<std::int32_t, std::int32_t> twins;
  for (std::int32_t v = 0; v < 7 * 7 * 7; v++) {
    const double *const p = &cube.xyz[3 * std::size_t(v)];
    if (p[2] != 0.5 || std::abs(p[0] - 0.5) > 0.2 || std::abs(p[1] - 0.5) > 0.2) continue;
    twins[v] = std::int32_t(cube.values.size());
    const double x = p[0], y = p[1];
    cube.xyz.insert(cube.xyz.end(), {x, y, 0.5 + 1e-9});
    cube.values.push_back(cube.values[std::size_t(v)] + 20);
  }
  ASSERT_EQ(twins.size(), 9u);
  for (std::size_t t = 0; t < cube.corners.size(); t += 4) {
    double above = 0;
    for (std::size_t k = 0; k < 4; k++) above += cube.xyz[3 * std::size_t(cube.corners[t + k]) + 2] - 0.5;
    for (std::size_t k = 0; k < 4 && above > 0; k++)
      if (const auto twin = twins.find(cube.corners[t + k]); twin != twins.end()) cube.corners[t + k] = twin->second;
  }
  const Context context = make_context();
  submit(context.get(), cube);
  tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, 0.05);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MAX_ERROR);
  const std::string message = message_of(context.get());
  EXPECT_NE(message.find("at vertex "), std::string::npos) << message;
  EXPECT_EQ(message.find("largest error"), std::string::npos) << message << ": it is within the bound";
}

}  // namespace
}  // namespace tetlod_test
