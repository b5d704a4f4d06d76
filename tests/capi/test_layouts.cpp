// The same numbers in another layout, in a context that has seen them.
#include "fixtures.hpp"

namespace tetlod_test {
namespace {

/// Every third of an array's numbers, between others that mean nothing.
std::vector<double> every_third(const std::vector<double> &of, std::size_t first) {
  std::vector<double> spread(of.size(), -7);
  for (std::size_t i = 0; i < of.size(); i += 3) spread[i] = of[i + first];
  return spread;
}

TEST(Layouts, CoordinatesThatLieApartWithTheStrideOfThoseThatLieTogether) {
  const Cube cube(6);
  const std::vector<double> axes[3] = {every_third(cube.xyz, 0), every_third(cube.xyz, 1), every_third(cube.xyz, 2)};
  tetlod_array apart[3];
  for (std::size_t k = 0; k < 3; k++) {
    apart[k] = array_of(TETLOD_FLOAT64, cube.values.size(), 1, axes[k].data());
    apart[k].tuple_stride = 3 * sizeof(double);
  }
  for (std::int32_t preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    const auto wanted = bytes_of(context.get());
    ASSERT_EQ(tetlod_submit_points_xyz(context.get(), &apart[0], &apart[1], &apart[2]), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_EQ(bytes_of(context.get()), wanted) << preset;
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_EQ(bytes_of(context.get()), wanted) << preset;
  }
}

/// Components that run against the tuples would fall on each other; some reach further than memory does.
TEST(Layouts, StridesThatCannotBe) {
  const Cube cube(2);
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  std::vector<double> room(3000);
  tetlod_array array = array_of(TETLOD_FLOAT64, 900, 3, room.data() + 1000);
  array.tuple_stride = sizeof(double);
  array.component_stride = -std::int64_t(sizeof(double));
  EXPECT_EQ(tetlod_fetch_points(context.get(), &array), TETLOD_ERR_ARGUMENT);
  array = array_of(TETLOD_FLOAT64, 1, 3, room.data());
  array.component_stride = std::int64_t(1) << 62;
  EXPECT_EQ(tetlod_submit_points(context.get(), &array), TETLOD_ERR_ARGUMENT);
}

}  // namespace
}  // namespace tetlod_test
