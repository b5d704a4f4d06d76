// Runs with a target size: met, sound, and better than the paper's own way.
#include <unistd.h>

#include <cstdlib>
#include <limits>

#include "decimate_solid_and_check.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Runs with a target size.
class TargetedRun : public WholeRun {
 protected:
  double rms(const Mesh &original) { return measure_error(input_of(original), options, result, 1, host.job).rms; }

  /// A small mesh is remeshed only where edges are to be cleaned.
  void sample_fast() {
    options.effort = effort_fast;
    options.clean_edges = 1e-15;
  }
  void collapse(std::int64_t effort) {
    options.effort = effort;
    options.clean_edges = 0;
  }

  void expect_size(const Mesh &original) {
    EXPECT_NEAR(double(report().tets_out) / (options.target_ratio * double(original.tets.size())), 1, 0.03);
  }

  void expect_sizes(const Mesh &original, std::initializer_list<double> ratios, double volume_error,
                    double largest_rms = std::numeric_limits<double>::infinity()) {
    for (double ratio : ratios) {
      options.target_ratio = ratio;
      simplify(original);
      expect_sound(original, volume_error);
      expect_size(original);
      EXPECT_LT(rms(original), largest_rms) << ratio;
    }
  }

  void expect_accurate(const Mesh &original, std::initializer_list<double> ratios, double volume_error,
                       double largest_rms) {
    for (std::int64_t effort : {effort_fast, effort_accurate}) {
      collapse(effort);
      expect_sizes(original, ratios, volume_error, largest_rms);
    }
  }
};

TEST_F(TargetedRun, MeetsItsSizeAndBeatsTheFasterWay) {
  Mesh original = kuhn_cube(18);
  set_scalars(original, [](const Vec3 &p) { return std::sin(7 * p.x) * std::cos(5 * p.y) * std::sin(4 * p.z); });
  for (double ratio : {0.5, 0.2, 0.1, 0.05}) {
    options.target_ratio = ratio;
    const auto rms_of_run = [&] {
      simplify(original);
      expect_sound(original, 1e-3);
      expect_size(original);
      return rms(original);
    };
    sample_fast();
    const double sampled = rms_of_run();
    collapse(effort_fast);
    const double fast = rms_of_run();
    collapse(effort_accurate);
    EXPECT_LT(rms_of_run(), (ratio < 0.5 ? 0.9 : 0.96) * fast) << ratio;
    EXPECT_LT(fast, sampled) << ratio;
  }
}

TEST_F(TargetedRun, BeatsThePaperAtItsSize) {
  Mesh original = kuhn_cube(16);
  set_scalars(original, waves);
  options.sigma = 0.3;
  options.rho = 0.2;
  simplify(original);
  const double published = rms(original);
  options.target_ratio = double(report().tets_out) / double(original.tets.size());
  for (bool samples : {true, false}) {
    samples ? sample_fast() : collapse(effort_accurate);
    simplify(original);
    EXPECT_LT(rms(original), published);
  }
}

/// Nearly, where an edge of the cube is rounded off: its vertices may not leave the range of the values around.
TEST_F(TargetedRun, ALinearFieldStaysLinear) {
  Mesh original = kuhn_cube(12);
  set_scalars(original, linear);
  const auto simplify_to = [&](double ratio) {
    options.target_ratio = ratio;
    simplify(original);
    expect_sound(original, 1e-3);
    return measure_error(input_of(original), options, result, 2, host.job);
  };
  for (double ratio : {0.5, 0.1}) {
    for (auto effort : {effort_fast, effort_accurate}) {
      collapse(effort);
      const FieldError e = simplify_to(ratio);
      EXPECT_LT(std::max(e.max, e.max_inner), 1e-9) << ratio;
    }
  }
  sample_fast();
  const FieldError sampled = simplify_to(0.1);
  EXPECT_LT(sampled.max, 0.01);
  EXPECT_LT(sampled.max_inner, 0.03);
}

