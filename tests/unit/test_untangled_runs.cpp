// Meshes with tets that are turned over at the boundary: simplified like others, and what is told is true at the places
// that were submitted.
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

TEST_F(UntangledRuns, ErrorsAreThoseAtTheSubmittedPlaces) {
  const Mesh original = tangled(a_little);
  for (const double ratio : {1.0, 0.3, 0.1}) {
    options.target_ratio = ratio;
    simplify(original);
    const double error = brute_largest_error(original, mesh());
    EXPECT_NEAR(report().max_error, error, 1e-6);
    EXPECT_NEAR(measure_error(input_of(original), options, mesh(), 0, host.job).max, error, 1e-12);
  }
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
