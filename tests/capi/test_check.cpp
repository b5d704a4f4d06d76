// Defects are counted and named; a policy decides whether they are repaired or refused.
#include <cmath>
#include <functional>
#include <limits>

#include "fixtures.hpp"

namespace {

using namespace tetlod_test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

tetlod_mesh_report check(tetlod_context *context) {
  tetlod_mesh_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(tetlod_check(context, &report), TETLOD_OK) << message_of(context);
  return report;
}

/// A defect that a test makes in a sound cube.
struct Case {
  const char *name;
  std::function<void(Cube &)> spoil;
  tetlod_defect tetlod_mesh_report::*defect;
  std::int64_t count, first;
  std::int32_t option;    ///< its policy, 0: none
  tetlod_status refused;  ///< with the error policy, or always when there is none
};

void add_tet(Cube &cube, std::initializer_list<std::int32_t> corners) {
  cube.corners.insert(cube.corners.end(), corners);
}

std::int32_t add_point(Cube &cube, double x, double y, double z) {
  cube.xyz.insert(cube.xyz.end(), {x, y, z});
  cube.values.push_back(1);
  return std::int32_t(cube.values.size() - 1);
}

/// A cube of 3 x 3 x 3 cells: 64 points, 162 tets.
const Case cases[] = {
    {"index", [](Cube &c) { c.corners[4 * 17 + 2] = 64; }, &tetlod_mesh_report::index, 1, 17, 0, TETLOD_ERR_MESH_INDEX},
    {"negative index", [](Cube &c) { c.corners[4 * 3] = -1; }, &tetlod_mesh_report::index, 1, 3, 0,
     TETLOD_ERR_MESH_INDEX},
    {"repeated",
     [](Cube &c) {
       add_tet(c, {0, 1, 1, 2});
     },
     &tetlod_mesh_report::repeated, 1, 162, TETLOD_OPT_ON_REPEATED, TETLOD_ERR_MESH_DEGENERATE},
    {"coordinate", [](Cube &c) { c.xyz[3 * 21 + 1] = nan; }, &tetlod_mesh_report::nonfinite_points, 1, 21, 0,
     TETLOD_ERR_MESH_NONFINITE},
    {"value", [](Cube &c) { c.values[63] = nan; }, &tetlod_mesh_report::nonfinite_values, 1, 63,
     TETLOD_OPT_ON_NONFINITE, TETLOD_ERR_MESH_NONFINITE},
    {"coincident",
     [](Cube &c) {
       const std::int32_t twin = add_point(c, c.xyz[0], c.xyz[1], c.xyz[2]);
       *std::find(c.corners.begin(), c.corners.end(), 0) = twin;
     },
     &tetlod_mesh_report::coincident, 1, 64, TETLOD_OPT_ON_COINCIDENT, TETLOD_ERR_MESH_DEGENERATE},
    {"flat",
     [](Cube &c) {
       add_tet(c, {0, 1, 2, add_point(c, 0.5, 0, 0)});
     },
     &tetlod_mesh_report::flat, 1, 162, TETLOD_OPT_ON_FLAT, TETLOD_ERR_MESH_DEGENERATE},
    {"duplicate",
     [](Cube &c) {
       add_tet(c, {c.corners[4], c.corners[6], c.corners[5], c.corners[7]});
     },
     &tetlod_mesh_report::duplicate, 1, 162, TETLOD_OPT_ON_DUPLICATE, TETLOD_ERR_MESH_INTERSECTING},
    {"unused", [](Cube &c) { add_point(c, 9, 9, 9); }, &tetlod_mesh_report::unused, 1, 64, TETLOD_OPT_ON_UNUSED,
     TETLOD_ERR_MESH_DEGENERATE},
};

void PrintTo(const Case &c, std::ostream *to) { *to << c.name; }

std::vector<Case> repairable() {
  std::vector<Case> chosen;
  std::copy_if(std::begin(cases), std::end(cases), std::back_inserter(chosen),
               [](const Case &c) { return c.option != 0; });
  return chosen;
}

std::string name_of(const testing::TestParamInfo<Case> &info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

class RepairableDefects : public testing::TestWithParam<Case> {};

class Defects : public testing::TestWithParam<Case> {};

TEST_P(Defects, AreCountedWithTheFirstCulprit) {
  Cube cube(3);
  Context context = make_context();
  submit(context.get(), cube);
  const auto &defect = GetParam().defect;
  EXPECT_EQ((check(context.get()).*defect).count, 0);
  EXPECT_EQ((check(context.get()).*defect).first, -1);
  GetParam().spoil(cube);
  submit(context.get(), cube);
  const tetlod_mesh_report report = check(context.get());
  EXPECT_EQ((report.*defect).count, GetParam().count);
  EXPECT_EQ((report.*defect).first, GetParam().first);
}

TEST_P(Defects, AreRefusedByPolicyAndNamed) {
  Cube cube(3);
  GetParam().spoil(cube);
  const Context context = make_context();
  submit(context.get(), cube);
  if (GetParam().option) {
    ASSERT_EQ(tetlod_set_int(context.get(), GetParam().option, TETLOD_POLICY_ERROR), TETLOD_OK);
  }
  EXPECT_EQ(check(context.get()).status, GetParam().refused);
  EXPECT_EQ(tetlod_run(context.get()), GetParam().refused);
  EXPECT_NE(message_of(context.get()).find(std::to_string(GetParam().first)), std::string::npos)
      << message_of(context.get());
}

TEST_P(RepairableDefects, AreRepairedByPolicy) {
  Cube cube(3);
  GetParam().spoil(cube);
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_int(context.get(), GetParam().option, TETLOD_POLICY_REPAIR), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(check(context.get()).status, TETLOD_OK);
  // All but the value cost no more than the tet or the point that was added: the cube is whole.
  const bool whole = GetParam().option != TETLOD_OPT_ON_NONFINITE;
  if (whole) {
    EXPECT_EQ(report_of(context.get()).boundary_triangles_in, 12 * 9);
  }
}

INSTANTIATE_TEST_SUITE_P(OfACube, Defects, testing::ValuesIn(cases), name_of);
INSTANTIATE_TEST_SUITE_P(OfACube, RepairableDefects, testing::ValuesIn(repairable()), name_of);

std::int64_t count_negative(const Cube &cube) {
  std::int64_t count = 0;
  for (std::size_t t = 0; t < cube.corners.size(); t += 4) {
    const auto edge = [&](std::size_t corner, std::size_t k) {
      return cube.xyz[3 * std::size_t(cube.corners[t + corner]) + k] - cube.xyz[3 * std::size_t(cube.corners[t]) + k];
    };
    double det = 0;
    for (std::size_t k = 0; k < 3; k++)
      det += edge(1, k) * (edge(2, (k + 1) % 3) * edge(3, (k + 2) % 3) - edge(2, (k + 2) % 3) * edge(3, (k + 1) % 3));
    count += det < 0;
  }
  return count;
}

TEST(Check, CountsInvertedTetsAndRunsTheSame) {
  Cube cube(3);
  const std::vector<unsigned char> expected = undisturbed(cube);
  const std::int64_t before = count_negative(cube);
  EXPECT_GT(before, 0);
  for (std::size_t t = 0; t < cube.corners.size(); t += 8) std::swap(cube.corners[t], cube.corners[t + 1]);
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_NE(count_negative(cube), before);
  EXPECT_EQ(check(context.get()).inverted.count, count_negative(cube));
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(bytes_of(context.get()), expected);
}

TEST(Check, CountsOverlappingNeighbours) {
  Cube cube(3);
  // Drag the innermost corner of a cell through its neighbours.
  const std::size_t inner = (1 * 4 + 1) * 4 + 1;
  for (int k = 0; k < 3; k++) cube.xyz[3 * inner + std::size_t(k)] = 0.9;
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_GT(check(context.get()).overlapping.count, 0);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_OVERLAP, TETLOD_POLICY_ERROR), TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MESH_INTERSECTING);
}