/// Along z the field is linear: no layer inside is needed. What is left for the largest errors finds none.
TEST_F(TargetedRun, AccurateFindsWhatIsExact) {
  Mesh original = kuhn_cube(10);
  set_scalars(original, waves);
  options.target_ratio = 0.104;
  simplify(original);
  expect_sound(original, 1e-9);
  EXPECT_LT(measure_error(input_of(original), options, result, 2, host.job).max_inner, 1e-9);
}

/// Of collapses alone, without passes: three hundredths of the tets come from vertices that are worst off.
TEST_F(TargetedRun, LeavesTetsToTheLargestErrors) {
  Mesh original = kuhn_cube(12);
  set_scalars(original, [](const Vec3 &p) { return std::sin(60 * p.x) * std::sin(48 * p.y) * std::sin(54 * p.z); });
  collapse(effort_fast);
  for (double tets : {130, 150, 450, 1500}) {
    expect_sizes(original, {tets / double(original.tets.size())}, 1e-2);
    EXPECT_GE(double(report().inserted_points), std::max(1.0, tets / 150)) << tets;
  }
}

/// Of large meshes few tets come from samples; not of one that is nearly all boundary, nor where TetGen fills none.
TEST_F(TargetedRun, LittleOfALargeMesh) {
  options.effort = effort_fast;
  options.target_ratio = 0.02;
  const auto attempts_for = [&](const Cell &cells, Worker &with, double along_z = 1) {
    Mesh original = kuhn_solid(cells, [](const Cell &) { return true; });
    const Vec3 length = box_of(Span<const Vec3>(original.points.data(), original.points.size())).high;
    set_scalars(original, [&](const Vec3 &p) {
      const Vec3 q = 5.0 * p / length;
      return std::sin(q.x) + std::sin(q.y + 1) + along_z * std::cos(q.z);
    });
    result = Result(host.memory);
    run(input_of(original), options, with, host.job, result);
    expect_sound(original, 1e-3);
    expect_size(original);
    return report().remesh_attempts;
  };
  const Cell cube{26, 26, 26}, strip{17000, 1, 1};
  EXPECT_GE(attempts_for(cube, worker), 1);
  EXPECT_EQ(attempts_for(strip, worker), 0);
  EXPECT_EQ(attempts_for(cube, worker, 0.01), 0);  // tets that stretch along z do better

  const std::string failures = testing::TempDir() + "tetlod_failures_" + std::to_string(::getpid());
  ::setenv("FAKE_REMESH_FAILURES", failures.c_str(), 1);
  ::setenv("FAKE_REMESH", "1000", 1);
  Worker failing(TETLOD_FAKE_REMESH);
  EXPECT_EQ(attempts_for(cube, failing), 0);
  ::unsetenv("FAKE_REMESH_FAILURES");
  ::unsetenv("FAKE_REMESH");
  EXPECT_EQ(::unlink(failures.c_str()), 0);  // it was asked
}

/// Each tet in four, so that the boundary stays as it is.
Mesh refined_inside(const Mesh &mesh) {
  Mesh finer{mesh.points, {}, {}};
  for (const Tet &t : mesh.tets) {
    const auto middle = std::int32_t(finer.points.size());
    Vec3 sum(0);
    for (std::int32_t v : t) sum += mesh.points[std::size_t(v)];
    finer.points.push_back(0.25 * sum);
    for (std::size_t k = 0; k < 4; k++) {
      finer.tets.push_back(t);
      finer.tets.back()[k] = middle;
    }
  }
  return finer;
}

