// Meshes with tets that are turned over: simplified like others, and what is told is true at the places that were
// submitted.
#include <random>

#include "carry_fields.hpp"
#include "validate.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class UntangledRuns : public WholeRun {
 protected:
  static constexpr int cells = 8;

  /// A vertex of the top has gone through the layer below, so far, and one inside through a side.
  static Mesh tangled(double beyond) {
    Mesh cube = kuhn_cube(cells);
    set_scalars(cube, waves);
    for (Vec3 &p : cube.points) {
      if (glm::distance(p, Vec3(0.5, 0.5, 1)) < 1e-9) p.z -= 1.0 / cells + beyond;
      if (glm::distance(p, Vec3(0.5, 1.0 / cells, 0.5)) < 1e-9) p.y -= 1.0 / cells + beyond;
    }
    return cube;
  }
  static constexpr double a_little = 0.01;

  /// The vertices inside went astray.
  static Mesh tangled_inside() {
    Mesh cube = kuhn_cube(cells);
    set_scalars(cube, waves);
    std::mt19937 random(1);
    std::normal_distribution<double> stray(0, 0.2 / cells);
    for (Vec3 &p : cube.points)
      if (std::min({p.x, p.y, p.z}) > 0.01 && std::max({p.x, p.y, p.z}) < 0.99)
        p += Vec3(stray(random), stray(random), stray(random));
    return cube;
  }

  Status verdict(const Mesh &original) {
    const Input input = input_of(original);
    return verdict_on(input, options, find_defects(input, options, host.job), host.job).status();
  }
};

TEST_F(UntangledRuns, AreSoundInEachWay) {
  const Mesh original = tangled(a_little);
  for (const double ratio : {0.5, 0.1, 0.0}) {
    options = Options();
    options.target_ratio = ratio;
    options.sigma = 0.5;
    for (const std::int64_t effort : {effort_fast, effort_accurate}) {
      options.effort = effort;
      simplify(original);
      EXPECT_GE(report().moved_points, 2);
      expect_sound(original, 0.05);
    }
  }
}

/// Collapses alone lead to each size, and the boundary of the whole mesh is the one that was submitted.
TEST_F(UntangledRuns, AreSoundWhereTheyWereTurnedOverInside) {
  const Mesh original = tangled_inside();
  options.remesh = false;
  for (const double ratio : {1.0, 0.7, 0.5, 0.1}) {
    options.target_ratio = ratio;
    simplify(original);
    EXPECT_GT(report().moved_points, 0);
    EXPECT_NEAR(double(report().tets_out), ratio * double(report().tets_in), 0.03 * ratio * double(report().tets_in));
    expect_sound(original, 0.05);
    EXPECT_NEAR(report().max_error, brute_largest_error(original, mesh()), 1e-6);
    if (ratio == 1) {
      EXPECT_LT(report().max_deviation, 1e-15);
    }
  }
}

TEST_F(UntangledRuns, ErrorsAreThoseAtTheSubmittedPlaces) {
  const Mesh original = tangled(a_little);
  for (const double ratio : {1.0, 0.3, 0.1}) {
    options.target_ratio = ratio;
    simplify(original);
    const double error = brute_largest_error(original, mesh());
    EXPECT_NEAR(report().max_error, error, 1e-6);
    EXPECT_NEAR(measure_error(input_of(original), options, result, 0, host.job).max, error, 1e-12);
  }
}

/// A flagged vertex stays, and tets turned over with it: what errors are measured of is what the run had.
TEST_F(UntangledRuns, ErrorsInsideAreThoseOfTheMeshThatFlagsLeave) {
  Mesh original = kuhn_cube(8);
  const auto middle = std::find(original.points.begin(), original.points.end(), Vec3(0.5));
  *middle += Vec3(0.1625, 0.00625, 0);
  set_scalars(original, [](const Vec3 &p) { return p.x + 0.5 * p.y - 0.25 * p.z; });
  std::vector<std::uint8_t> flags(original.points.size(), 0);
  flags[std::size_t(middle - original.points.begin())] = keep_vertex;
  Input input = input_of(original);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  options.target_ratio = 1;
  run(input, options, worker, host.job, result);
  EXPECT_EQ(report().moved_points, 0);
  EXPECT_LT(measure_error(input_of(original), options, result, 2, host.job).max_inner, 1e-12);
}

TEST_F(UntangledRuns, ABoundHoldsAtTheSubmittedPlaces) {
  const Mesh original = tangled(a_little);
  for (const double bound : {0.05, 0.005}) {
    options.max_error = bound;
    simplify(original);
    EXPECT_LE(brute_largest_error(original, mesh()), bound);
    EXPECT_LT(report().tets_out, report().tets_in);
  }
}

