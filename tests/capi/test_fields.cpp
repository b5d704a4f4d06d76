// Fields that ride along, the stencil, and transfer.
#include <limits>

#include "fields_fixture.hpp"

namespace tetlod_test {
namespace {

TEST_F(Fields, LinearFieldsAreExact) {
  const auto field = field_of(cube, 3, linear);
  ASSERT_EQ(carry("velocity", field, 3), TETLOD_OK);
  run();
  const auto found = fetch("velocity", 3, points_out());
  const auto at = result_points();
  for (std::size_t i = 0; i < at.size(); i++) {
    const Point p = nearest_inside(at[i]);
    for (int c = 0; c < 3; c++) ASSERT_NEAR(found[3 * i + std::size_t(c)], linear(p, c), 1e-12);
  }
}

TEST_F(Fields, AnOriginalVertexKeepsItsValue) {
  const auto field = field_of(cube, 1, bent);
  ASSERT_EQ(carry("bent", field, 1), TETLOD_OK);
  run();
  const auto found = fetch("bent", 1, points_out());
  const auto at = result_points();
  int known = 0;
  for (std::size_t i = 0; i < at.size(); i++)
    for (std::size_t v = 0; v < points(); v++)
      if (std::memcmp(cube.xyz.data() + 3 * v, at[i].data(), sizeof(Point)) == 0) {
        EXPECT_EQ(found[i], field[v]);
        known++;
      }
  EXPECT_GT(known, 8);
}

TEST_F(Fields, TheStencilIsAPartitionOfUnity) {
  run();
  const Stencil zero = stencil(0), one = stencil(1);
  const auto at = result_points();
  for (std::size_t i = 0; i < at.size(); i++) {
    double sum = 0;
    Point p{};
    for (std::size_t k = 4 * i; k < 4 * i + 4; k++) {
      ASSERT_EQ(one.ids[k], zero.ids[k] + 1);
      ASSERT_GE(zero.weights[k], 0);
      sum += zero.weights[k];
      for (std::size_t c = 0; c < 3; c++) p[c] += zero.weights[k] * cube.xyz[3 * std::size_t(zero.ids[k]) + c];
    }
    ASSERT_NEAR(sum, 1, 1e-15);
    for (std::size_t c = 0; c < 3; c++) ASSERT_NEAR(p[c], nearest_inside(at[i])[c], 1e-12);
  }
}

TEST_F(Fields, TransferGivesTheBytesOfACarriedField) {
  const auto field = field_of(cube, 5, bent);
  ASSERT_EQ(carry("carried", field, 5), TETLOD_OK);
  run();
  const auto carried = fetch("carried", 5, points_out());
  EXPECT_EQ(move(field, 5), carried);
  // Also when the stencil was not made by the run, and with threads.
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  submit(context.get(), cube);
  for (int threads : {1, 2}) {
    ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, threads), TETLOD_OK);
    run();
    EXPECT_EQ(move(field, 5), carried) << threads;
  }
}

