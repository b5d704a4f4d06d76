// Fields that ride along, where memory ends and threads differ.
#include <set>

#include "fields_fixture.hpp"

namespace tetlod_test {
namespace {

TEST_F(Fields, EveryHookedAllocation) {
  const auto field = field_of(cube, 2, bent);
  std::vector<double> cells(tets(), 4);
  const auto submit_all = [&] {
    submit(context.get(), cube);
    ASSERT_EQ(carry("bent", field, 2), TETLOD_OK);
    ASSERT_EQ(carry("cells", cells, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  };
  submit_all();
  run();
  const auto kept = fetch("bent", 2, points_out());
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);  // of the mesh nothing is kept then
  submit_all();
  allocator.fail_each(
      context.get(), [&] { return tetlod_run(context.get()); },
      [&](bool) { EXPECT_EQ(fetch("bent", 2, points_out()), kept); });
}

TEST_F(Fields, EveryHookedAllocationOfTransfer) {
  const auto field = field_of(cube, 1, bent);
  run();
  std::vector<double> room(points_out(), -99);
  const tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, field.data());
  tetlod_array to = array_of(TETLOD_FLOAT64, points_out(), 1, room.data());
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);  // of the mesh nothing is kept then
  submit(context.get(), cube);
  const long failures = allocator.fail_each(
      context.get(), [&] { return tetlod_transfer(context.get(), &from, &to); },
      [&](bool failed) { EXPECT_EQ(room == std::vector<double>(room.size(), -99), failed); });
  EXPECT_GT(failures, 5);
}

/// Between the bytes of the original's tuples there may be room for the simplified one's.
TEST_F(Fields, TransferTakesMemoryOfItsOwn) {
  const auto field = field_of(cube, 1, bent);
  run();
  std::vector<double> pairs;
  for (const double value : field) pairs.insert(pairs.end(), {value, -99});
  const std::vector<double> before = pairs;
  tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, pairs.data());
  from.tuple_stride = 2 * sizeof(double);
  tetlod_array to = from;
  for (const std::ptrdiff_t shift : {0, 2, 4}) {
    to.data = pairs.data() + shift;
    to.tuples = std::int64_t(points()) - shift / 2;  // of which what is beyond the result's points is left alone
    expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_ARGUMENT, "simplified: shares memory");
  }
  to = array_of(TETLOD_FLOAT64, points(), 1, pairs.data() + 1);
  expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_ARGUMENT, "simplified: shares memory");
  EXPECT_EQ(pairs, before);
  tetlod_array halves = array_of(TETLOD_FLOAT32, points(), 1, reinterpret_cast<unsigned char *>(pairs.data()) + 4);
  halves.tuple_stride = from.tuple_stride;
  expect_failure(tetlod_transfer(context.get(), &from, &halves), TETLOD_ERR_ARGUMENT, "simplified: shares memory");
  EXPECT_EQ(pairs, before);
  to.tuple_stride = from.tuple_stride;
  ASSERT_EQ(tetlod_transfer(context.get(), &from, &to), TETLOD_OK) << message_of(context.get());
  const auto moved = move(field, 1);
  for (std::size_t i = 0; i < moved.size(); i++) EXPECT_EQ(pairs[2 * i + 1], moved[i]);
  for (std::size_t i = 0; i < field.size(); i++) EXPECT_EQ(pairs[2 * i], field[i]);
}

/// Forwards and backwards, beside each other and over each other.
TEST_F(Fields, TransferKnowsItsMemoryWithAnyStrides) {
  const auto field = field_of(cube, 1, bent);
  run();
  const auto moved = move(field, 1);
  const auto step = std::ptrdiff_t(sizeof(double)), middle = 8 * std::ptrdiff_t(points());
  int kept_apart = 0;
  for (const std::ptrdiff_t stride : {1, -1, 2, -2})
    for (const std::ptrdiff_t other : {stride, -stride, 3 * stride})
      for (const std::ptrdiff_t shift : {0, 1, 2, 5, -1, -2, -5, int(points()), -int(points())}) {
        std::vector<double> room(std::size_t(2 * middle + 1), -99);
        double *const source = &room[std::size_t(middle)], *const place = source + shift;
        std::set<const double *> read, written;
        for (std::size_t i = 0; i < field.size(); i++) read.insert(source + stride * std::ptrdiff_t(i));
        for (std::size_t i = 0; i < moved.size(); i++) written.insert(place + other * std::ptrdiff_t(i));
        const bool shared =
            std::any_of(written.begin(), written.end(), [&](const double *at) { return read.count(at); });
        for (std::size_t i = 0; i < field.size(); i++) source[stride * std::ptrdiff_t(i)] = field[i];
        tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, source);
        tetlod_array to = array_of(TETLOD_FLOAT64, moved.size(), 1, place);
        from.tuple_stride = stride * step;
        to.tuple_stride = other * step;
        const tetlod_status status = tetlod_transfer(context.get(), &from, &to);
        const bool of_one_length = std::abs(stride) == std::abs(other);
        EXPECT_TRUE(status == TETLOD_OK || shared || !of_one_length) << stride << ' ' << other << ' ' << shift;
        EXPECT_EQ(status == TETLOD_OK && shared, false) << stride << ' ' << other << ' ' << shift;
        if (status != TETLOD_OK) continue;
        kept_apart++;
        for (std::size_t i = 0; i < moved.size(); i++) ASSERT_EQ(place[other * std::ptrdiff_t(i)], moved[i]);
        for (std::size_t i = 0; i < field.size(); i++) ASSERT_EQ(source[stride * std::ptrdiff_t(i)], field[i]);
      }
  EXPECT_GT(kept_apart, 20);
}

