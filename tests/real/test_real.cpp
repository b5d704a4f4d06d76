// The real data sets with the paper's four pairs of boundary and clustering: every result valid, of the original's
// topology, and as large as it was.
#include <gtest/gtest.h>
#include <tetlod.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "checks.hpp"
#include "vtu_file.hpp"

namespace real_test {
namespace {

std::string data_folder() {
  if (const char *named = std::getenv("TETLOD_DATA_DIR")) return named;
  return (std::filesystem::path(TETLOD_SOURCE_DIR).parent_path() / "shared" / "data").string();
}

bool is_there(const std::string &set) { return std::filesystem::exists(data_folder() + "/" + set + ".vtu"); }

#define SKIP_WITHOUT(set)                                                                                         \
  if (!is_there(set))                                                                                             \
  GTEST_SKIP() << "the data set " << (set) << ".vtu is not in " << data_folder() << "; the environment variable " \
               << "TETLOD_DATA_DIR names the folder that has it"

/// A set as it is and as its result is compared with, read once.
struct Original {
  TetFile submitted;
  Facts facts;  // of the repaired one
};

const Original &original(const std::string &set) {
  static std::map<std::string, Original> read;
  const auto [found, is_new] = read.try_emplace(set);
  if (is_new) {
    found->second.submitted = read_vtu(data_folder() + "/" + set + ".vtu");
    found->second.facts = facts_of(repaired(found->second.submitted));
  }
  return found->second;
}

template <class T>
tetlod_array packed(const T *data, std::size_t tuples, int components, int type) {
  tetlod_array array = {};
  array.struct_size = sizeof array;
  array.type = type;
  array.tuples = std::int64_t(tuples);
  array.components = components;
  array.data = const_cast<T *>(data);
  return array;
}

class Simplifier {
 public:
  explicit Simplifier(const TetFile &mesh) {
    tetlod_context *made = nullptr;
    EXPECT_EQ(tetlod_create(nullptr, &made), TETLOD_OK);
    context_.reset(made);
    const tetlod_array points = packed(mesh.points.data(), mesh.points.size(), 3, TETLOD_FLOAT64);
    const tetlod_array tets = packed(mesh.tets.data(), mesh.tets.size(), 4, TETLOD_INT32);
    const tetlod_array scalars = packed(mesh.scalars.data(), mesh.scalars.size(), 1, TETLOD_FLOAT64);
    EXPECT_EQ(tetlod_set_preset(made, TETLOD_PRESET_PAPER), TETLOD_OK);
    EXPECT_EQ(tetlod_submit_points(made, &points), TETLOD_OK);
    EXPECT_EQ(tetlod_submit_tets(made, &tets, 0), TETLOD_OK);
    EXPECT_EQ(tetlod_submit_scalars(made, "scalar", &scalars), TETLOD_OK);
  }

  void threads(int count) { EXPECT_EQ(tetlod_set_int(context_.get(), TETLOD_OPT_THREADS, count), TETLOD_OK); }

  bool run(double sigma, double rho) {
    EXPECT_EQ(tetlod_set_sigma(context_.get(), sigma), TETLOD_OK);
    EXPECT_EQ(tetlod_set_rho(context_.get(), rho), TETLOD_OK);
    return run();
  }

  bool run_within(double bound) {
    EXPECT_EQ(tetlod_set_preset(context_.get(), TETLOD_PRESET_ACCURATE), TETLOD_OK);
    EXPECT_EQ(tetlod_set_real(context_.get(), TETLOD_OPT_TARGET_RATIO, 0), TETLOD_OK);
    EXPECT_EQ(tetlod_set_real(context_.get(), TETLOD_OPT_MAX_ERROR, bound), TETLOD_OK);
    return run();
  }

  TetFile result() const {
    std::int64_t points, tets;
    EXPECT_EQ(tetlod_fetch_counts(context_.get(), &points, &tets, nullptr), TETLOD_OK);
    TetFile mesh;
    mesh.points.resize(std::size_t(points));
    mesh.scalars.resize(std::size_t(points));
    mesh.tets.resize(std::size_t(tets));
    tetlod_array xyz = packed(mesh.points.data(), mesh.points.size(), 3, TETLOD_FLOAT64);
    tetlod_array corners = packed(mesh.tets.data(), mesh.tets.size(), 4, TETLOD_INT32);
    tetlod_array values = packed(mesh.scalars.data(), mesh.scalars.size(), 1, TETLOD_FLOAT64);
    EXPECT_EQ(tetlod_fetch_points(context_.get(), &xyz), TETLOD_OK);
    EXPECT_EQ(tetlod_fetch_tets(context_.get(), 0, &corners), TETLOD_OK);
    EXPECT_EQ(tetlod_fetch_scalars(context_.get(), &values), TETLOD_OK);
    return mesh;
  }