/// What rides along leaves the mesh and its values as they are.
TEST_F(Fields, TheyHaveNoPartInTheResult) {
  run();
  const auto bare = bytes_of(context.get());
  const auto field = field_of(cube, 2, bent);
  std::vector<double> nothing(tets(), std::numeric_limits<double>::quiet_NaN());
  ASSERT_EQ(carry("bent", field, 2), TETLOD_OK);
  ASSERT_EQ(carry("nothing", nothing, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  EXPECT_EQ(bytes_of(context.get()), bare);
  for (double value : fetch("nothing", 1, tets_out())) EXPECT_TRUE(std::isnan(value));
}

TEST_F(Fields, CellsTakeTheTetThatHoldsTheirCentroid) {
  std::vector<double> region, number;
  for (std::size_t t = 0; t < tets(); t++) {
    region.push_back(t / 6 % 5 < 2 ? 7 : 11);  // x < 0.4
    number.push_back(double(t));
    number.push_back(-double(t));
  }
  ASSERT_EQ(carry("region", region, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  ASSERT_EQ(carry("number", number, 2, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  const auto regions = fetch("region", 1, tets_out()), numbers = fetch("number", 2, tets_out());
  std::vector<std::int32_t> corners(4 * tets_out());
  tetlod_array array = array_of(TETLOD_INT32, tets_out(), 4, corners.data());
  ASSERT_EQ(tetlod_fetch_tets(context.get(), 0, &array), TETLOD_OK);
  const auto at = result_points();
  for (std::size_t t = 0; t < tets_out(); t++) {
    double x = 0;
    for (std::size_t k = 0; k < 4; k++) x += at[std::size_t(corners[4 * t + k])][0] / 4;
    if (std::abs(x - 0.4) > 1e-9) {
      EXPECT_EQ(regions[t], x < 0.4 ? 7 : 11) << x;
    }
    EXPECT_EQ(region[std::size_t(numbers[2 * t])], regions[t]);
    EXPECT_EQ(numbers[2 * t + 1], -numbers[2 * t]);
  }
}

/// Points that are merged and tets that are dropped do not shift what comes after them.
TEST_F(Fields, NumbersAreTheCallersAlsoAfterRepairs) {
  ASSERT_EQ(tetlod_set_sigma(context.get(), 1), TETLOD_OK);
  ASSERT_EQ(tetlod_set_rho(context.get(), 0), TETLOD_OK);
  ASSERT_EQ(tetlod_set_min_distance(context.get(), 0), TETLOD_OK);
  Cube broken = cube;
  const auto twin = std::int32_t(broken.values.size());  // of vertex 100, used by one tet in its place
  for (std::size_t c = 0; c < 3; c++) broken.xyz.push_back(broken.xyz[300 + c]);
  broken.values.push_back(broken.values[100]);
  *std::find(broken.corners.begin(), broken.corners.end(), 100) = twin;
  broken.corners.insert(broken.corners.begin(), {1, 1, 2, 3, 4, 5, 5, 6});  // two tets that are none
  cube = broken;
  submit(context.get(), cube);
  auto field = field_of(cube, 1, linear);
  field[std::size_t(twin)] = 1e9;  // the lower twin's value counts
  std::vector<double> number(tets());
  for (std::size_t t = 0; t < tets(); t++) number[t] = double(t);
  ASSERT_EQ(carry("linear", field, 1), TETLOD_OK);
  ASSERT_EQ(carry("number", number, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  const auto found = fetch("linear", 1, points_out()), numbers = fetch("number", 1, tets_out());
  const auto at = result_points();
  for (std::size_t i = 0; i < at.size(); i++) ASSERT_NEAR(found[i], linear(at[i], 0), 1e-12);
  for (std::int32_t id : stencil().ids) EXPECT_NE(id, twin);
  for (double t : numbers) EXPECT_GE(t, 2);
  std::vector<std::int32_t> corners(4 * tets_out());
  tetlod_array array = array_of(TETLOD_INT32, tets_out(), 4, corners.data());
  ASSERT_EQ(tetlod_fetch_tets(context.get(), 0, &array), TETLOD_OK);
  for (std::size_t t = 0; t < tets_out(); t++) {  // the centroid is in the cell that the source is of
    const std::size_t cell = (std::size_t(numbers[t]) - 2) / 6;
    const std::size_t low[3] = {cell % 5, cell / 5 % 5, cell / 25};
    for (std::size_t c = 0; c < 3; c++) {
      double x = 0;
      for (std::size_t k = 0; k < 4; k++) x += at[std::size_t(corners[4 * t + k])][c] / 4;
      ASSERT_TRUE(x >= double(low[c]) / 5 - 1e-9 && x <= double(low[c] + 1) / 5 + 1e-9);
    }
  }
}

/// A tet given again is dropped with the boundary, after one with a vertex twice, which is dropped at once.
TEST_F(Fields, NumbersAreTheCallersAfterBothKindsOfRepair) {
  const std::vector<std::int32_t> twice(cube.corners.begin(), cube.corners.begin() + 4);
  cube.corners.insert(cube.corners.begin() + 4 * 100, twice.begin(), twice.end());
  cube.corners.insert(cube.corners.begin(), {0, 1, 2, 2});
  submit(context.get(), cube);
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 1);
  std::vector<double> number(tets());
  for (std::size_t t = 0; t < tets(); t++) number[t] = double(t);
  ASSERT_EQ(carry("number", number, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  const auto numbers = fetch("number", 1, tets_out());
  std::vector<std::int32_t> corners(4 * tets_out());
  tetlod_array array = array_of(TETLOD_INT32, tets_out(), 4, corners.data());
  ASSERT_EQ(tetlod_fetch_tets(context.get(), 0, &array), TETLOD_OK);
  const auto at = result_points();
  for (std::size_t t = 0; t < tets_out(); t++)
    for (std::size_t c = 0; c < 3; c++) {  // the centroid is in the box of the tet that is named
      double x = 0, low = 2, high = -2;
      for (std::size_t k = 0; k < 4; k++) {
        const double of_corner = cube.xyz[3 * std::size_t(cube.corners[4 * std::size_t(numbers[t]) + k]) + c];
        x += at[std::size_t(corners[4 * t + k])][c] / 4;
        low = std::min(low, of_corner);
        high = std::max(high, of_corner);
      }
      ASSERT_TRUE(x >= low - 1e-9 && x <= high + 1e-9) << t;
    }
}

/// So are those of centroids outside of every tet: a bent plate's chords.
TEST_F(Fields, NumbersOfTetsNearestToACentroidOutsideToo) {
  cube = Cube(10);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    const double angle = 3 * p[0], radius = 1 + 0.05 * p[2];
    cube.values[v] = std::sin(5 * angle) * p[1];
    p[0] = radius * std::cos(angle);
    p[2] = radius * std::sin(angle);
  }
  tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.02);
  std::vector<double> named[2];
  for (const std::size_t more : {0, 1}) {
    if (more) cube.corners.insert(cube.corners.begin(), {0, 1, 2, 2});
    submit(context.get(), cube);
    std::vector<double> number(tets());
    for (std::size_t t = 0; t < tets(); t++) number[t] = double(t) - double(more);
    ASSERT_EQ(carry("number", number, 1, TETLOD_CELL_FIELD), TETLOD_OK);
    run();
    named[more] = fetch("number", 1, tets_out());
  }
  EXPECT_EQ(named[0], named[1]);
}

TEST_F(Fields, ANameIsOneField) {
  const auto first = field_of(cube, 1, linear), second = field_of(cube, 2, bent);
  ASSERT_EQ(carry("a", first, 1), TETLOD_OK);
  ASSERT_EQ(carry("b", first, 1), TETLOD_OK);
  ASSERT_EQ(carry("a", second, 2), TETLOD_OK);
  run();
  EXPECT_EQ(fetch("a", 2, points_out()), move(second, 2));
  EXPECT_EQ(fetch("b", 1, points_out()), move(first, 1));
}

TEST_F(Fields, AFailedRunKeepsTheFields) {
  const auto field = field_of(cube, 1, bent);
  ASSERT_EQ(carry("bent", field, 1), TETLOD_OK);
  run();
  const auto kept = fetch("bent", 1, points_out());
  const auto wrong = field_of(Cube(4), 1, bent);
  ASSERT_EQ(carry("bent", wrong, 1), TETLOD_OK);
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT, "field bent: 125 tuples for 216 points");
  ASSERT_EQ(carry("bent", field, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT, "field bent: 216 tuples for 750 tets");
  ASSERT_EQ(carry("bent", field, 1), TETLOD_OK);
  const tetlod_array values = array_of(TETLOD_FLOAT64, 125, 1, cube.values.data());
  ASSERT_EQ(tetlod_submit_scalars(context.get(), "heat", &values), TETLOD_OK);
  expect_failure(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT, "scalars heat: 125 values for 216 points");
  EXPECT_EQ(fetch("bent", 1, points_out()), kept);
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  EXPECT_EQ(fetch("bent", 1, points_out()), kept);
  submit(context.get(), cube);
  run();  // without fields: those of the last result are gone with it
  double room = 0;
  tetlod_array array = array_of(TETLOD_FLOAT64, 1, 1, &room);
  expect_failure(tetlod_fetch_field(context.get(), "bent", &array), TETLOD_ERR_ARGUMENT,
                 "carried no field bent, but none");
}

TEST_F(Fields, TheStencilNeedsTheInputOfItsRun) {
  run();
  const auto field = field_of(cube, 1, bent);
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  std::vector<double> room(points_out(), -99);
  const tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, field.data());
  tetlod_array to = array_of(TETLOD_FLOAT64, points_out(), 1, room.data());
  expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_STATE, "no points are submitted");
  Cube other(5);
  other.xyz.front() -= 1e-9;
  submit(context.get(), other);
  expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_STATE, "have changed since the run");
  EXPECT_EQ(room, std::vector<double>(points_out(), -99));
  const Cube same(5);
  submit(context.get(), same);
  const auto moved = move(field, 1);
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  EXPECT_EQ(move(field, 1), moved) << "once it is there nothing is read again";
}

/// A mesh that has moved would be looked for in the wrong place; once the stencil is there, fields follow the mesh.
TEST_F(Fields, TheStencilNeedsTheMeshOfItsRun) {
  const double moved = 10;
  const auto field = field_of(cube, 1, bent);
  const auto move_mesh = [&](double way) {
    std::for_each(cube.xyz.begin(), cube.xyz.end(), [=](double &x) { x += way; });
  };
  run();
  move_mesh(moved);
  std::vector<double> room(points_out(), -99);
  const tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, field.data());
  tetlod_array to = array_of(TETLOD_FLOAT64, points_out(), 1, room.data());
  expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_STATE, "have changed since the run");
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  expect_failure(tetlod_measure_error(context.get(), 0, &error), TETLOD_ERR_STATE, "have changed since the run");
  EXPECT_EQ(room, std::vector<double>(points_out(), -99));
  move_mesh(-moved);
  for (double &x : cube.xyz) x = std::round(x * 5) / 5;  // to the last bit
  run();
  const auto before = move(field, 1);
  move_mesh(moved);
  EXPECT_EQ(move(field, 1), before);
}

/// Also where rounding puts a vertex beside the tet that it lies on a side of.
TEST_F(Fields, WeightsOfTheStencilAreNotNegative) {
  for (int cells : {4, 6, 9})
    for (int preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
      cube = Cube(cells);
      for (double *p = cube.xyz.data(); p != cube.xyz.data() + cube.xyz.size(); p += 3) {
        const double x = 0.6 * p[0] - 0.8 * p[1] + 0.1 * p[2], y = 0.8 * x + 0.6 * p[1], z = 1.1 * p[2] + 0.3 * x;
        p[0] = x;
        p[1] = y;
        p[2] = z;
      }
      submit(context.get(), cube);
      ASSERT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
      run();
      std::vector<std::int64_t> at(4 * points_out());
      std::vector<double> of(4 * points_out());
      tetlod_array ids = array_of(TETLOD_INT64, points_out(), 4, at.data());
      tetlod_array weights = array_of(TETLOD_FLOAT64, points_out(), 4, of.data());
      ASSERT_EQ(tetlod_fetch_stencil(context.get(), 0, &ids, &weights), TETLOD_OK) << message_of(context.get());
      EXPECT_GE(*std::min_element(of.begin(), of.end()), 0) << cells << ' ' << preset;
    }
}

TEST_F(Fields, WhatIsRefused) {
  const auto field = field_of(cube, 2, linear);
  tetlod_array array = array_of(TETLOD_FLOAT64, points(), 2, field.data());
  const auto submit_as = [&](const char *name, int association) {
    return tetlod_submit_field(context.get(), name, association, &array);
  };
  expect_failure(submit_as(nullptr, 0), TETLOD_ERR_ARGUMENT, "name is NULL");
  expect_failure(submit_as("", 0), TETLOD_ERR_ARGUMENT, "name is empty");
  expect_failure(submit_as("a", 2), TETLOD_ERR_ARGUMENT, "association 2");
  for (int components : {0, -1, 65}) {
    array.components = components;
    expect_failure(submit_as("a", 0), TETLOD_ERR_ARGUMENT, "field a: ");
  }
  array.components = 64;
  array.tuples = 1;
  EXPECT_EQ(submit_as("a", 0), TETLOD_OK);
  for (const std::int32_t type : {0, 6}) {
    array.type = type;
    expect_failure(submit_as("a", 0), TETLOD_ERR_ARGUMENT, "field a: type ");
  }
  array = array_of(TETLOD_FLOAT64, points(), 2, field.data());
  expect_failure(tetlod_fetch_field(context.get(), "a", &array), TETLOD_ERR_STATE, "no result");
  expect_failure(tetlod_transfer(context.get(), &array, &array), TETLOD_ERR_STATE, "no result");
  ASSERT_EQ(submit_as("a", 0), TETLOD_OK);
  run();
  std::vector<double> room(2 * points_out(), -99);
  tetlod_array dst = array_of(TETLOD_FLOAT64, points_out(), 2, room.data());
  expect_failure(tetlod_fetch_field(context.get(), "b", &dst), TETLOD_ERR_ARGUMENT, "no field b, but a");
  expect_failure(tetlod_fetch_field(context.get(), nullptr, &dst), TETLOD_ERR_ARGUMENT, "name is NULL");
  dst.components = 1;
  expect_failure(tetlod_fetch_field(context.get(), "a", &dst), TETLOD_ERR_ARGUMENT, "1 components, 2 are needed");
  expect_failure(tetlod_transfer(context.get(), &array, &dst), TETLOD_ERR_ARGUMENT, "original has 2 components");
  dst.components = 2;
  dst.tuples--;
  expect_failure(tetlod_fetch_field(context.get(), "a", &dst), TETLOD_ERR_BUFFER_SIZE, "room for");
  expect_failure(tetlod_transfer(context.get(), &array, &dst), TETLOD_ERR_BUFFER_SIZE, "room for");
  dst.tuples++;
  array.tuples--;
  expect_failure(tetlod_transfer(context.get(), &array, &dst), TETLOD_ERR_ARGUMENT,
                 "215 tuples, the original mesh has 216");
  array.tuples += 2;
  expect_failure(tetlod_transfer(context.get(), &array, &dst), TETLOD_ERR_ARGUMENT, "217 tuples");
  tetlod_array ids = array_of(TETLOD_INT32, points_out(), 4, room.data()), weights = dst;
  expect_failure(tetlod_fetch_stencil(context.get(), 2, &ids, &weights), TETLOD_ERR_ARGUMENT, "index_base 2");
  expect_failure(tetlod_fetch_stencil(context.get(), 0, &ids, &weights), TETLOD_ERR_ARGUMENT, "weights: 2 components");
  std::vector<double> both(8 * points_out(), -99);
  ids = array_of(TETLOD_INT64, points_out() + 1, 4, both.data());  // of which the last tuple is left alone
  weights = array_of(TETLOD_FLOAT64, points_out(), 4, both.data() + 4);
  expect_failure(tetlod_fetch_stencil(context.get(), 0, &ids, &weights), TETLOD_ERR_ARGUMENT, "weights: shares memory");
  EXPECT_EQ(both, std::vector<double>(both.size(), -99));
  weights.data = both.data() + 4 * points_out();
  EXPECT_EQ(tetlod_fetch_stencil(context.get(), 0, &ids, &weights), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(room, std::vector<double>(room.size(), -99));
}

/// Coordinates that are scaled inside are located all the same.
TEST_F(Fields, ExtremeCoordinates) {
  const auto field = field_of(cube, 1, linear);
  for (double &x : cube.xyz) x = std::ldexp(x, -400);
  submit(context.get(), cube);
  run();
  const auto moved = move(field, 1);
  const auto at = result_points();
  for (std::size_t i = 0; i < at.size(); i++) {
    const Point p = {std::ldexp(at[i][0], 400), std::ldexp(at[i][1], 400), std::ldexp(at[i][2], 400)};
    ASSERT_NEAR(moved[i], linear(nearest_inside(p), 0), 1e-12);
  }
}

}  // namespace
}  // namespace tetlod_test