TEST(Check, CountsFacesWithThreeTets) {
  Cube cube(2);
  const std::int32_t apex = add_point(cube, 0.4, 0.45, 0.5);
  add_tet(cube, {cube.corners[0], cube.corners[1], cube.corners[3], apex});  // an inner face of the first cell
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_GE(check(context.get()).nonmanifold_faces.count, 1);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MESH_NONMANIFOLD);
}

/// Some cells of a cube of 2 x 2 x 2.
tetlod_mesh_report check_cells(std::initializer_list<std::size_t> cells) {
  Cube cube(2);
  std::vector<std::int32_t> kept;
  for (std::size_t cell : cells) kept.insert(kept.end(), &cube.corners[24 * cell], &cube.corners[24 * cell] + 24);
  cube.corners = kept;
  const Context context = make_context();
  submit(context.get(), cube);
  return check(context.get());
}

TEST(Check, CountsWhereTheSolidTouchesItself) {
  const tetlod_mesh_report report = check_cells({0, 3});  // they have one edge in common
  EXPECT_EQ(report.nonmanifold_edges.count, 1);
  EXPECT_EQ(report.nonmanifold_points.count, 2);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.status, TETLOD_OK);
}

TEST(Check, NamesAPointOfAnEdgeAndOneThatIsCutApart) {
  const tetlod_mesh_report on_a_plate = check_cells({0, 1, 2, 3, 4, 7});  // two cells that touch, above four
  EXPECT_EQ(on_a_plate.nonmanifold_edges.count, 1);
  EXPECT_EQ(on_a_plate.nonmanifold_edges.first, 13);
  EXPECT_EQ(on_a_plate.nonmanifold_points.count, 1);
  EXPECT_EQ(on_a_plate.nonmanifold_points.first, 22);
  const tetlod_mesh_report at_a_point = check_cells({0, 7});
  EXPECT_EQ(at_a_point.nonmanifold_edges.count, 0);
  EXPECT_EQ(at_a_point.nonmanifold_edges.first, -1);
  EXPECT_EQ(at_a_point.nonmanifold_points.count, 1);
  EXPECT_EQ(at_a_point.nonmanifold_points.first, 13);
}