  tetlod_run_report report() const {
    tetlod_run_report report = {};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_fetch_report(context_.get(), &report), TETLOD_OK);
    return report;
  }

 private:
  bool run() {
    const tetlod_status status = tetlod_run(context_.get());
    char message[1000] = "";
    if (status != TETLOD_OK) tetlod_last_message(context_.get(), message, sizeof message);
    EXPECT_EQ(status, TETLOD_OK) << message;
    return status == TETLOD_OK;
  }

  struct Destroy {
    void operator()(tetlod_context *context) const { tetlod_destroy(context); }
  };
  std::unique_ptr<tetlod_context, Destroy> context_;
};

void expect_valid(const TetFile &result, const Facts &is, const Facts &was) {
  EXPECT_EQ(is.not_positive, 0);
  EXPECT_EQ(is.over_shared, 0);
  EXPECT_EQ(is.folded, 0);
  EXPECT_EQ(is.open_edges, 0);
  EXPECT_EQ(is.unused, 0);
  EXPECT_LE(is.nonmanifold_edges, was.nonmanifold_edges);
  EXPECT_NEAR(is.boundary_volume, is.volume, 1e-9 * is.volume) << "tets overlap, or a hole is hidden";
  for (double s : result.scalars) ASSERT_TRUE(std::isfinite(s));
  for (const Point &p : result.points) ASSERT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
}

void expect_like(const TetFile &result, const Original &was) {
  const Facts is = facts_of(result);
  expect_valid(result, is, was.facts);
  EXPECT_EQ(is.components, was.facts.components);
  EXPECT_EQ(is.euler, was.facts.euler);
  const double volume_error = was.submitted.tets.size() < 10000 ? 0.05 : 0.01;
  EXPECT_NEAR(is.volume / was.facts.volume, 1, volume_error);
  const auto [low, high] = std::minmax_element(was.submitted.scalars.begin(), was.submitted.scalars.end());
  for (std::size_t i = 0; i < result.scalars.size(); i++)
    ASSERT_TRUE(result.scalars[i] >= *low && result.scalars[i] <= *high)
        << "the value of point " << i << " is beyond the original's range by "
        << std::max(*low - result.scalars[i], result.scalars[i] - *high);
}

struct Pair {
  double sigma, rho;
};
constexpr Pair pairs_of_the_paper[] = {{0.1, 0.01}, {0.05, 0.01}, {0.05, 0.1}, {0.1, 0.005}};

class RealSet : public testing::TestWithParam<const char *> {};

TEST_P(RealSet, KeepsTopologyAndVolume) {
  SKIP_WITHOUT(GetParam());
  const Original &set = original(GetParam());
  Simplifier simplifier(set.submitted);
  for (const Pair &pair : pairs_of_the_paper) {
    SCOPED_TRACE("sigma " + std::to_string(pair.sigma) + " rho " + std::to_string(pair.rho));
    if (!simplifier.run(pair.sigma, pair.rho)) continue;
    const TetFile result = simplifier.result();
    expect_like(result, set);
    EXPECT_LT(result.tets.size(), set.submitted.tets.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Data, RealSet,
                         testing::Values("bluntfin", "bluntfin_raw", "comb", "spx", "spx_raw", "bracket",
                                         "disk_out_ref", "fire", "lv_active", "cube_sphere_void", "cut_cylinder"),
                         [](const auto &info) { return std::string(info.param); });

TEST(LargeSet, KeepsTopologyAndVolume) {
  SKIP_WITHOUT("bluntfin_x8");
  const Original &set = original("bluntfin_x8");
  Simplifier simplifier(set.submitted);
  if (simplifier.run(0.05, 0.01)) expect_like(simplifier.result(), set);
}

/// One vertex just beyond a corner of the coarse boundary, which has another's value, took it four times as many tets.
TEST(LargeSet, RestoresTheVerticesThatABoundNeeds) {
  SKIP_WITHOUT("bluntfin_x8");
  const Original &set = original("bluntfin_x8");
  Simplifier simplifier(set.submitted);
  if (!simplifier.run_within(0.01)) return;
  expect_like(simplifier.result(), set);
  EXPECT_LE(simplifier.report().max_error, 0.01);
  EXPECT_LT(double(simplifier.report().tets_out), 0.04 * double(set.submitted.tets.size()));
}

/// What the data's own description says of them, so that what results are compared with is right.
TEST(Reader, FindsWhatIsDescribed) {
  SKIP_WITHOUT("bluntfin_raw");
  const TetFile raw = read_vtu(data_folder() + "/bluntfin_raw.vtu");
  EXPECT_EQ(raw.points.size(), 40960u);
  EXPECT_EQ(raw.tets.size(), 187395u);
  EXPECT_EQ(repaired(raw).tets.size(), 187395u - 77);
  SKIP_WITHOUT("bluntfin");
  const Facts facts = original("bluntfin").facts;
  EXPECT_EQ(facts.boundary_triangles, 13438);
  EXPECT_EQ(facts.euler, 2);
  EXPECT_EQ(facts.components, 1);
  EXPECT_EQ(facts.open_edges, 0);
  SKIP_WITHOUT("cut_cylinder");
  EXPECT_EQ(original("cut_cylinder").facts.components, 2);
  SKIP_WITHOUT("cube_sphere_void");
  EXPECT_EQ(original("cube_sphere_void").facts.euler, 4);
  EXPECT_EQ(original("cube_sphere_void").facts.boundary_triangles, 1224);
}

TEST(Reader, RefusesOtherFiles) { EXPECT_THROW(read_vtu(TETLOD_SOURCE_DIR "/CMakeLists.txt"), std::runtime_error); }

/// At most 9 % of the blunt fin's tets, with the paper's lambda and min-distance.
TEST(BluntFin, AtNinePercent) {
  SKIP_WITHOUT("bluntfin");
  const Original &set = original("bluntfin");
  Simplifier simplifier(set.submitted);
  ASSERT_TRUE(simplifier.run(0.3, 0.06));
  const TetFile result = simplifier.result();
  EXPECT_LE(double(result.tets.size()), 0.09 * double(set.submitted.tets.size()));
  expect_like(result, set);
  EXPECT_EQ(facts_of(result).euler, 2);
  EXPECT_EQ(facts_of(result).components, 1);
  EXPECT_NEAR(facts_of(result).volume / set.facts.volume, 1, 0.005);
  EXPECT_LE(field_error(set.submitted, result).outside, 0.1);
}

/// Table 1 has an error of 1.86 % there, which no pair of parameters reaches with samples 1 % of the diagonal away from
/// the boundary: most of the field's variation lies nearer (PAPER.md). What is held is twice that.
TEST(BluntFin, ErrorAtNinePercentIsWithinTwiceThePapers) {
  SKIP_WITHOUT("bluntfin");
  const Original &set = original("bluntfin");
  Simplifier simplifier(set.submitted);
  double least = 1;
  for (const Pair &pair : {Pair{0.1, 0.036}, Pair{0.2, 0.046}, Pair{0.3, 0.06}, Pair{0.4, 0.08}, Pair{0.5, 0.1}}) {
    ASSERT_TRUE(simplifier.run(pair.sigma, pair.rho));
    const TetFile result = simplifier.result();
    if (double(result.tets.size()) > 0.09 * double(set.submitted.tets.size())) continue;
    const FieldError error = field_error(set.submitted, result);
    if (error.outside <= 0.1) least = std::min(least, error.rms);
  }
  EXPECT_LE(least, 2 * 0.0186);
}

TEST(BluntFin, ThreadsGiveTheSameBytes) {
  SKIP_WITHOUT("bluntfin_raw");
  const Original &set = original("bluntfin_raw");
  std::uint64_t hash = 0;
  for (int threads : {1, 2, 1}) {
    Simplifier simplifier(set.submitted);
    simplifier.threads(threads);
    if (!simplifier.run(0.1, 0.01)) return;
    const tetlod_run_report report = simplifier.report();
    EXPECT_TRUE(hash == 0 || hash == report.hash) << threads << " threads";
    hash = report.hash;
  }
}

/// What was repaired is told: the figures are those of the data's description.
TEST(BluntFin, RepairsAreCounted) {
  SKIP_WITHOUT("bluntfin_raw");
  Simplifier simplifier(original("bluntfin_raw").submitted);
  if (!simplifier.run(0.05, 0.1)) return;
  const tetlod_run_report report = simplifier.report();
  EXPECT_EQ(report.merged_points, 39);
  EXPECT_EQ(report.dropped_tets, 77);
  EXPECT_EQ(report.points_in, 40960);
  EXPECT_EQ(report.tets_in, 187395);
  EXPECT_EQ(report.boundary_triangles_in, 13438);
}

}  // namespace
}  // namespace real_test
