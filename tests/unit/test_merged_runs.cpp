// Cells with points of their own, as discontinuous methods have them: what is told, and bounded, is true of each one's
// values.
#include <random>
#include <set>

#include "carry_fields.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

constexpr double jump = 0.02;  // at most, where cells meet

class MergedRuns : public WholeRun {
 protected:
  static Mesh jumping(unsigned seed) {
    Mesh cube = kuhn_cube(6);
    set_scalars(cube, waves);
    Mesh mesh = with_points_of_their_own(cube);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.5 * jump, 0.5 * jump);
    for (double &value : mesh.scalars) value += noise(random);
    return mesh;
  }

  static double range_of(const Mesh &mesh) {
    const auto [low, high] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
    return *high - *low;
  }
};

TEST_F(MergedRuns, TheLargestErrorIsNoLessThanThatOfEachPoint) {
  const Mesh original = jumping(1);
  for (const std::int64_t effort : {effort_fast, effort_accurate}) {
    options.effort = effort;
    options.target_ratio = 0.3;
    simplify(original);
    const double error = brute_largest_error(original, mesh());
    EXPECT_GE(report().max_error, error);
    EXPECT_LE(report().max_error, error + 0.5 * jump / range_of(original));
    EXPECT_NEAR(measure_error(input_of(original), options, result, 0, host.job).max, error, 1e-12);
  }
}

TEST_F(MergedRuns, ABoundHoldsForEach) {
  for (const unsigned seed : {2u, 3u}) {
    const Mesh original = jumping(seed);
    for (const double bound : {0.1, 0.01}) {
      options.max_error = bound;
      simplify(original);
      EXPECT_LE(report().max_error, bound);
      EXPECT_LE(brute_largest_error(original, mesh()), bound);
      EXPECT_LT(report().tets_out, report().tets_in);
    }
  }
}

/// Two values at one place that are farther apart than twice the bound.
TEST_F(MergedRuns, ABoundThatNoValueHoldsIsRefused) {
  Mesh original = jumping(4);
  const auto other = std::find(original.points.begin() + 1, original.points.end(), original.points[0]);
  ASSERT_NE(other, original.points.end());
  const auto second = std::size_t(other - original.points.begin());
  original.scalars[second] = original.scalars[0] + 2 * jump;
  options.max_error = 0.9 * jump / range_of(original);
  try {
    simplify(original);
    FAIL() << "no value is so near to both";
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::max_error);
    EXPECT_NE(std::string(error.what()).find(" and " + std::to_string(second) + " "), std::string::npos)
        << error.what();
  }
}

/// As a run of its own would do it.
TEST_F(MergedRuns, ALaterStepHasItsOwn) {
  Prepared prepared(host.memory);
  options.target_ratio = 0.3;
  for (const unsigned seed : {5u, 6u}) {
    const Mesh step = jumping(seed);
    Result again(host.memory);
    run(input_of(step), options, worker, prepared, host.job, again);
    EXPECT_EQ(again.report.reused_tets, seed == 5 ? 0 : again.report.tets_in);
    simplify(step);
    EXPECT_EQ(again.report.hash, report().hash);
    EXPECT_EQ(again.report.max_error, report().max_error);
  }
}

/// Where a neighbour's result is to fit bit for bit, coordinates that rounding made others of count as they are.
TEST_F(MergedRuns, AFlaggedPointKeepsItsOwnPlace) {
  Mesh cube = kuhn_cube(6);
  set_scalars(cube, waves);
  Mesh original = with_points_of_their_own(cube);
  std::vector<std::uint8_t> flags(original.points.size(), 0);
  std::set<std::array<double, 3>> seen, places;
  const auto numbers = [](const Vec3 &p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  for (std::size_t v = 0; v < flags.size(); v++) {
    Vec3 &p = original.points[v];
    if (p.x != 1 || seen.insert(numbers(p)).second) continue;  // the first one there is not flagged
    p.x = std::nextafter(1, 2);
    flags[v] = lock_vertex;
    places.insert(numbers(p));
  }
  ASSERT_EQ(places.size(), seen.size());
  Input input = input_of(original);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  Input with_field = input;
  with_field.fields.push_back({"field", Association::point, input.scalars});
  for (const double ratio : {1.0, 0.2, 0.0}) {
    options = Options();
    options.target_ratio = ratio;
    result = Result(host.memory);
    run(with_field, options, worker, host.job, result);
    std::set<std::array<double, 3>> missing = places;
    for (const Vec3 &p : mesh().points) missing.erase(numbers(p));
    EXPECT_TRUE(missing.empty()) << missing.size() << " to " << ratio;
    const Stencil stencil = std::move(result.stencil);  // flags may be others by the time that one is asked for
    result.stencil = Stencil(host.memory);
    Prepared prepared(host.memory);
    find_stencil(input_of(original), options, prepared, host.job, result);
    EXPECT_EQ(result.stencil.ids, stencil.ids);
    EXPECT_EQ(result.stencil.weights, stencil.weights);
  }
}

/// Inside the tets the result is compared with what the run took: the flagged values, whatever is submitted later.
TEST_F(MergedRuns, ErrorsInsideAreThoseOfTheFlaggedValues) {
  const Mesh original = jumping(8);
  std::vector<std::uint8_t> flags(original.points.size(), 0);
  for (std::size_t v = 0; v < flags.size(); v += 5) flags[v] = keep_vertex;
  Input input = input_of(original);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  options.target_ratio = 1;
  run(input, options, worker, host.job, result);
  ASSERT_EQ(report().tets_out, report().tets_in);
  EXPECT_LT(measure_error(input_of(original), options, result, 2, host.job).max_inner, 1e-12);
}

}  // namespace
}  // namespace tetlod
