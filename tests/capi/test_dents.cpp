// Small solids in the dents of a large one, which decimation would flatten over them.
#include <cmath>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

constexpr int cells = 12;

/// Of cells^3, with a dent, of that part of its height, at every second vertex of its top, and a cube of this edge in
/// each dent, a tenth of the depth above its floor.
Cube dented(double depth, double edge) {
  Cube cube(cells);
  const Cube small(1);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    if (std::lround(cells * p[0]) % 2 && std::lround(cells * p[1]) % 2) p[2] *= 1 - depth;
    cube.values[v] = p[0];
  }
  for (int i = 1; i < cells; i += 2)
    for (int j = 1; j < cells; j += 2) {
      const double at[3] = {double(i) / cells - edge / 2, double(j) / cells - edge / 2, 1 - 0.9 * depth};
      const auto first = std::int32_t(cube.values.size());
      for (std::size_t k = 0; k < small.xyz.size(); k++) cube.xyz.push_back(at[k % 3] + edge * small.xyz[k]);
      for (std::size_t v = 0; v < small.values.size(); v++)
        cube.values.push_back(cube.xyz[3 * (std::size_t(first) + v)]);
      for (std::int32_t v : small.corners) cube.corners.push_back(first + v);
    }
  return cube;
}

/// The result, and which of its tets belong to the same solid.
struct Solids {
  std::vector<double> xyz;
  std::vector<std::int32_t> corners, solid_of;  // solid_of: of each point, the lowest one that it hangs together with

  explicit Solids(const tetlod_context *context) {
    std::int64_t points = 0, tets = 0;
    EXPECT_EQ(tetlod_fetch_counts(context, &points, &tets, nullptr), TETLOD_OK);
    xyz.resize(3 * std::size_t(points));
    corners.resize(4 * std::size_t(tets));
    tetlod_array array = array_of(TETLOD_FLOAT64, std::size_t(points), 3, xyz.data());
    EXPECT_EQ(tetlod_fetch_points(context, &array), TETLOD_OK);
    array = array_of(TETLOD_INT32, std::size_t(tets), 4, corners.data());
    EXPECT_EQ(tetlod_fetch_tets(context, 0, &array), TETLOD_OK);
    for (std::int32_t v = 0; v < points; v++) solid_of.push_back(v);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t t = 0; t < corners.size(); t += 4) {
        std::int32_t lowest = solid(corners[t]);
        for (std::size_t k = 1; k < 4; k++) lowest = std::min(lowest, solid(corners[t + k]));
        for (std::size_t k = 0; k < 4; k++) {
          changed |= solid(corners[t + k]) != lowest;
          solid(corners[t + k]) = lowest;
        }
      }
    }
  }

  std::int32_t &solid(std::int32_t v) { return solid_of[std::size_t(v)]; }

  const double *point(std::int32_t v) const { return &xyz[3 * std::size_t(v)]; }
  double volume(const double *a, const double *b, const double *c, const double *d) const {
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
  }
  bool is_in(const double *p, std::size_t t) const {
    const double *const a = point(corners[t]), *const b = point(corners[t + 1]), *const c = point(corners[t + 2]),
                        *const d = point(corners[t + 3]);
    return volume(p, b, c, d) > 0 && volume(a, p, c, d) > 0 && volume(a, b, p, d) > 0 && volume(a, b, c, p) > 0;
  }

  /// Points that lie in a tet of a solid that is not theirs.
  int intruders() {
    int count = 0;
    for (std::int32_t v = 0; v < std::int32_t(solid_of.size()); v++)
      for (std::size_t t = 0; t < corners.size(); t += 4)
        if (solid(corners[t]) != solid(v) && is_in(point(v), t)) count++;
    return count;
  }
};

