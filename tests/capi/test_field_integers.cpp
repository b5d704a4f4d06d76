// Fields of integers that ride along.
#include <limits>

#include "fields_fixture.hpp"

namespace tetlod_test {
namespace {

/// As the numbers of tets, in doubles, say where they come from; in their own type and in 64 bits.
TEST_F(Fields, IntegersOfCellsAreCopied) {
  std::vector<double> number;
  std::vector<std::uint8_t> small;
  std::vector<std::int32_t> pair;
  std::vector<std::int64_t> large;
  for (std::size_t t = 0; t < tets(); t++) {
    number.push_back(double(t));
    small.push_back(std::uint8_t(t % 251));
    pair.push_back(std::int32_t(t) - 300);
    pair.push_back(std::numeric_limits<std::int32_t>::min() + std::int32_t(t));
    large.push_back((std::int64_t(1) << 60) + std::int64_t(t));  // doubles in between are 256 apart
  }
  ASSERT_EQ(carry("number", number, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  ASSERT_EQ(carry_integers("small", TETLOD_UINT8, small, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  ASSERT_EQ(carry_integers("pair", TETLOD_INT32, pair, 2, TETLOD_CELL_FIELD), TETLOD_OK);
  ASSERT_EQ(carry_integers("large", TETLOD_INT64, large, 1, TETLOD_CELL_FIELD), TETLOD_OK);
  run();
  const auto numbers = fetch("number", 1, tets_out());
  const auto smalls = fetch_integers<std::uint8_t>("small", TETLOD_UINT8, 1, tets_out());
  const auto wide_smalls = fetch_integers<std::int64_t>("small", TETLOD_INT64, 1, tets_out());
  const auto pairs = fetch_integers<std::int32_t>("pair", TETLOD_INT32, 2, tets_out());
  const auto wide_pairs = fetch_integers<std::int64_t>("pair", TETLOD_INT64, 2, tets_out());
  const auto larges = fetch_integers<std::int64_t>("large", TETLOD_INT64, 1, tets_out());
  ASSERT_GT(tets_out(), 20u);
  for (std::size_t t = 0; t < tets_out(); t++) {
    const auto from = std::size_t(numbers[t]);
    EXPECT_EQ(smalls[t], small[from]);
    EXPECT_EQ(wide_smalls[t], small[from]);
    for (std::size_t c = 0; c < 2; c++) {
      EXPECT_EQ(pairs[2 * t + c], pair[2 * from + c]);
      EXPECT_EQ(wide_pairs[2 * t + c], pair[2 * from + c]);
    }
    EXPECT_EQ(larges[t], large[from]);
  }
}

/// A mean of names is none: that of the vertex with the largest weight, by the run and later.
TEST_F(Fields, IntegersOfPointsAreThoseOfTheVertexThatCountsMost) {
  std::vector<std::int64_t> name(2 * points());
  for (std::size_t i = 0; i < name.size(); i++) name[i] = (std::int64_t(1) << 60) + std::int64_t(i * i);
  ASSERT_EQ(carry_integers("name", TETLOD_INT64, name, 2, TETLOD_POINT_FIELD), TETLOD_OK);
  run();
  const auto names = fetch_integers<std::int64_t>("name", TETLOD_INT64, 2, points_out());
  const Stencil of = stencil();
  int mixed = 0;
  for (std::size_t i = 0; i < points_out(); i++) {
    std::size_t most = 4 * i;
    for (std::size_t k = 4 * i; k < 4 * i + 4; k++)
      if (of.weights[k] > of.weights[most]) most = k;
    mixed += of.weights[most] < 1;
    for (std::size_t c = 0; c < 2; c++) EXPECT_EQ(names[2 * i + c], name[2 * std::size_t(of.ids[most]) + c]);
  }
  EXPECT_GT(mixed, 0);
  std::vector<std::int64_t> moved(names.size());
  const tetlod_array from = array_of(TETLOD_INT64, points(), 2, name.data());
  tetlod_array to = array_of(TETLOD_INT64, points_out(), 2, moved.data());
  ASSERT_EQ(tetlod_transfer(context.get(), &from, &to), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(moved, names);
}

/// What would round, or not fit, is refused, and nothing is written.
TEST_F(Fields, IntegersGoToTheirOwnTypeOrTo64Bits) {
  const std::vector<std::uint8_t> mark(points(), 3);
  ASSERT_EQ(carry_integers("mark", TETLOD_UINT8, mark, 1, TETLOD_POINT_FIELD), TETLOD_OK);
  const std::vector<double> threes(points(), 3);
  ASSERT_EQ(carry("real", threes, 1), TETLOD_OK);
  run();
  std::vector<double> room(points_out(), -99);
  const tetlod_array from = array_of(TETLOD_UINT8, points(), 1, mark.data());
  for (const std::int32_t type : {TETLOD_INT32, TETLOD_FLOAT32, TETLOD_FLOAT64}) {
    tetlod_array dst = array_of(type, points_out(), 1, room.data());
    expect_failure(tetlod_fetch_field(context.get(), "mark", &dst), TETLOD_ERR_ARGUMENT, "integers of type 5");
    expect_failure(tetlod_transfer(context.get(), &from, &dst), TETLOD_ERR_ARGUMENT, "integers of type 5");
  }
  for (const std::int32_t type : {TETLOD_INT32, TETLOD_INT64, TETLOD_UINT8}) {
    tetlod_array dst = array_of(type, points_out(), 1, room.data());
    expect_failure(tetlod_fetch_field(context.get(), "real", &dst), TETLOD_ERR_ARGUMENT, "neither TETLOD_FLOAT32");
  }
  EXPECT_EQ(room, std::vector<double>(points_out(), -99));
  EXPECT_EQ(fetch_integers<std::uint8_t>("mark", TETLOD_UINT8, 1, points_out()),
            std::vector<std::uint8_t>(points_out(), 3));
  const tetlod_array marks = array_of(TETLOD_UINT8, points(), 1, mark.data());
  expect_failure(tetlod_submit_steering(context.get(), "mark", 1, &marks), TETLOD_ERR_ARGUMENT, "type 5");
}

}  // namespace
}  // namespace tetlod_test