TEST(Check, RefusesCountsBeforeAPolicyTheMesh) {
  Cube cube(2);
  cube.corners.insert(cube.corners.end(), cube.corners.begin(), cube.corners.begin() + 4);
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_DUPLICATE, TETLOD_POLICY_ERROR), TETLOD_OK);
  const std::vector<std::uint8_t> flags(cube.values.size() + 1, 0);
  const tetlod_array array = array_of(TETLOD_UINT8, flags.size(), 1, const_cast<std::uint8_t *>(flags.data()));
  ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK);
  tetlod_mesh_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT);
  EXPECT_EQ(tetlod_check(context.get(), &report), TETLOD_ERR_ARGUMENT);
  EXPECT_EQ(message_of(context.get()), "28 flags for 27 points");
}

TEST(Check, NumbersFromTheIndexBase) {
  Cube cube(2);
  for (std::int32_t &v : cube.corners) v++;
  cube.corners[4 * 5] = 99;
  const Context context = make_context();
  submit(context.get(), cube);
  const tetlod_array tets = array_of(TETLOD_INT32, cube.corners.size() / 4, 4, cube.corners.data());
  ASSERT_EQ(tetlod_submit_tets(context.get(), &tets, 1), TETLOD_OK);
  EXPECT_EQ(check(context.get()).index.first, 6);
}

TEST(Check, NeedsNoScalars) {
  const Cube cube(2);
  const Context context = make_context();
  const tetlod_array xyz = array_of(TETLOD_FLOAT64, cube.values.size(), 3, cube.xyz.data());
  const tetlod_array tets = array_of(TETLOD_INT32, cube.corners.size() / 4, 4, cube.corners.data());
  tetlod_mesh_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(tetlod_check(context.get(), &report), TETLOD_ERR_STATE);
  ASSERT_EQ(tetlod_submit_points(context.get(), &xyz), TETLOD_OK);
  ASSERT_EQ(tetlod_submit_tets(context.get(), &tets, 0), TETLOD_OK);
  EXPECT_EQ(check(context.get()).status, TETLOD_OK);
}

/// Nor to look at two parts with points at one place.
TEST(Check, NeedsNoScalarsOfParts) {
  Cube cubes(6);
  const std::size_t points = cubes.values.size(), corners = cubes.corners.size();
  for (std::size_t i = 0; i < 3 * points; i++) cubes.xyz.push_back(cubes.xyz[i] + (i % 3 == 0 ? 1 : 0));
  for (std::size_t i = 0; i < corners; i++) cubes.corners.push_back(cubes.corners[i] + std::int32_t(points));
  cubes.values.resize(2 * points);
  const Context context = make_context();
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.1);
  const tetlod_array xyz = array_of(TETLOD_FLOAT64, 2 * points, 3, cubes.xyz.data());
  const tetlod_array tets = array_of(TETLOD_INT32, cubes.corners.size() / 4, 4, cubes.corners.data());
  ASSERT_EQ(tetlod_submit_points(context.get(), &xyz), TETLOD_OK);
  ASSERT_EQ(tetlod_submit_tets(context.get(), &tets, 0), TETLOD_OK);
  EXPECT_EQ(check(context.get()).coincident.count, 49);
  submit(context.get(), cubes);
  EXPECT_EQ(check(context.get()).coincident.count, 0) << "a field jumps there";
}

