// Vertices that have to survive.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

using Point = std::array<double, 3>;
using Corners = std::array<Point, 3>;

class Flags : public testing::Test {
 protected:
  Cube cube{6};
  Context context = make_context();
  std::vector<std::uint8_t> flags;

  void SetUp() override {
    submit(context.get(), cube);
    tetlod_set_sigma(context.get(), 0.05);
    tetlod_set_rho(context.get(), 1);
  }

  Point point(std::size_t v) const { return {cube.xyz[3 * v], cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]}; }

  void flag(std::uint8_t bits, const std::function<bool(const Point &)> &which) {
    flags.assign(cube.values.size(), 0);
    for (std::size_t v = 0; v < flags.size(); v++)
      if (which(point(v))) flags[v] = bits;
    const tetlod_array array = array_of(TETLOD_UINT8, flags.size(), 1, flags.data());
    ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK) << message_of(context.get());
  }

  void run() { ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get()); }

  std::vector<Point> points() const {
    tetlod_array view{};
    view.struct_size = sizeof view;
    EXPECT_EQ(tetlod_view_points(context.get(), &view), TETLOD_OK);
    const auto *const first = static_cast<const Point *>(view.data);
    return std::vector<Point>(first, first + view.tuples);
  }

  /// The result's value at a point; -99: it is none of its vertices.
  double value_at(const Point &p) const {
    const std::vector<Point> all = points();
    tetlod_array view{};
    view.struct_size = sizeof view;
    EXPECT_EQ(tetlod_view_scalars(context.get(), &view), TETLOD_OK);
    const auto found = std::find(all.begin(), all.end(), p);
    return found == all.end() ? -99 : static_cast<const double *>(view.data)[found - all.begin()];
  }

  void expect_all_flagged_there() const {
    int count = 0;
    for (std::size_t v = 0; v < flags.size(); v++)
      if (flags[v]) {
        EXPECT_EQ(value_at(point(v)), cube.values[v]) << v;
        count++;
      }
    EXPECT_GT(count, 0);
  }

  /// The boundary's triangles whose corners all lie at x = 1, each from its least corner on.
  std::set<Corners> triangles_at_one() const {
    std::int64_t count = 0;
    EXPECT_EQ(tetlod_fetch_counts(context.get(), nullptr, nullptr, &count), TETLOD_OK);
    std::vector<std::array<std::int32_t, 3>> triangles(static_cast<std::size_t>(count));
    tetlod_array array = array_of(TETLOD_INT32, triangles.size(), 3, triangles.data());
    EXPECT_EQ(tetlod_fetch_boundary(context.get(), 0, &array), TETLOD_OK);
    const std::vector<Point> at = points();
    std::set<Corners> found;
    for (const auto &t : triangles) {
      Corners corners = {at[std::size_t(t[0])], at[std::size_t(t[1])], at[std::size_t(t[2])]};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      if (corners[0][0] == 1 && corners[1][0] == 1 && corners[2][0] == 1) found.insert(corners);
    }
    return found;
  }
};

/// An interface of two partitions: this side keeps each of its triangles while the rest is decimated.
TEST_F(Flags, ALockedInterfaceStays) {
  tetlod_set_sigma(context.get(), 1);
  run();
  const std::set<Corners> original = triangles_at_one();
  EXPECT_EQ(original.size(), 72u);
  tetlod_set_sigma(context.get(), 0.05);
  run();
  EXPECT_LT(triangles_at_one().size(), 72u) << "without flags it does not stay";
  flag(TETLOD_FLAG_LOCK, [](const Point &p) { return p[0] == 1; });
  run();
  EXPECT_EQ(triangles_at_one(), original);
  expect_all_flagged_there();
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
  EXPECT_LT(report.boundary_edges_out, report.boundary_edges_in / 2) << "the rest is decimated";
}

TEST_F(Flags, KeptVerticesAreThereInsideAndOnTheBoundary) {
  const Point inside = point(7 * 7 * 3 + 7 * 3 + 3), corner = {1, 1, 1}, side = {0, cube.xyz[4 * 3 * 7 + 1], 0.5};
  tetlod_set_min_distance(context.get(), 0.4);  // so that nothing inside is far enough
  run();
  EXPECT_EQ(value_at(inside), -99);
  flag(TETLOD_FLAG_KEEP, [&](const Point &p) {
    return p == inside || p == corner || p == side || (p[0] > 0.8 && p[0] < 0.9 && p[1] > 0.6 && p[1] < 0.9);
  });
  run();
  expect_all_flagged_there();
}

