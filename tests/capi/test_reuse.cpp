// Step after step: what a context takes over from its earlier runs shows in the report and in the clock, and nowhere in
// the bytes of a result.
#include <limits>
#include <random>

#include "reuse_fixture.hpp"

namespace tetlod_test {
namespace {

TEST_F(Reuse, NewValuesTakeOverTheMeshAndItsDecimatedBoundary) {
  tetlod_run_report report = expect_fresh_bytes();
  EXPECT_EQ(report.reused_tets, 0);
  EXPECT_EQ(report.reused_triangles, 0);
  for (double phase : {0.0, 0.4, 0.8}) {
    new_values(phase);
    report = expect_fresh_bytes();
    EXPECT_EQ(report.reused_tets, tets());
    EXPECT_EQ(report.reused_triangles, report.boundary_triangles_out);
  }
  EXPECT_GT(report.reused_samples, 0);
}

/// In place, without a call: the library has to look.
TEST_F(Reuse, AMeshThatMovesIsAnother) {
  expect_fresh_bytes();
  cube.xyz[3 * 400] += 0.01;
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK);
  EXPECT_EQ(report_of(context.get()).reused_tets, 0);
  EXPECT_EQ(bytes_of(context.get()), [&] {
    const Context fresh = make_context();
    set_up(fresh.get());
    EXPECT_EQ(tetlod_run(fresh.get()), TETLOD_OK);
    return bytes_of(fresh.get());
  }());
  std::swap(cube.corners[40], cube.corners[41]);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets());
}

/// Another copy of the mesh is the same mesh, in memory of its own.
TEST_F(Reuse, TheOldArraysMayGo) {
  expect_fresh_bytes();
  Cube other = cube;
  std::swap(other.xyz, cube.xyz);
  std::swap(other.corners, cube.corners);
  std::fill(other.xyz.begin(), other.xyz.end(), 1e300);
  std::fill(other.corners.begin(), other.corners.end(), -1);
  new_values(1);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets());
}

TEST_F(Reuse, LevelsOfDetail) {
  for (double sigma : {0.2, 0.5, 0.2, 0.9, 0.1, 0.3}) {
    options.push_back([sigma](tetlod_context *of) { tetlod_set_sigma(of, sigma); });
    const tetlod_run_report report = expect_fresh_bytes();
    EXPECT_EQ(report.reused_triangles > 0, report.reused_tets > 0 && sigma != 0.1) << "as far as an earlier one went";
  }
}

TEST_F(Reuse, OptionsOfTheBoundary) {
  expect_fresh_bytes();
  options.push_back([](tetlod_context *of) { tetlod_set_lambda(of, 0.5); });
  EXPECT_EQ(expect_fresh_bytes().reused_triangles, 0);
  EXPECT_GT(expect_fresh_bytes().reused_triangles, 0);
  options.push_back([](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_CLEAN_EDGES, 0.08); });
  EXPECT_EQ(expect_fresh_bytes().reused_triangles, 0);
  EXPECT_GT(expect_fresh_bytes().reused_triangles, 0);
  options.push_back([](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_MAX_DEVIATION, 0.02); });
  EXPECT_EQ(expect_fresh_bytes().reused_triangles, 0);
  EXPECT_GT(expect_fresh_bytes().reused_triangles, 0);
  options.push_back([](tetlod_context *of) { tetlod_set_min_distance(of, 0.2); });
  EXPECT_EQ(expect_fresh_bytes().reused_samples, 0);
  EXPECT_GT(expect_fresh_bytes().reused_samples, 0);
  options.push_back([](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_MERGE_TOLERANCE, 1e-3); });
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
}

TEST_F(Reuse, FlagsAreAPartOfTheMesh) {
  expect_fresh_bytes();
  flags.assign(cube.values.size(), 0);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
  flags[364] = TETLOD_FLAG_KEEP;
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
  new_values(0.3);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets());
}

