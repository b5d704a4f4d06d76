// What a run is said to need it takes, about, and it takes no more than it is allowed.
#include <cmath>
#include <utility>

#include "fixtures.hpp"

namespace {

using namespace tetlod_test;

/// Estimates and runs. most: what the estimate may be of the peak; and the peak of it.
void expect_estimate(tetlod_context *context, const std::string &what, double most = 1.5, double most_of_it = 1.5) {
  std::uint64_t estimate = 0;
  ASSERT_EQ(tetlod_estimate_memory(context, &estimate), TETLOD_OK) << message_of(context);
  ASSERT_EQ(tetlod_run(context), TETLOD_OK) << message_of(context);
  const double peak = double(report_of(context).peak_bytes);
  EXPECT_LT(double(estimate), most * peak) << what;
  EXPECT_GT(most_of_it * double(estimate), peak) << what;
}

TEST(EstimateMemory, IsWithinAFactorOfOneAndAHalf) {
  for (int n : {8, 16, 24})
    for (double sigma : {0.05, 1.0})
      for (double rho : {0.0, 0.1}) {
        const Cube cube(n);
        const Context context = make_context();
        submit(context.get(), cube);
        ASSERT_EQ(tetlod_set_sigma(context.get(), sigma), TETLOD_OK);
        ASSERT_EQ(tetlod_set_rho(context.get(), rho), TETLOD_OK);
        expect_estimate(context.get(), std::to_string(n) + ' ' + std::to_string(sigma) + ' ' + std::to_string(rho));
      }
}

/// Of the submitted points few are the mesh's: others are in no tet, or become one.
TEST(EstimateMemory, OfPointsThatAreNoVertices) {
  const Cube cube(20);
  Cube unused = cube, apart = cube;
  unused.xyz.resize(20 * cube.xyz.size(), 7);
  unused.values.resize(20 * cube.values.size(), 0);
  apart.xyz.clear();
  apart.values.clear();
  for (std::int32_t &v : apart.corners) {
    apart.xyz.insert(apart.xyz.end(), &cube.xyz[3 * std::size_t(v)], &cube.xyz[3 * std::size_t(v)] + 3);
    apart.values.push_back(cube.values[std::size_t(v)]);
    v = std::int32_t(apart.values.size()) - 1;
  }
  for (const Cube &mesh : {unused, apart}) {
    const Context context = make_context();
    submit(context.get(), mesh);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.1), TETLOD_OK);
    expect_estimate(context.get(), std::to_string(mesh.values.size()) + " points");
  }
}

/// Sizes, bounds and fields, also of cells, each with stages of their own.
TEST(EstimateMemory, KnowsTargetsBoundsAndFields) {
  Cube cube(20);
  for (std::size_t v = 0; v < cube.values.size(); v++)
    cube.values[v] = std::sin(9 * cube.xyz[3 * v]) * std::cos(7 * cube.xyz[3 * v + 1]) + cube.xyz[3 * v + 2];
  std::vector<double> of_points(3 * cube.values.size(), 1), of_tets(cube.corners.size() / 4, 2);
  const tetlod_array points = array_of(TETLOD_FLOAT64, cube.values.size(), 3, of_points.data());
  const tetlod_array tets = array_of(TETLOD_FLOAT64, of_tets.size(), 1, of_tets.data());
  for (double ratio : {0.0, 0.1, 0.5})
    for (double bound : {0.0, 0.05})
      for (bool fields : {false, true}) {
        const Context context = make_context();
        submit(context.get(), cube);
        ASSERT_EQ(tetlod_set_rho(context.get(), 0), TETLOD_OK);
        ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
        ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound), TETLOD_OK);
        if (fields) {
          ASSERT_EQ(tetlod_submit_field(context.get(), "p", TETLOD_POINT_FIELD, &points), TETLOD_OK);
          ASSERT_EQ(tetlod_submit_field(context.get(), "t", TETLOD_CELL_FIELD, &tets), TETLOD_OK);
        }
        expect_estimate(context.get(), "ratio " + std::to_string(ratio) + ", bound " + std::to_string(bound) +
                                           (fields ? ", fields" : ""));
      }
}

/// With further attempts, and rounds, for accuracy: where much is kept, what they take decides.
TEST(EstimateMemory, KnowsSmallMeshes) {
  for (int n : {8, 15, 17})
    for (double ratio : {0.01, 0.1, 0.5, 0.9, 1.0}) {
      const Cube cube(n);
      const Context context = make_context();
      submit(context.get(), cube);
      ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
      expect_estimate(context.get(), std::to_string(n) + ", ratio " + std::to_string(ratio), 1.5, 1.25);
    }
}

