// What a repair policy ignores is as if it had never been there.
#include <cmath>
#include <limits>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

struct Request {
  std::int32_t preset, option;
  double value;
};
constexpr Request requests[] = {{TETLOD_PRESET_ACCURATE, TETLOD_OPT_TARGET_RATIO, 0.1},
                                {TETLOD_PRESET_FAST, TETLOD_OPT_TARGET_RATIO, 0.02},
                                {TETLOD_PRESET_ACCURATE, TETLOD_OPT_MAX_ERROR, 0.02},
                                {TETLOD_PRESET_PAPER, TETLOD_OPT_RHO, 0.1}};

std::vector<unsigned char> result_of(const Cube &cube, const Request &request) {
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_EQ(tetlod_set_preset(context.get(), request.preset), TETLOD_OK);
  EXPECT_EQ(tetlod_set_real(context.get(), request.option, request.value), TETLOD_OK);
  EXPECT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR), TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  return bytes_of(context.get());
}

Cube cube_with_waves(int n) {
  Cube cube(n);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    const double *const p = &cube.xyz[3 * v];
    cube.values[v] = std::sin(6 * p[0]) * std::cos(5 * p[1]) + p[2] * p[2];
  }
  return cube;
}

/// Far beyond the mesh, with any value, before and behind the others.
TEST(Ignored, PointsThatNoTetUses) {
  const Cube cube = cube_with_waves(7);
  const std::size_t many = 5 * cube.values.size();
  Cube before = cube, behind = cube;
  for (std::size_t i = 0; i < 3 * many; i++) {
    before.xyz.insert(before.xyz.begin(), 1e3 * double(i % 7));
    behind.xyz.push_back(-1e3 * double(i % 5));
  }
  before.values.insert(before.values.begin(), many, 1e6);
  behind.values.insert(behind.values.end(), many, -1e6);
  for (std::int32_t &corner : before.corners) corner += std::int32_t(many);
  for (const Request &request : requests) {
    const auto result = result_of(cube, request);
    EXPECT_EQ(result_of(before, request), result) << request.value;
    EXPECT_EQ(result_of(behind, request), result) << request.value;
  }
}

/// The mesh of the others is small; all together they would not be.
TEST(Ignored, TetsWithoutAValue) {
  Cube cube = cube_with_waves(26);
  std::vector<std::int32_t> kept;
  for (std::size_t t = 0; t < cube.corners.size(); t += 4) {
    const auto is_near = [&](std::int32_t v) { return cube.xyz[3 * std::size_t(v) + 2] < 0.25; };
    const std::int32_t *const tet = &cube.corners[t];
    if (std::all_of(tet, tet + 4, is_near)) kept.insert(kept.end(), tet, tet + 4);
  }
  Cube part = cube;
  part.corners = kept;
  for (std::size_t v = 0; v < cube.values.size(); v++)
    if (!(cube.xyz[3 * v + 2] < 0.25)) cube.values[v] = std::numeric_limits<double>::quiet_NaN();
  for (const Request &request : requests)
    EXPECT_EQ(result_of(cube, request), result_of(part, request)) << request.value;
}

}  // namespace
}  // namespace tetlod_test