/// A cost that sees the field is another one for other values, and the same for other sizes. A small mesh is remeshed
/// only where edges are to be cleaned.
TEST_F(Reuse, TargetsOfTheSameValues) {
  const auto target = [this](double ratio) {
    options.push_back([ratio](tetlod_context *of) {
      tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, ratio);
      tetlod_set_int(of, TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
      tetlod_set_real(of, TETLOD_OPT_CLEAN_EDGES, 1e-15);
    });
  };
  target(0.1);
  expect_fresh_bytes();
  for (double ratio : {0.2, 0.4}) {
    target(ratio);
    const tetlod_run_report report = expect_fresh_bytes();
    EXPECT_EQ(report.reused_tets, tets());
    EXPECT_GT(report.reused_triangles, 0) << ratio;
  }
  new_values(0.2);
  const tetlod_run_report report = expect_fresh_bytes();
  EXPECT_EQ(report.reused_tets, tets());
}

/// Whichever size comes first, and in the rounds of a bound.
class CollapseReuse : public Reuse {
 protected:
  CollapseReuse() { cube = Cube(12); }

  /// How many collapses were taken over.
  std::int64_t level(double ratio, double bound, int effort = TETLOD_EFFORT_FAST, double warm_start = 0) {
    options = {[=](tetlod_context *of) {
      tetlod_set_real(of, TETLOD_OPT_WARM_START, warm_start);
      tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, ratio);
      tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, bound);
      tetlod_set_int(of, TETLOD_OPT_EFFORT, effort);
    }};
    return expect_fresh_bytes().reused_collapses;
  }
};

/// A bound alone ends its collapses by their cost: it does not begin with fewer tets than it may end with. Its
/// collapses are others than those of a size: what is flat gets no flatter.
TEST_F(CollapseReuse, Bounds) {
  EXPECT_EQ(level(0.02, 0), 0);
  EXPECT_EQ(level(0, 0.001), 0);
  for (double bound : {0.01, 0.1, 0.003}) EXPECT_GT(level(0, bound), 0) << bound;
  EXPECT_EQ(level(0.02, 0), 0);
}

TEST_F(CollapseReuse, Sizes) {
  EXPECT_EQ(level(0.1, 0), 0);
  level(0.1, 0);  // shows that there is more than one to come, and that what is kept is worth some memory
  EXPECT_GT(level(0.1, 0), 0);
  const std::int64_t of_removals = level(0.05, 0);
  EXPECT_GT(of_removals, 0) << "a coarser one goes on where vertices were removed, far from both";
  EXPECT_GT(level(0.04, 0), of_removals);
  EXPECT_EQ(level(0.2, 0), 0) << "planes of the boundary weigh more there";
  EXPECT_EQ(level(0.9, 0), 0) << "nothing is kept of so fine a mesh";
  EXPECT_EQ(level(0.1, 0), 0);
  new_values(0.2);
  EXPECT_EQ(level(0.1, 0), 0);
  flags.assign(cube.values.size(), 0);
  flags[7] = TETLOD_FLAG_KEEP;
  EXPECT_EQ(level(0.1, 0), 0);
  flags[7] = 0;
  EXPECT_EQ(level(0.1, 0), 0);
}

/// They begin anew in each of several attempts, with all the memory.
TEST_F(CollapseReuse, NotOfSmallMeshesForAccuracy) {
  for (double ratio : {0.2, 0.2, 0.2, 0.05}) EXPECT_EQ(level(ratio, 0, TETLOD_EFFORT_ACCURATE), 0) << ratio;
}