TEST(Check, IgnoresPointsWithoutAFiniteValueTogetherWithTheirTets) {
  Cube cube(4);
  for (std::size_t v = 0; v < 25; v++) cube.values[v] = nan;  // the layer z = 0
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  const tetlod_run_report report = report_of(context.get());
  EXPECT_EQ(report.nonfinite_points, 25);
  EXPECT_EQ(report.dropped_tets, 6 * 16);
  EXPECT_EQ(report.boundary_triangles_in, 2 * 2 * (16 + 12 + 12));
}

/// Their fields that steer, too.
TEST(Check, LooksAtTheValuesOfAllFieldsThatSteer) {
  const Cube cube(2);
  std::vector<double> second = cube.values;
  second[13] = nan;
  const Context context = make_context();
  submit(context.get(), cube);
  const tetlod_array array = array_of(TETLOD_FLOAT64, second.size(), 1, second.data());
  ASSERT_EQ(tetlod_submit_steering(context.get(), "second", 1, &array), TETLOD_OK);
  const tetlod_mesh_report report = check(context.get());
  EXPECT_EQ(report.nonfinite_values.count, 1);
  EXPECT_EQ(report.nonfinite_values.first, 13);
}

TEST(Check, FindsSolidsThatCross) {
  Cube cube(2);
  const Cube other(2);
  const double way[3] = {0.5, 0.25, 0.125};
  const auto first = std::int32_t(cube.values.size());
  for (std::size_t k = 0; k < other.xyz.size(); k++) cube.xyz.push_back(other.xyz[k] + way[k % 3]);
  for (std::int32_t v : other.corners) cube.corners.push_back(first + v);
  cube.values.insert(cube.values.end(), other.values.begin(), other.values.end());
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_EQ(check(context.get()).status, TETLOD_ERR_MESH_INTERSECTING);
}

/// As a run scales them.
TEST(Check, CountsTheSameAtExtremeCoordinates) {
  for (double scale : {1.0, 1e-300, 1e-130, 1e200}) {
    Cube cube(3);
    const std::int64_t inverted = count_negative(cube);
    for (double &x : cube.xyz) x *= scale;
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MERGE_TOLERANCE, 1e-6), TETLOD_OK);
    const tetlod_mesh_report report = check(context.get());
    EXPECT_EQ(report.flat.count, 0) << scale;
    EXPECT_EQ(report.coincident.count, 0) << scale;
    EXPECT_EQ(report.overlapping.count, 0) << scale;
    EXPECT_EQ(report.inverted.count, inverted) << scale;
    EXPECT_EQ(report.components, 1) << scale;
  }
}

/// A point without a place makes its tets neither inverted nor flat, and their faces no neighbours.
TEST(Check, SaysNothingElseOfTetsOfAPointWithoutAPlace) {
  Cube cube(2);
  cube.xyz[3 * 13] = nan;
  const Context context = make_context();
  submit(context.get(), cube);
  const tetlod_mesh_report report = check(context.get());
  EXPECT_EQ(report.nonfinite_points.count, 1);
  EXPECT_EQ(report.flat.count, 0);
  EXPECT_EQ(report.overlapping.count, 0);
}

/// Two flat tets on either half of a square have a face in common that has no sides.
TEST(Check, FlatNeighboursDoNotOverlap) {
  Cube cube(1);
  cube.xyz = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.4, 0, 0.5, 0.5, 1};
  cube.values.assign(6, 0);
  cube.corners = {0, 1, 2, 4, 0, 2, 3, 4, 0, 1, 2, 5, 0, 2, 3, 5};
  const Context context = make_context();
  submit(context.get(), cube);
  const tetlod_mesh_report report = check(context.get());
  EXPECT_EQ(report.flat.count, 2);
  EXPECT_EQ(report.overlapping.count, 0);
}

/// Each is counted once, as what it is.
TEST(Check, UnusedPointsAreNotThoseWithoutAValue) {
  Cube cube(4);
  add_point(cube, 5, 5, 5);
  cube.values[62] = nan;
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(report_of(context.get()).unused_points, 1);
  EXPECT_EQ(report_of(context.get()).nonfinite_points, 1);
}

}  // namespace