/// Sizes and bounds are met by collapses, refined, and remeshed.
TEST_F(Flags, KeptVerticesAreThereWhateverIsAskedFor) {
  flag(TETLOD_FLAG_KEEP, [](const Point &p) { return std::abs(p[0] - p[1]) < 0.1 && p[2] > 0.4 && p[2] < 0.9; });
  for (std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE})
    for (const auto &[option, value] : std::map<std::int32_t, double>{{TETLOD_OPT_TARGET_RATIO, 0.2},
                                                                      {TETLOD_OPT_MAX_ERROR, 0.1},
                                                                      {TETLOD_OPT_MAX_DEVIATION, 0.05},
                                                                      {TETLOD_OPT_CLEAN_EDGES, 1e-3}})
      for (int remesh : {0, 1}) {
        tetlod_set_preset(context.get(), preset);
        tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.2);
        tetlod_set_real(context.get(), option, value);
        tetlod_set_int(context.get(), TETLOD_OPT_REMESH, remesh);
        SCOPED_TRACE(testing::Message() << preset << ", option " << option << ", remesh " << remesh);
        run();
        expect_all_flagged_there();
        EXPECT_LT(points().size(), cube.values.size());
      }
}

double from_middle(const Point &p) { return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5); }

/// A ball whose boundary is decimated loses what is just beneath it.
TEST_F(Flags, KeptVerticesAreThereWhereTheBoundaryWouldCutThemOff) {
  cube = Cube(10);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    const Point p = point(v);
    const double on_cube = std::max({std::abs(p[0] - 0.5), std::abs(p[1] - 0.5), std::abs(p[2] - 0.5)});
    const double scale = on_cube > 0 ? std::cbrt(on_cube / 4) / from_middle(p) : 1;
    for (std::size_t k = 0; k < 3; k++) cube.xyz[3 * v + k] = 0.5 + scale * (p[k] - 0.5);
  }
  submit(context.get(), cube);
  tetlod_set_sigma(context.get(), 0.02);
  flag(TETLOD_FLAG_KEEP, [&](const Point &p) { return from_middle(p) > 0.46 && from_middle(p) < 0.49; });
  run();
  expect_all_flagged_there();
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
  EXPECT_LT(report.boundary_edges_out, report.boundary_edges_in) << "it is decimated, still";
}

TEST_F(Flags, CleaningLeavesThem) {
  flag(TETLOD_FLAG_LOCK, [](const Point &p) { return p[0] == 1; });
  tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 0.1);
  run();
  EXPECT_EQ(triangles_at_one().size(), 72u);
}

/// The flag of a point that is merged into another is the other's.
TEST_F(Flags, MergedPointsHandThemOn) {
  const std::size_t kept = 7 * 7 * 3 + 7 * 3 + 3;
  cube.xyz.insert(cube.xyz.end(), cube.xyz.begin() + std::ptrdiff_t(3 * kept),
                  cube.xyz.begin() + std::ptrdiff_t(3 * kept + 3));
  cube.values.push_back(cube.values[kept]);
  *std::find(cube.corners.begin(), cube.corners.end(), std::int32_t(kept)) = std::int32_t(cube.values.size() - 1);
  submit(context.get(), cube);
  tetlod_set_min_distance(context.get(), 0.4);
  flag(0, [](const Point &) { return false; });
  run();
  EXPECT_EQ(value_at(point(kept)), -99);
  flags.back() = TETLOD_FLAG_KEEP;
  run();
  expect_all_flagged_there();
}

/// Of copies of a vertex that become one, any may have the flag.
TEST_F(Flags, OfTheFirstCopyCountToo) {
  const std::size_t kept = 171;  // inside
  for (std::size_t k = 0; k < 3; k++) cube.xyz.push_back(cube.xyz[3 * kept + k]);
  cube.values.push_back(cube.values[kept]);
  *std::find(cube.corners.begin(), cube.corners.end(), std::int32_t(kept)) = std::int32_t(cube.values.size() - 1);
  submit(context.get(), cube);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.05);
  flag(0, [](const Point &) { return false; });
  flags[kept] = TETLOD_FLAG_KEEP;
  run();
  expect_all_flagged_there();
}

/// On a surface that bends, where the boundary is taken back to where it was farthest off.
TEST_F(Flags, HoldWhileTheDeviationIsLowered) {
  cube = Cube(8);
  make_ball(cube);
  for (std::size_t v = 0; v < cube.values.size(); v++)
    cube.values[v] = std::tanh(6 * (cube.xyz[3 * v] - 0.3 * cube.xyz[3 * v + 1]));
  submit(context.get(), cube);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.3);
  int number = 0;
  flag(TETLOD_FLAG_KEEP, [&](const Point &) { return number++ % 5 == 0; });
  run();
  expect_all_flagged_there();
}

