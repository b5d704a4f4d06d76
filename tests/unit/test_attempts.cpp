// Further attempts of small meshes: how many there are, what the best is, and that it is better than the first.
#include "attempts.hpp"
#include "beginning.hpp"
#include "decimate_solid_and_check.hpp"
#include "surface_distance.hpp"
#include "weigh_planes.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

Report report_of(std::int64_t tets) {
  Report report;
  report.tets_in = tets;
  return report;
}

std::size_t attempts(std::int64_t tets, const Options &options) {
  Budget budget;
  budget.tets = std::int64_t(options.target_ratio * double(tets));
  return weights_of_attempts(budget, options, report_of(tets)).size();
}

TEST(Attempts, AreMadeOfSmallMeshesForAccuracyAlone) {
  Options options;
  options.target_ratio = 0.1;
  EXPECT_EQ(attempts(10, options), 6U);
  EXPECT_EQ(attempts(10000, options), 3U);
  EXPECT_EQ(attempts(30000, options), 1U);
  EXPECT_EQ(attempts(30001, options), 0U);
  options.target_ratio = 1;
  EXPECT_EQ(attempts(10, options), 0U);
  options.target_ratio = 0.1;
  Options fast = options, bound = options, limited = options, warm = options;
  fast.effort = effort_fast;
  bound.max_error = 0.1;
  limited.time_limit = 1e9;
  warm.warm_start = 0.1;
  for (const Options &other : {fast, bound, limited, warm}) EXPECT_EQ(attempts(10, other), 0U);
}

TEST(Attempts, TheBestHasTheLeastOfAll) {
  Host host;
  RefineReport usual(host.memory);
  usual.mean_square = 0.01;
  usual.outside = 0.2;
  Report report;
  report.max_deviation = 0.01;
  const double score = score_of(usual, 1, report);
  RefineReport other = copy_of(usual, host);
  other.mean_square *= 0.9;
  EXPECT_LT(score_of(other, 1, report), score);
  other = usual;
  other.outside *= 0.9;
  EXPECT_LT(score_of(other, 1, report), score);
  report.max_deviation *= 0.9;
  EXPECT_LT(score_of(usual, 1, report), score);
}

TEST(Attempts, ErrorsThatAreNextToNoneCountLessThanTheBoundary) {
  Host host;
  RefineReport usual(host.memory);
  usual.mean_square = 1e-10;
  usual.outside = 0.2;
  RefineReport other = copy_of(usual, host);
  other.mean_square /= 4;
  other.outside *= 1.3;
  EXPECT_GT(score_of(other, 1, Report()), score_of(usual, 1, Report()));
}

TEST(Attempts, CountErrorsAsPartsOfTheRange) {
  Host host;
  RefineReport refined(host.memory), in_another_unit(host.memory);
  refined.mean_square = 1e-8;
  in_another_unit.mean_square = 1e-8 * 1024 * 1024;
  EXPECT_EQ(score_of(in_another_unit, 2048, Report()), score_of(refined, 2, Report()));
  RefineReport constant(host.memory);
  EXPECT_LT(score_of(constant, 0, Report()), score_of(refined, 2, Report()));
}

/// What a run would give without further attempts.
class FirstAttempt : public Beginning {
 public:
  using Beginning::Beginning;
  void run() {
    begin();
    const CollapseSizes sizes = collapse_sizes(budget_, options_, report_);
    SolidOptions solid;
    solid.tets = sizes.tets;
    solid.planes = planes_at_size(options_.target_ratio);
    SolidHistory none(job_.memory);
    const Surface &surface = prepared_.surface(job_);
    TreeOnDemand tree(surface);
    const OriginalSolid original{original_.view,           boundary_, surface,
                                 prepared_.topology(job_), tree,      prepared_.contacts()};
    TetMesh mesh = decimate_solid_and_check(original, solid, sizes.lowered, none, job_).mesh;
    RefineOptions refining;
    refining.tets = budget_.tets;
    refining.before_lowering = tets_before_lowering(budget_, options_, report_, true, mesh.tets.size());
    refining.rounds = rounds_of(options_, report_);
    refining.boundary = &tree;
    refine(original_.view, refining, job_, mesh);
    result_.mesh = std::move(mesh);
  }
};

class Attempted : public WholeRun {
 protected:
  void simplify_once(const Mesh &original) {
    Prepared prepared(host.memory);
    result = Result(host.memory);
    const Input input = input_of(original);
    FirstAttempt(input, options, prepared, host.job, result).run();
  }
  double rms(const Mesh &original) { return measure_error(input_of(original), options, result, 1, host.job).rms; }
};

/// Where walls bend: plane ones stay what they are, whatever they weigh.
TEST_F(Attempted, IsMoreAccurateThanTheFirst) {
  const std::vector<int> cells{6, 7, 8, 9, 10};
  const std::vector<double> ratios{0.3, 0.1, 0.05};
  double better = 0;
  for (int n : cells) {
    Mesh original = kuhn_cube(n);
    transform(original,
              [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(5 * p.y), std::sin(4 * p.z), std::sin(3 * p.x)); });
    set_scalars(original, waves);
    for (double ratio : ratios) {
      options.target_ratio = ratio;
      simplify_once(original);
      const double first = rms(original), size = double(mesh().tets.size());
      simplify(original);
      expect_sound(original, 0.02);
      EXPECT_NEAR(double(mesh().tets.size()), size, 1 + 0.015 * size) << n << ' ' << ratio;
      better += std::log(rms(original) / first);
    }
  }
  EXPECT_LT(better / double(cells.size() * ratios.size()), std::log(0.97));
}

/// By a power of two, which rounds nothing.
TEST_F(Attempted, IsTheSameInAnotherUnitOfTheValues) {
  Mesh original = kuhn_cube(8);
  transform(original,
            [](const Vec3 &p) { return p + 0.04 * glm::sin(Vec3(6 * p.y + 4 * p.z, 6 * p.x, 4 * p.x + 8 * p.y)); });
  options.target_ratio = 0.1;
  Mesh first;
  for (const double unit : {1.0, 0x1p-12, 0x1p12}) {
    set_scalars(original, [unit](const Vec3 &p) { return unit * std::sin(2.4 * p.x); });
    simplify(original);
    Mesh other = copy_of_result();
    for (double &value : other.scalars) value /= unit;
    if (unit == 1) first = other;
    EXPECT_EQ(other.points, first.points) << unit;
    EXPECT_EQ(other.tets, first.tets) << unit;
    EXPECT_EQ(other.scalars, first.scalars) << unit;
  }
}

}  // namespace
}  // namespace tetlod