/// Of the same values, with warm-start or without, which then gives no bytes up.
TEST_F(CollapseReuse, RunsInAnyOrder) {
  std::mt19937 random(1);
  const auto one_of = [&](std::initializer_list<double> values) { return values.begin()[random() % values.size()]; };
  std::int64_t reused = 0;
  for (int run = 0; run < 40; run++) {
    const double warm_start = one_of({0, 0.1}), ratio = one_of({0, 0.03, 0.05, 0.07, 0.1, 0.12, 0.14, 0.3}),
                 bound = ratio > 0 ? one_of({0, 0, 0, 0.05}) : 0.05;
    SCOPED_TRACE(testing::Message() << "run " << run << ", ratio " << ratio << ", warm-start " << warm_start);
    const int effort = one_of({0, 1}) > 0 ? TETLOD_EFFORT_FAST : TETLOD_EFFORT_ACCURATE;
    reused += level(ratio, bound, effort, warm_start);
  }
  EXPECT_GT(reused, 0);
}

/// The one promise of the same bytes that is given up, by who asks for it.
class WarmStart : public CollapseReuse {
 protected:
  /// A front that moves.
  void new_values(double at) {
    for (std::size_t v = 0; v < cube.values.size(); v++)
      cube.values[v] = std::tanh(6 * (std::hypot(cube.xyz[3 * v], cube.xyz[3 * v + 1], cube.xyz[3 * v + 2]) - at));
  }

  double run_with(tetlod_context *of, double warm_start) {
    set_up(of);
    tetlod_set_preset(of, TETLOD_PRESET_ACCURATE);
    tetlod_set_real(of, TETLOD_OPT_WARM_START, warm_start);
    EXPECT_EQ(tetlod_run(of), TETLOD_OK) << message_of(of);
    tetlod_error_report error{};
    error.struct_size = sizeof error;
    EXPECT_EQ(tetlod_measure_error(of, 1, &error), TETLOD_OK);
    return error.rms;
  }
};

TEST_F(WarmStart, LosesNoMoreThanIsAllowed) {
  constexpr double allowed = 0.2;
  new_values(0.6);
  run_with(context.get(), allowed);
  EXPECT_EQ(report_of(context.get()).reused_collapses, 0);
  int warm = 0, runs = 0;
  for (double at : {0.605, 0.62, 0.65, 0.9, 1.4}) {
    new_values(at);
    const double rms = run_with(context.get(), allowed);
    const Context fresh = make_context();
    EXPECT_LE(rms, (1 + allowed) * run_with(fresh.get(), 0)) << at;
    EXPECT_LE(double(report_of(context.get()).tets_out), 1.03 * 0.1 * double(tets()));
    warm += report_of(context.get()).reused_collapses > 0;
    runs++;
  }
  EXPECT_GT(warm, 0);
  EXPECT_LT(warm, runs);
}

TEST_F(WarmStart, WithoutItTheBytesAreThoseOfAFreshRun) {
  new_values(0.6);
  run_with(context.get(), 0.5);
  new_values(0.605);
  options = {[](tetlod_context *of) {
    tetlod_set_preset(of, TETLOD_PRESET_ACCURATE);
    tetlod_set_real(of, TETLOD_OPT_WARM_START, 0);
  }};
  EXPECT_EQ(expect_fresh_bytes().reused_collapses, 0);
}

/// A bound is held whatever it begins with.
TEST_F(WarmStart, BoundsHold) {
  options = {[](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, 0.01); }};
  std::int64_t reused = 0;
  for (double at : {0.6, 0.601, 0.603, 0.9}) {
    new_values(at);
    run_with(context.get(), 0.5);
    EXPECT_LE(report_of(context.get()).max_error, 0.01) << at;
    reused += report_of(context.get()).reused_collapses;
  }
  EXPECT_GT(reused, 0);
}