/// No flag set is no flags submitted.
TEST_F(Flags, ZerosChangeNothing) {
  run();
  const auto bare = bytes_of(context.get());
  flag(0, [](const Point &) { return true; });
  run();
  EXPECT_EQ(bytes_of(context.get()), bare);
}

/// Nothing is inserted into triangles of a boundary that is locked, however large the error there is.
TEST_F(Flags, ALockedBoundaryGetsNoVertices) {
  cube = Cube(8);
  std::mt19937 random(8);
  for (double &x : cube.xyz) {
    const double s = 2 * x - 1, rest = 1 - std::abs(s);
    x = 0.5 + (s < 0 ? -0.5 : 0.5) * (1 - rest * rest * rest);
  }
  for (double &value : cube.values) value = double(random() % 1000);
  submit(context.get(), cube);
  flag(TETLOD_FLAG_LOCK,
       [](const Point &p) { return std::any_of(p.begin(), p.end(), [](double x) { return x == 0 || x == 1; }); });
  tetlod_set_preset(context.get(), TETLOD_PRESET_ACCURATE);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.4);
  run();
  const tetlod_run_report report = report_of(context.get());
  EXPECT_EQ(report.boundary_triangles_out, report.boundary_triangles_in);
}

/// Samples may be lost near the boundary; then all was remeshed again, with a finer one, and up to 14 times the error.
TEST_F(Flags, LargeMeshesKeepVerticesByCollapsesAlone) {
  cube = Cube(26);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    const double *const p = &cube.xyz[3 * v];
    cube.values[v] = std::sin(5 * p[0]) * std::cos(4 * p[1]) * std::sin(5 * p[2]);
  }
  submit(context.get(), cube);
  tetlod_set_preset(context.get(), TETLOD_PRESET_FAST);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.02);
  run();
  EXPECT_GT(report_of(context.get()).remesh_attempts, 0) << "without flags";
  flag(TETLOD_FLAG_KEEP, [](const Point &p) { return p == Point{0.5, 0.5, 0.5}; });
  run();
  EXPECT_EQ(report_of(context.get()).remesh_attempts, 0);
  flag(0, [](const Point &) { return true; });
  run();
  EXPECT_GT(report_of(context.get()).remesh_attempts, 0) << "with flags that say nothing";
}

TEST_F(Flags, WhatIsRefused) {
  const auto expect_failure = [&](tetlod_status got, const char *part) {
    EXPECT_EQ(got, TETLOD_ERR_ARGUMENT);
    EXPECT_NE(message_of(context.get()).find(part), std::string::npos) << message_of(context.get());
  };
  tetlod_array array = array_of(TETLOD_INT32, 1, 1, cube.corners.data());
  expect_failure(tetlod_submit_point_flags(context.get(), &array), "flags: type 1 is not TETLOD_UINT8 (5)");
  array = array_of(TETLOD_UINT8, 1, 2, cube.corners.data());
  expect_failure(tetlod_submit_point_flags(context.get(), &array), "flags: 2 components, 1 are needed");
  flag(1, [](const Point &) { return true; });
  array = array_of(TETLOD_UINT8, flags.size() - 1, 1, flags.data());
  ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK);
  expect_failure(tetlod_run(context.get()), "342 flags for 343 points");
  flag(1, [](const Point &) { return true; });
  flags[17] = 4;
  expect_failure(tetlod_run(context.get()), "the flags of vertex 17 are 4");
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  submit(context.get(), cube);
  run();
}

/// Where collapses leave too many tets it is remeshed; where that leaves more, the collapsed mesh is the result.
TEST_F(Flags, NothingIsToldOfARemeshingThatWasThrownAway) {
  cube = Cube(3);
  for (std::size_t i = 0; i < cube.xyz.size(); i++) cube.xyz[i] += 0.02 * std::sin(7 * double(i));
  submit(context.get(), cube);
  int number = 0;
  flag(TETLOD_FLAG_KEEP, [&](const Point &) { return number++ % 2 == 0; });
  long collapsed = std::numeric_limits<long>::max();  // the best of two ways
  const auto listen = [](void *user, std::int32_t, const char *message) {
    const char *const at = std::strstr(message, "left to collapse at ");
    long &least = *static_cast<long *>(user);
    if (at) least = std::min(least, std::atol(at + std::strlen("left to collapse at ")));
  };
  ASSERT_EQ(tetlod_set_log(context.get(), listen, &collapsed, 0), TETLOD_OK);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.05);
  tetlod_set_int(context.get(), TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
  run();
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
  ASSERT_EQ(report.tets_out, collapsed);
  EXPECT_EQ(report.remesh_attempts, 0);
  EXPECT_EQ(report.boundary_retries, 0);
  EXPECT_EQ(report.worker_peak_bytes, 0U);
}

}  // namespace
}  // namespace tetlod_test