/// Without the small cubes; in each dent a tet hangs on an edge of the rim.
Cube dented_with_hanging_tets(double depth) {
  Cube cube = dented(depth, 0.002);
  const Cube plain(cells);
  cube.xyz.resize(plain.xyz.size());
  cube.values.resize(plain.values.size());
  cube.corners.resize(plain.corners.size());
  const auto on_top = [](int i, int j) { return std::int32_t((cells * (cells + 1) + j) * (cells + 1) + i); };
  for (int i = 1; i < cells; i += 2)
    for (int j = 1; j < cells; j += 2) {
      const std::int32_t a = on_top(i + 1, j), b = on_top(i + 1, j + 1), floor = on_top(i, j);
      const auto first = std::int32_t(cube.values.size());
      for (double height : {0.3, 0.7}) {
        for (std::size_t k = 0; k < 3; k++) {
          const auto at = [&](std::int32_t v) { return cube.xyz[3 * std::size_t(v) + k]; };
          cube.xyz.push_back(0.85 * (at(a) + at(b)) / 2 + 0.15 * (at(floor) + (k == 2 ? height * depth : 0)));
        }
        cube.values.push_back(cube.xyz[cube.xyz.size() - 3]);
      }
      cube.corners.insert(cube.corners.end(), {a, b, first, first + 1});
    }
  return cube;
}

/// The last result, by itself, has no defect, and so many components.
void expect_no_defect(const tetlod_context *context, std::int64_t components) {
  const Solids result(context);
  const Context judge = make_context();
  const tetlod_array xyz = array_of(TETLOD_FLOAT64, result.solid_of.size(), 3, result.xyz.data());
  const tetlod_array tets = array_of(TETLOD_INT32, result.corners.size() / 4, 4, result.corners.data());
  ASSERT_EQ(tetlod_submit_points(judge.get(), &xyz), TETLOD_OK);
  ASSERT_EQ(tetlod_submit_tets(judge.get(), &tets, 0), TETLOD_OK);
  tetlod_mesh_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(tetlod_check(judge.get(), &report), TETLOD_OK);
  EXPECT_EQ(report.status, TETLOD_OK) << message_of(judge.get());
  EXPECT_EQ(report.components, components);
}

constexpr std::int64_t dents = cells / 2 * (cells / 2);

void expect_sound(double depth, double edge, double ratio) {
  const Cube cube = dented(depth, edge);
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(Solids(context.get()).intruders(), 0);
  expect_no_defect(context.get(), 1 + dents);
}

TEST(Dents, TheBoundaryDoesNotCrossWhatIsInThem) { expect_sound(0.03, 0.002, 0.04); }

TEST(Dents, WhatIsInThemStaysOutside) {
  for (double ratio : {0.05, 0.04, 0.03}) expect_sound(0.015, 0.0001, ratio);
}

/// Which TetGen would not: it knew a way with a tetrahedron for the large cube alone, 0.59 of the diagonal off.
TEST(Dents, CollapsesGoAroundWhatIsInThem) {
  const Cube cube = dented(0.01, 0.002);
  for (double ratio : {0.04, 0.035}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const tetlod_run_report report = report_of(context.get());
    EXPECT_EQ(report.remesh_attempts, 0);
    EXPECT_LE(double(report.tets_out), 1.03 * ratio * double(report.tets_in));
    EXPECT_LE(report.max_deviation, 0.01);
  }
}

/// The tetrahedron is not taken either where collapses come to the size, as they fold the boundary more, or as planes
/// weigh otherwise.
TEST(Dents, CollapsesAreTakenWhereRemeshingLeadsFarOff) {
  const Cube cube = dented(0.01, 0.002);
  for (double ratio : {0.03, 0.028, 0.027, 0.026}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const tetlod_run_report report = report_of(context.get());
    EXPECT_LE(double(report.tets_out), 1.03 * ratio * double(report.tets_in));
    EXPECT_LE(report.max_deviation, 0.25) << ratio;
    EXPECT_EQ(Solids(context.get()).intruders(), 0);
    // Collapses clean no edges.
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 1e-15), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_GT(report_of(context.get()).remesh_attempts, 0) << ratio;
  }
}

/// Over which the boundary was decimated, so that TetGen refused it.
TEST(Dents, TheDecimatedBoundaryGoesAroundWhatIsInThem) {
  const Cube cube = dented(0.01, 0.002);
  for (double sigma : {0.3, 0.05}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_sigma(context.get(), sigma), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_EQ(report_of(context.get()).boundary_retries, 0);
    EXPECT_EQ(Solids(context.get()).intruders(), 0);
  }
}

/// Which shares vertices with what is decimated over it.
TEST(Dents, WhatHangsOnTheirRimStaysOutside) {
  const Cube cube = dented_with_hanging_tets(0.003);
  for (double ratio : {0.0, 0.1, 0.03}) {  // 0: the paper's method
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << ratio << ": " << message_of(context.get());
    expect_no_defect(context.get(), 1 + dents);
  }
}

}  // namespace
}  // namespace tetlod_test