/// With a field more, other values of it, another weight, a weight of nothing, and without it again.
TEST_F(Reuse, FieldsThatSteer) {
  const std::size_t points = cube.values.size();
  for (const std::int64_t preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    options.push_back([preset](tetlod_context *of) {
      tetlod_set_preset(of, std::int32_t(preset));
      tetlod_set_real(of, TETLOD_OPT_CLEAN_EDGES, preset == TETLOD_PRESET_FAST ? 1e-15 : 0);
    });
    expect_fresh_bytes();
    for (double phase : {0.3, 0.9}) {
      second.clear();
      for (std::size_t v = 0; v < points; v++) second.push_back(std::cos(4 * cube.xyz[3 * v + 2] + phase));
      for (double w : {1.0, 3.0, 0.0, 0.5}) {
        weight = w;
        EXPECT_EQ(expect_fresh_bytes().reused_tets, tets()) << "preset " << preset << ", weight " << weight;
      }
      const std::int64_t reused = expect_fresh_bytes().reused_triangles;
      EXPECT_EQ(reused > 0, preset != TETLOD_PRESET_ACCURATE) << "nothing has changed";
    }
    second.clear();
    ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  }
}

TEST_F(Reuse, ValuesThatAreNone) {
  expect_fresh_bytes();
  cube.values[77] = std::numeric_limits<double>::quiet_NaN();
  expect_fresh_bytes();
  options.push_back([](tetlod_context *of) { tetlod_set_int(of, TETLOD_OPT_ON_NONFINITE, TETLOD_POLICY_REPAIR); });
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
  cube.values[78] = cube.values[77];
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0) << "other points are ignored";
  new_values(0);
  expect_fresh_bytes();
  second = cube.values;
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets()) << "all are finite, of however many fields";
}

/// Two halves with points of their own in the middle are one while no field jumps there.
TEST_F(Reuse, ValuesThatTear) {
  const std::size_t points = cube.values.size();
  std::vector<std::int32_t> copy(points, -1);
  for (std::size_t t = 0; t < cube.corners.size(); t += 4) {
    double middle = 0;
    for (std::size_t k = 0; k < 4; k++) middle += cube.xyz[3 * std::size_t(cube.corners[t + k])] / 4;
    for (std::size_t k = 0; k < 4; k++) {
      const auto v = std::size_t(cube.corners[t + k]);
      if (middle < 0.5 || cube.xyz[3 * v] != 0.5) continue;
      if (copy[v] < 0) {
        copy[v] = std::int32_t(cube.values.size());
        for (std::size_t i = 0; i < 3; i++) cube.xyz.push_back(cube.xyz[3 * v + i]);
        cube.values.push_back(0);
      }
      cube.corners[t + k] = copy[v];
    }
  }
  options.push_back([](tetlod_context *of) { tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, 0.2); });
  for (const double jump : {0.0, 1.0, 0.5, 0.0}) {
    new_values(0);
    for (std::size_t v = points; v < cube.values.size(); v++) cube.values[v] += jump;
    EXPECT_EQ(expect_fresh_bytes().components, jump > 0 ? 2 : 1) << jump;
    const tetlod_run_report again = expect_fresh_bytes();
    EXPECT_EQ(again.reused_tets, tets()) << "of the same values";
  }
  for (std::size_t v = points; v < cube.values.size(); v++) cube.values[v] += 1;
  submit(context.get(), cube);
  std::vector<double> out(3 * std::size_t(report_of(context.get()).points_out));
  const tetlod_array from = array_of(TETLOD_FLOAT64, cube.values.size(), 3, cube.xyz.data());
  tetlod_array to = array_of(TETLOD_FLOAT64, out.size() / 3, 3, out.data());
  EXPECT_EQ(tetlod_transfer(context.get(), &from, &to), TETLOD_ERR_STATE) << "other points are one now";
  tetlod_error_report error{};
  error.struct_size = sizeof error;
  EXPECT_EQ(tetlod_measure_error(context.get(), 1, &error), TETLOD_ERR_STATE);
  for (std::size_t v = points; v < cube.values.size(); v++) cube.values[v] -= 1;
  EXPECT_EQ(tetlod_measure_error(context.get(), 1, &error), TETLOD_OK) << message_of(context.get());
  EXPECT_LT(error.outside, 0.1);
}