/// A solver that writes each step into other arrays, and lets another field steer from then on.
TEST_F(Fields, TheStencilIsThatOfTheMeshWhateverItsValuesAre) {
  const auto field = field_of(cube, 1, bent);
  run();
  const auto moved = move(field, 1);
  for (const bool steers : {false, true}) {
    submit(context.get(), cube);
    run();
    Cube later = cube;
    for (double &value : later.values) value = -value * value;
    submit(context.get(), later);
    const tetlod_array second = array_of(TETLOD_FLOAT64, points(), 1, field.data());
    ASSERT_EQ(tetlod_submit_steering(context.get(), "second", steers ? 1 : 0, &second), TETLOD_OK);
    EXPECT_EQ(move(field, 1), moved);
    tetlod_error_report error{};
    error.struct_size = sizeof error;
    expect_failure(tetlod_measure_error(context.get(), 0, &error), TETLOD_ERR_STATE, "of the last run are not");
    ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  }
}

/// Values that are not finite take points and tets away, and the stencil would be looked for in another mesh.
TEST_F(Fields, TheStencilNeedsTheHolesOfItsRun) {
  const auto field = field_of(cube, 1, bent);
  const std::vector<double> whole = cube.values;
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR), TETLOD_OK);
  cube.values.front() = std::nan("");
  run();
  std::vector<double> room(points_out(), -99);
  const tetlod_array from = array_of(TETLOD_FLOAT64, points(), 1, field.data());
  tetlod_array to = array_of(TETLOD_FLOAT64, points_out(), 1, room.data());
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  for (const std::size_t hole : {whole.size(), whole.size() - 1}) {
    cube.values = whole;
    if (hole < whole.size()) cube.values[hole] = std::nan("");
    submit(context.get(), cube);
    expect_failure(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_STATE, "which values are finite");
    expect_failure(tetlod_measure_error(context.get(), 0, &error), TETLOD_ERR_STATE, "which values are finite");
  }
  EXPECT_EQ(room, std::vector<double>(points_out(), -99));
  cube.values = whole;
  cube.values.front() = std::nan("");
  cube.values.back() += 1;
  EXPECT_EQ(tetlod_transfer(context.get(), &from, &to), TETLOD_OK) << "other values there are the stencil's own matter";
}

/// A vertex is held by one tet, not by all that it is a corner of.
TEST_F(Fields, PointsThatAreLocatedTakeLittleMemory) {
  cube = Cube(22);
  const auto field = field_of(cube, 1, bent);
  cube.values = field;
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_SIGMA, 0.5), TETLOD_OK);
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_RHO, 0.001), TETLOD_OK);
  const auto peak_of_run = [&] {
    run();
    EXPECT_EQ(tetlod_clear(context.get()), TETLOD_OK);
    return double(report_of(context.get()).peak_bytes);
  };
  submit(context.get(), cube);
  const double bare = peak_of_run();
  submit(context.get(), cube);
  ASSERT_EQ(carry("bent", field, 1), TETLOD_OK);
  EXPECT_LT(peak_of_run(), 1.4 * bare) << "1.74 if by all";
}

/// The estimate counts what rides along, and a limit below it is met by a status.
TEST_F(Fields, MemoryIsCounted) {
  const auto field = field_of(cube, 64, bent);
  std::uint64_t bare = 0, laden = 0;
  ASSERT_EQ(tetlod_estimate_memory(context.get(), &bare), TETLOD_OK);
  for (const char *name : {"a", "b", "c", "d"}) ASSERT_EQ(carry(name, field, 64), TETLOD_OK);
  ASSERT_EQ(tetlod_estimate_memory(context.get(), &laden), TETLOD_OK);
  EXPECT_GT(laden, bare);
  run();
  tetlod_run_report report{};
  report.struct_size = sizeof report;
  ASSERT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
  EXPECT_GE(report.peak_bytes, 4 * 64 * 8 * points_out());
  tetlod_config config = default_config();
  config.memory_limit = report.peak_bytes - 1;
  Context poor = make_context(config);
  context.swap(poor);
  SetUp();
  for (const char *name : {"a", "b", "c", "d"}) ASSERT_EQ(carry(name, field, 64), TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MEMORY_LIMIT);
}

TEST_F(Fields, ThreadsGiveTheSameBytes) {
  const auto field = field_of(cube, 3, bent);
  std::vector<double> cells(tets());
  for (std::size_t t = 0; t < tets(); t++) cells[t] = double(t);
  ASSERT_EQ(carry("bent", field, 3), TETLOD_OK);
  ASSERT_EQ(carry("cells", cells, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  const auto points_one = fetch("bent", 3, points_out()), cells_one = fetch("cells", 1, tets_out());
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 2), TETLOD_OK);
  run();
  EXPECT_EQ(fetch("bent", 3, points_out()), points_one);
  EXPECT_EQ(fetch("cells", 1, tets_out()), cells_one);
}

}  // namespace
}  // namespace tetlod_test