/// Of the submitted boundary from the result's; the other way round it is measured as for others.
TEST_F(UntangledRuns, TheDeviationHasTheMovesInIt) {
  const Mesh original = tangled(a_little);
  options.target_ratio = 0.2;
  const double diagonal = box_of(original.view().points).diagonal();
  for (const double limit : {0.0, 0.03}) {
    options.max_deviation = limit;
    simplify(original);
    double farthest = 0;
    for (const Triangle &t : brute_boundary(original))
      for (const std::int32_t v : t)
        farthest =
            std::max(farthest, brute_nearest(mesh().points, mesh().boundary, original.points[std::size_t(v)]).distance);
    EXPECT_GE(report().max_deviation * diagonal, 0.99 * farthest);
    EXPECT_LE(report().max_deviation, limit > 0 ? limit + 1e-9 : 1);
  }
  options.max_deviation = 1e-4;  // the moves alone are more
  EXPECT_EQ(status(original), Status::mesh_intersecting);
  EXPECT_EQ(verdict(original), Status::mesh_intersecting);
  options.max_deviation = 0.03;
  EXPECT_EQ(verdict(original), Status::ok);
}

TEST_F(UntangledRuns, AreRefusedWhereTheyGoTooFar) { EXPECT_EQ(status(tangled(0.4)), Status::mesh_intersecting); }

/// As a run of its own would do it, with arrays somewhere else.
TEST_F(UntangledRuns, ALaterStepTakesTheMovesOver) {
  Prepared prepared(host.memory);
  options.target_ratio = 0.3;
  for (const double shift : {0.0, 1.0}) {
    Mesh step = tangled(a_little);
    for (double &value : step.scalars) value = value * value + shift * value;
    Result again(host.memory);
    run(input_of(step), options, worker, prepared, host.job, again);
    EXPECT_EQ(again.report.reused_tets, shift == 0 ? 0 : again.report.tets_in);
    EXPECT_GE(again.report.moved_points, 2);
    simplify(step);
    EXPECT_EQ(again.report.hash, report().hash);
    EXPECT_EQ(again.report.max_error, report().max_error);
  }
}

/// Which moves are made depends on flags, and a stencil is of those that the run made.
TEST_F(UntangledRuns, AStencilIsThatOfTheRun) {
  const Mesh original = tangled(a_little);
  options.target_ratio = 0.3;
  std::vector<std::uint8_t> flags(original.points.size(), 0), others = flags;
  for (std::size_t v = 0; v < flags.size(); v++) flags[v] = original.points[v].y < 0 ? keep_vertex : 0;
  Input input = input_of(original);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  Input with_field = input;
  with_field.fields.push_back({"field", Association::point, input.scalars});
  run(with_field, options, worker, host.job, result);
  const Stencil stencil = std::move(result.stencil);
  for (const std::vector<std::uint8_t> &later : {flags, others}) {
    input.flags = strided(later.data(), later.size(), 1, 1, ElementType::uint8);
    for (const bool is_prepared : {false, true}) {
      Prepared prepared(host.memory);
      if (is_prepared) estimate_memory(input, options, prepared, host.job);
      result.stencil = Stencil(host.memory);
      find_stencil(input, options, prepared, host.job, result);
      EXPECT_EQ(result.stencil.ids, stencil.ids);
      EXPECT_EQ(result.stencil.weights, stencil.weights);
    }
  }
}

TEST_F(UntangledRuns, MemoryIsEstimatedLikeThatOfOthers) {
  const Mesh original = tangled(a_little);
  for (const double ratio : {1.0, 0.3}) {
    options.target_ratio = ratio;
    Prepared prepared(host.memory);
    const auto estimate = double(estimate_memory(input_of(original), options, prepared, host.job));
    prepared.forget(host.memory);
    result = Result(host.memory);
    host.memory.reset_peak();
    run(input_of(original), options, worker, prepared, host.job, result);
    EXPECT_LE(double(report().peak_bytes), 1.5 * estimate);
    EXPECT_LE(estimate, 1.5 * double(report().peak_bytes));
  }
}

/// Two defects, each of which would hide the other.
TEST_F(UntangledRuns, MeshesThatDoNotConformAreDividedToo) {
  Mesh original = refined_cubes(4, [](const Cell &cell) { return cell == Cell{0, 0, 0} ? 1 : 0; });
  set_scalars(original, waves);
  for (Vec3 &p : original.points)
    if (glm::distance(p, Vec3(0.5, 0.5, 1)) < 1e-9) p.z -= 0.25 + a_little;
  for (const double ratio : {0.5, 0.2}) {
    options.target_ratio = ratio;
    simplify(original);
    EXPECT_GT(report().moved_points, 0);
    EXPECT_GT(report().divided_tets, 0);
    EXPECT_EQ(report().components, 1);
    EXPECT_EQ(facts_of(mesh().boundary).euler, 2);
  }
}

TEST_F(UntangledRuns, AHostIsTold) {
  std::string said;
  host.job.log = [&](int level, const char *message) {
    if (level == 2) said += message;
  };
  options.target_ratio = 0.3;
  simplify(tangled(a_little));
  EXPECT_NE(said.find("points are moved"), std::string::npos) << said;
}

}  // namespace
}  // namespace tetlod
