// The errors of the last result, as the host asks for them.
#include "fields_fixture.hpp"

namespace tetlod_test {
namespace {

/// Of the random points: as it is set when they are needed.
TEST_F(Fields, TheSeedIsOfTheMeasurement) {
  run();
  double rms[3];
  for (std::size_t i = 0; i < 3; i++) {
    tetlod_error_report error{};
    error.struct_size = sizeof error;
    ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_SEED, i == 1 ? 77 : 1), TETLOD_OK);
    ASSERT_EQ(tetlod_measure_error(context.get(), 2, &error), TETLOD_OK);
    rms[i] = error.rms_inner;
  }
  EXPECT_NE(rms[0], rms[1]);
  EXPECT_EQ(rms[0], rms[2]);
}

/// What is kept of the run is not made again for its errors; with other flags it is, and they are the same.
TEST_F(Fields, ErrorsAreFoundInWhatIsKept) {
  run();
  tetlod_error_report kept{}, anew{};
  kept.struct_size = anew.struct_size = sizeof kept;
  const std::size_t bytes_of_run = allocator.in_all();
  ASSERT_EQ(tetlod_measure_error(context.get(), 2, &kept), TETLOD_OK);
  const std::size_t bytes_of_kept = allocator.in_all() - bytes_of_run;
  const std::vector<std::uint8_t> flags(points(), 0);
  const tetlod_array array = array_of(TETLOD_UINT8, points(), 1, flags.data());
  ASSERT_EQ(tetlod_submit_point_flags(context.get(), &array), TETLOD_OK);
  ASSERT_EQ(tetlod_measure_error(context.get(), 2, &anew), TETLOD_OK);
  EXPECT_GT(allocator.in_all() - bytes_of_run - bytes_of_kept, 2 * bytes_of_kept);
  EXPECT_GT(kept.rms_inner, 0);
  EXPECT_EQ(std::memcmp(&kept, &anew, sizeof kept), 0);
}

}  // namespace
}  // namespace tetlod_test