/// A cube that has 48 triangles around 200,000 tets became a tetrahedron of its volume.
TEST_F(TargetedRun, KeepsTheShapeOfACoarseBoundaryAroundAFineInside) {
  Mesh original = kuhn_cube(2);
  for (int i = 0; i < 6; i++) original = refined_inside(original);
  set_scalars(original, waves);
  options.effort = effort_fast;
  for (double ratio : {0.02, 0.001}) {
    options.target_ratio = ratio;
    simplify(original);
    expect_sound(original, 1e-3);
    expect_size(original);
    EXPECT_LT(report().max_deviation, far_off) << ratio;
  }
}

/// Samples lead far off there, collapses do not: a plate with nine pins.
TEST_F(TargetedRun, KeepsThePinsOfAPlateWhereNextToNothingIsLeft) {
  Mesh original = kuhn_solid({48, 48, 20}, [](const Cell &c) { return c[2] < 10 || (c[0] % 16 < 8 && c[1] % 16 < 8); });
  set_scalars(original, waves);
  options.effort = effort_fast;
  options.target_ratio = 0.002;
  simplify(original);
  expect_size(original);
  EXPECT_LT(report().max_deviation, far_off);
}

TEST_F(TargetedRun, AConstantField) {
  Mesh original = kuhn_cube(8);
  set_scalars(original, [](const Vec3 &) { return 7.5; });
  options.target_ratio = 0.2;
  simplify(original);
  for (double s : mesh().scalars) ASSERT_EQ(s, 7.5);
  expect_sound(original, 1e-3);
}

/// As good as any other, while squares are doubles, and sound beyond that.
TEST_F(TargetedRun, FieldsOfSmallAndLargeDoubles) {
  Mesh original = kuhn_cube(8);
  options.target_ratio = 0.2;
  const auto error_between = [&](double scale) {
    set_scalars(original, [&](const Vec3 &p) { return scale * std::sin(7 * p.x + 5 * p.y) * std::cos(4 * p.z); });
    simplify(original);
    expect_sound(original, 1e-3);
    return measure_error(input_of(original), options, result, 2, host.job).rms_inner;
  };
  const double usual = error_between(1);
  for (double scale : {1e-140, 1e140}) EXPECT_NEAR(error_between(scale), usual, 0.05 * usual) << scale;
  for (double scale : {1e-300, 1e-309, 1e-315, 1e300}) EXPECT_LT(error_between(scale), 0.2) << scale;
}