/// Values, points and tets that have to be copied.
TEST_F(Reuse, OtherLayouts) {
  const std::size_t points = cube.values.size();
  std::vector<float> values(cube.values.begin(), cube.values.end());
  std::vector<std::int64_t> corners(cube.corners.begin(), cube.corners.end());
  for (std::int64_t &v : corners) v++;
  const tetlod_array scalars = array_of(TETLOD_FLOAT32, points, 1, values.data());
  const tetlod_array tets_of = array_of(TETLOD_INT64, corners.size() / 4, 4, corners.data());
  const auto run_in = [&](tetlod_context *in) {
    set_up(in);
    tetlod_submit_scalars(in, "float", &scalars);
    tetlod_submit_tets(in, &tets_of, 1);
    EXPECT_EQ(tetlod_run(in), TETLOD_OK) << message_of(in);
    return bytes_of(in);
  };
  expect_fresh_bytes();
  for (int step = 0; step < 3; step++) {
    for (std::size_t v = 0; v < points; v++) values[v] += float(step) * float(cube.xyz[3 * v]);
    const Context fresh = make_context();
    EXPECT_EQ(run_in(context.get()), run_in(fresh.get()));
    EXPECT_EQ(report_of(context.get()).reused_tets, step ? tets() : 0);
  }
}

/// Nothing of what is kept was touched.
TEST_F(Reuse, WhatIsRefusedBeforeAnyWorkForgetsNothing) {
  expect_fresh_bytes();
  const std::int64_t few = std::int64_t(cube.values.size()) - 1;
  tetlod_array array = array_of(TETLOD_FLOAT64, few, 1, cube.values.data());
  ASSERT_EQ(tetlod_submit_scalars(context.get(), "few", &array), TETLOD_OK);
  std::uint64_t bytes = 0;
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT);
  EXPECT_EQ(tetlod_estimate_memory(context.get(), &bytes), TETLOD_ERR_ARGUMENT);
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_submit_field(context.get(), "ride", TETLOD_POINT_FIELD, &array), TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_ARGUMENT);
  tetlod_mesh_report found{};
  found.struct_size = sizeof found;
  EXPECT_EQ(tetlod_check(context.get(), &found), TETLOD_OK) << "fields are the run's alone";
  array = array_of(TETLOD_FLOAT64, few + 1, 1, cube.values.data());
  ASSERT_EQ(tetlod_submit_field(context.get(), "ride", TETLOD_POINT_FIELD, &array), TETLOD_OK);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, std::int64_t(cube.corners.size() / 4));
}

TEST_F(Reuse, ClearForgets) {
  expect_fresh_bytes();
  ASSERT_EQ(tetlod_clear(context.get()), TETLOD_OK);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
}

/// Values so far from those before that what these left is forgotten in the middle of a run for a bound.
TEST_F(Reuse, WhatARunForABoundKeepsIsNotTakenForASize) {
  cube = Cube(10);
  for (double &x : cube.xyz) x *= x * x;
  const auto run = [&](double bound, double warm_start) {
    options = {[=](tetlod_context *of) {
      tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, 0.1);
      tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, bound);
      tetlod_set_real(of, TETLOD_OPT_WARM_START, warm_start);
    }};
    set_up(context.get());
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  };
  for (std::size_t v = 0; v < cube.values.size(); v++) cube.values[v] = cube.xyz[3 * v] * cube.xyz[3 * v];
  run(0.5, 0.25);
  for (std::size_t v = 0; v < cube.values.size(); v++)
    cube.values[v] = std::tanh(9 * (cube.xyz[3 * v + 1] + 0.3 * std::sin(7 * cube.xyz[3 * v]) - 0.5));
  run(0.5, 0.25);
  options = {[](tetlod_context *of) {
    tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, 0.1);
    tetlod_set_real(of, TETLOD_OPT_MAX_ERROR, 0);
    tetlod_set_real(of, TETLOD_OPT_WARM_START, 0);
  }};
  expect_fresh_bytes();
}

}  // namespace
}  // namespace tetlod_test