/// Where all tets are kept nothing is refined, unless boundary edges are cleaned, which leads to TetGen.
TEST(EstimateMemory, KnowsWhatIsDoneWhereAllTetsAreKept) {
  for (double clean : {0.0, 1e-7}) {
    const Cube cube(12);
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 1), TETLOD_OK);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, clean), TETLOD_OK);
    expect_estimate(context.get(), "clean-edges " + std::to_string(clean));
  }
}

/// The lowest layers of a cube of n: thin solids have many triangles a tet.
Cube plate(int n, int layers) {
  Cube cube(n);
  const auto left = std::size_t((layers + 1) * (n + 1) * (n + 1));
  cube.xyz.resize(3 * left);
  cube.values.resize(left);
  cube.corners.resize(cube.corners.size() / std::size_t(n) * std::size_t(layers));
  return cube;
}

TEST(EstimateMemory, KnowsThinSolids) {
  for (int n : {16, 40, 60})
    for (int layers : {1, 2})
      for (double ratio : {0.02, 0.1, 0.3}) {
        const Cube cube = plate(n, layers);
        const Context context = make_context();
        submit(context.get(), cube);
        ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
        expect_estimate(context.get(),
                        std::to_string(n) + ", " + std::to_string(layers) + " layers, ratio " + std::to_string(ratio));
        EXPECT_EQ(report_of(context.get()).remesh_attempts, 0);
      }
}

/// Most of them where there are many triangles.
TEST(EstimateMemory, KnowsLimitsToTheDeviation) {
  for (int layers : {1, 3, 20})
    for (double ratio : {0.0, 0.1, 0.4}) {
      const Cube cube = plate(20, layers);
      const Context context = make_context();
      submit(context.get(), cube);
      ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
      ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_MAX_DEVIATION, 0.01), TETLOD_OK);
      expect_estimate(context.get(), std::to_string(layers) + " layers, ratio " + std::to_string(ratio));
    }
}

/// What a context keeps of earlier runs counts once, and shortens the next; the estimate does what that begins with.
TEST(EstimateMemory, OfALaterRunIsLessThanThreeTimesWhatItTakes) {
  Cube cube(32);
  for (double ratio : {0.0, 0.1, 0.5}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_rho(context.get(), 0.3), TETLOD_OK);
    ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, ratio), TETLOD_OK);
    for (int run = 0; run < 3; run++) {
      const std::string what = "ratio " + std::to_string(ratio) + ", run " + std::to_string(run);
      expect_estimate(context.get(), what, run == 0 ? 1.5 : 3);
      tetlod_run_report report = report_of(context.get());
      EXPECT_EQ(report.reused_tets, std::int64_t(cube.corners.size() / 4))
          << "the estimate's preparations are the run's";
      if (run > 0)
        for (double &value : cube.values) value = std::sin(3 * value);
    }
  }
}

/// To the byte, with one thread; further attempts are left out where they do not fit: of a run with a time limit there
/// are none.
TEST(EstimateMemory, ALimitOfThePeakIsEnoughAndOneByteLessIsNot) {
  const Cube cube(8);
  for (const auto &[preset, attempts] :
       {std::pair(TETLOD_PRESET_FAST, false), {TETLOD_PRESET_ACCURATE, false}, {TETLOD_PRESET_ACCURATE, true}}) {
    std::string said;
    const auto run_with = [&, preset = preset, attempts = attempts](std::uint64_t limit, std::uint64_t &peak) {
      tetlod_config config = default_config();
      config.memory_limit = limit;
      const Context context = make_context(config);
      submit(context.get(), cube);
      EXPECT_EQ(tetlod_set_preset(context.get(), preset), TETLOD_OK);
      EXPECT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_TIME_LIMIT, attempts ? 0 : 1000), TETLOD_OK);
      const auto log = [](void *to, std::int32_t, const char *message) { *static_cast<std::string *>(to) += message; };
      EXPECT_EQ(tetlod_set_log(context.get(), log, &said, 0), TETLOD_OK);
      const tetlod_status status = tetlod_run(context.get());
      if (status == TETLOD_OK) peak = report_of(context.get()).peak_bytes;
      return status;
    };
    std::uint64_t peak = 0, within = 0;
    ASSERT_EQ(run_with(0, peak), TETLOD_OK);
    EXPECT_EQ(run_with(peak, within), TETLOD_OK);
    EXPECT_EQ(within, peak);
    EXPECT_EQ(said, "");
    EXPECT_EQ(run_with(peak - 1, within), attempts ? TETLOD_OK : TETLOD_ERR_MEMORY_LIMIT) << said;
    EXPECT_EQ(said.find("left out") != said.npos, attempts) << preset << said;
    EXPECT_EQ(within < peak, attempts);
  }
}

}  // namespace