/// Whatever values points have that no tet uses.
TEST_F(TargetedRun, UnusedPointsHaveNoSay) {
  Mesh original = kuhn_cube(8);
  set_scalars(original, waves);
  options.target_ratio = 0.2;
  simplify(original);
  const std::uint64_t alone = report().hash;
  original.points.push_back(original.points[5]);
  for (double value : {1e30, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    original.scalars.resize(original.points.size() - 1);
    original.scalars.push_back(value);
    simplify(original);
    EXPECT_EQ(report().hash, alone) << value;
  }
}

TEST_F(TargetedRun, SolidsThatTouch) {
  for (unsigned seed = 0; seed < 6; seed++) {
    Mesh original = random_solid(6, 0.6, seed);
    set_scalars(original, waves);
    options.target_ratio = 0.5;
    simplify(original);
    expect_sound(original, 0.1);
  }
}

TEST_F(TargetedRun, ASizeThatTheTopologyDoesNotAllow) {
  Mesh original = random_solid(5, 0.5, 3);
  set_scalars(original, waves);
  options.target_ratio = 1e-4;
  simplify(original);
  expect_sound(original, 0.2);
  EXPECT_GT(double(report().tets_out), options.target_ratio * double(original.tets.size()));
}

TEST_F(TargetedRun, TheSameBytesForAnyThreads) {
  Mesh original = kuhn_cube(12);
  set_scalars(original, waves);
  options.target_ratio = 0.1;
  simplify(original);
  const std::uint64_t once = report().hash;
  Host two(2);
  Result other(two.memory);
  run(input_of(original), options, worker, two.job, other);
  EXPECT_EQ(other.report.hash, once);
}

TEST_F(TargetedRun, FlaggedVerticesKeepPlaceAndValue) {
  Mesh original = kuhn_cube(10);
  set_scalars(original, waves);
  std::vector<std::uint8_t> flags(original.points.size(), 0);
  for (std::size_t v = 0; v < flags.size(); v += 29) flags[v] = 1;
  Input input = input_of(original);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  options.target_ratio = 0.2;
  run(input, options, worker, host.job, result);
  for (std::size_t v = 0; v < flags.size(); v += 29) {
    const auto found = std::find(mesh().points.begin(), mesh().points.end(), original.points[v]);
    ASSERT_NE(found, mesh().points.end()) << v;
    EXPECT_EQ(mesh().scalars[std::size_t(found - mesh().points.begin())], original.scalars[v]);
  }
}

/// Most of its tets are flat, so that collapses have to make some flatter.
TEST_F(TargetedRun, IsAccurateOnAGradedMesh) {
  constexpr double grading = 1e4;
  Mesh original = kuhn_cube(12);
  transform(original, [](const Vec3 &p) {
    const auto graded = [](double x) { return (std::pow(grading, x) - 1) / (grading - 1); };
    return Vec3(graded(p.x), graded(p.y), graded(p.z));
  });
  set_scalars(original, waves);
  expect_accurate(original, {0.2, 0.1, 0.05}, 1e-2, 5e-5);
}

/// Of thin slabs: all triangles of the boundary are slivers.
TEST_F(TargetedRun, IsAccurateOnAStackOfSlabs) {
  Mesh original = kuhn_solid({200, 1, 1}, [](const Cell &) { return true; });
  transform(original, [](const Vec3 &p) { return Vec3(p.x / 200, p.y, p.z); });
  set_scalars(original, waves);
  expect_accurate(original, {0.5, 0.2, 0.1}, 1e-5, 0.02);
}

/// A simulation's first step: rounding is all that is left of the error, and no reason to flip faces. In a ball whose
/// tets have a vertex in common there are many to flip.
TEST_F(TargetedRun, MeetsItsSizeOfAConstantField) {
  const Surface cube = surface_of(kuhn_cube(18), host.job);
  Mesh original;
  for (const Vec3 &p : cube.points) original.points.push_back(glm::normalize(p - Vec3(0.5)));
  const auto centre = std::int32_t(original.points.size());
  original.points.push_back(Vec3(0));
  for (const Triangle &t : cube.triangles) original.tets.push_back({centre, t[0], t[1], t[2]});
  set_scalars(original, [](const Vec3 &) { return 293.15; });
  collapse(effort_accurate);
  expect_sizes(original, {0.2, 0.07}, 1e-2);
}

/// Passes take tets away where they are of no use, and find none but a corner to use them in.
TEST_F(TargetedRun, MeetsItsSizeWhereMostOfTheFieldIsZero) {
  Mesh original = kuhn_cube(18);
  set_scalars(original, [](const Vec3 &p) { return p == Vec3(0) ? 1.0 : 0.0; });
  for (std::int64_t effort : {effort_fast, effort_accurate}) {
    collapse(effort);
    expect_sizes(original, {0.7, 0.5, 0.2, 0.1}, 1e-3);
  }
}

/// Nothing of a single cube can go, and remeshing makes no fewer of its tets.
TEST_F(TargetedRun, NeverHasMoreTetsThanTheOriginal) {
  Mesh original;
  for (int i = 0; i < 20; i++) {
    Mesh cube = kuhn_cube(1);
    transform(cube, [&](const Vec3 &p) { return Vec3(p.x + 2 * i, p.y, 1e-6 * p.z); });
    append(original, cube);
  }
  set_scalars(original, waves);
  collapse(effort_accurate);
  options.target_ratio = 0.1;
  simplify(original);
  expect_sound(original, 1e-12);
  EXPECT_LE(mesh().tets.size(), original.tets.size());
}

}  // namespace
}  // namespace tetlod
