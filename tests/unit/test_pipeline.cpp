// The whole run on generated meshes, with the real worker: fields that come back exact, and a report that adds up.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "deviation.hpp"
#include "remesh_attempts.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

/// The faces of a cube stay flat where no edge of the cube is collapsed away from its line; a linear field is then
/// exact wherever the new vertices lie on the edge they come from. Inside it is exact always.
TEST_F(WholeRun, LinearFieldOnACube) {
  Mesh original = kuhn_cube(8);
  set_scalars(original, linear);
  options.sigma = 1;
  for (double rho : {0.0, 0.01, 0.1, 1.0}) {
    options.rho = rho;
    simplify(original);
    expect_sound(original, 1e-12);
    expect_samples(original);
    for (std::size_t i = 0; i < mesh().points.size(); i++)
      ASSERT_NEAR(mesh().scalars[i], linear(mesh().points[i]), 1e-12);
    const FieldError e = measure_error(input_of(original), options, result, 2, host.job);
    EXPECT_LT(e.max, 1e-12);
    EXPECT_LT(e.max_inner, 1e-12);
    EXPECT_EQ(e.outside, 0);
  }
}

TEST_F(WholeRun, FewerTheLargerRhoAndTheSmallerSigma) {
  Mesh original = kuhn_cube(12);
  set_scalars(original, waves);
  std::int64_t before = std::int64_t(original.tets.size());
  for (double part : {0.5, 0.2, 0.05}) {
    options.sigma = part;
    options.rho = 0.02 / part;
    simplify(original);
    expect_sound(original, 0.05);
    expect_samples(original);
    EXPECT_LT(report().tets_out, before);
    EXPECT_LE(double(report().boundary_edges_out), std::ceil(part * double(report().boundary_edges_in)));
    before = report().tets_out;
    EXPECT_LT(measure_error(input_of(original), options, result, 1, host.job).rms, 0.15);
  }
}

TEST_F(WholeRun, ACavity) {
  Mesh original = kuhn_solid({9, 9, 9}, [](const Cell &c) {
    return std::min({c[0], c[1], c[2]}) < 3 || std::max({c[0], c[1], c[2]}) > 5;
  });
  set_scalars(original, linear);
  options.sigma = 0.2;
  simplify(original);
  expect_sound(original, 0.05);
  EXPECT_EQ(report().components, 2);
  for (const Tet &t : mesh().tets) {
    Vec3 middle(0);
    for (std::int32_t v : t) middle += 0.25 * mesh().points[std::size_t(v)];
    const Vec3 off = glm::abs(middle - Vec3(4.5));
    EXPECT_GT(std::max({off.x, off.y, off.z}), 1.0) << "a tet in the cavity";
  }
}

TEST_F(WholeRun, SolidsThatTouchTunnelsAndAll) {
  for (unsigned seed = 0; seed < 4; seed++) {
    Mesh original = random_solid(5, 0.6, seed);
    set_scalars(original, waves);
    options.sigma = 0.5;
    simplify(original);
    expect_sound(original, 0.2);
  }
}

TEST_F(WholeRun, MergedAndDroppedAreCounted) {
  Mesh original = kuhn_cube(4);
  const std::size_t points = original.points.size(), tets = original.tets.size();
  Mesh beside = original;
  transform(beside, [](const Vec3 &p) { return p + Vec3(1, 0, 0); });
  append(original, beside);
  original.tets.push_back({0, 0, 1, 2});
  original.points.push_back(Vec3(9));
  set_scalars(original, linear);
  original.scalars.back() = 1e9;  // no tet uses it
  options.sigma = 1;
  simplify(original);
  EXPECT_EQ(report().merged_points, 25);
  EXPECT_EQ(report().dropped_tets, 1);
  EXPECT_EQ(report().unused_points, 1);
  EXPECT_EQ(report().points_in, std::int64_t(2 * points + 1));
  EXPECT_EQ(report().tets_in, std::int64_t(2 * tets + 1));
  EXPECT_EQ(report().components, 1);
  EXPECT_NEAR(volume_of(copy_of_result()), 2, 1e-12);
  EXPECT_EQ(report().interior_points_in + report().boundary_points_in + report().unused_points + report().merged_points,
            report().points_in);
  for (std::size_t i = 0; i < mesh().points.size(); i++)
    ASSERT_NEAR(mesh().scalars[i], linear(mesh().points[i]), 1e-12);
}

TEST_F(WholeRun, WindingDoesNotMatter) {
  Mesh original = kuhn_cube(6);
  set_scalars(original, waves);
  Mesh turned = original;
  for (std::size_t t = 0; t < turned.tets.size(); t += 2) std::swap(turned.tets[t][1], turned.tets[t][2]);
  simplify(original);
  const std::int64_t tets = report().tets_out;
  simplify(turned);
  expect_sound(turned, 0.1);
  EXPECT_NEAR(double(report().tets_out), double(tets), 0.1 * double(tets));
}

TEST_F(WholeRun, ThreadsAndRepetitionGiveTheSameBytes) {
  Mesh original = random_solid(9, 0.85, 1);
  set_scalars(original, waves);
  options.sigma = 0.3;
  simplify(original);
  Host two(2);
  for (Host *with : {&host, &two}) {
    Worker other(TETLOD_REMESH);
    Result again(with->memory);
    run(input_of(original), options, other, with->job, again);
    EXPECT_EQ(again.report.hash, report().hash);
    ASSERT_EQ(again.mesh.points.size(), mesh().points.size());
    ASSERT_EQ(again.mesh.tets.size(), mesh().tets.size());
    EXPECT_EQ(std::memcmp(again.mesh.points.data(), mesh().points.data(), sizeof(Vec3) * mesh().points.size()), 0);
    EXPECT_EQ(std::memcmp(again.mesh.tets.data(), mesh().tets.data(), sizeof(Tet) * mesh().tets.size()), 0);
    EXPECT_EQ(std::memcmp(again.mesh.scalars.data(), mesh().scalars.data(), 8 * mesh().scalars.size()), 0);
  }
  options.rho = 0.05;
  simplify(original);
  Result other(host.memory);
  run(input_of(original), Options(), worker, host.job, other);
  EXPECT_NE(other.report.hash, report().hash);
}

/// The worker fails on the first boundaries, whatever is tried with them; and on all.
TEST_F(WholeRun, ABoundaryThatCannotBeFilledIsDecimatedLess) {
  Mesh original = kuhn_cube(8);
  set_scalars(original, waves);
  const std::string file = testing::TempDir() + "tetlod_boundaries_" + std::to_string(::getpid());
  ::setenv("FAKE_REMESH_FAILURES", file.c_str(), 1);
  double sigma = 0.2;
  for (int boundaries = 0; boundaries < 4; boundaries++, sigma = less_decimated(sigma)) {
    options.sigma = sigma;
    simplify(original);
    EXPECT_EQ(report().boundary_retries, 0);
    options.sigma = 0.2;
    ::setenv("FAKE_REMESH", std::to_string(std::size_t(boundaries) * remesh_attempts().size()).c_str(), 1);
    Worker failing(TETLOD_FAKE_REMESH);
    Result again(host.memory);
    run(input_of(original), options, failing, host.job, again);
    ::unlink(file.c_str());
    EXPECT_EQ(again.report.boundary_retries, boundaries);
    EXPECT_EQ(again.report.hash, report().hash);
  }
  ::setenv("FAKE_REMESH", "1000", 1);
  Worker failing(TETLOD_FAKE_REMESH);
  Result again(host.memory);
  EXPECT_THROW(run(input_of(original), options, failing, host.job, again), Error);
  EXPECT_EQ(again.report.boundary_retries, 3);
  ::unlink(file.c_str());
  ::unsetenv("FAKE_REMESH_FAILURES");
  ::unsetenv("FAKE_REMESH");
}

/// Edges stop collapsing long before the size: what a bound needs beyond that is no reason to ask for a way once more.
/// (A tight bound asked three times before.)
TEST_F(WholeRun, WhereTetGenFindsNoWayABoundAsksForItOnce) {
  Mesh original = random_solid(6, 0.7, 1);
  transform(original, [](const Vec3 &p) { return Vec3(10 * p.x, p.y, 10 * p.z); });
  for (std::size_t v = 0; v < original.scalars.size(); v++) original.scalars[v] = double(v * 7919 % 101);
  options.target_ratio = 0.02;
  const std::string file = testing::TempDir() + "tetlod_failures_" + std::to_string(::getpid());
  ::setenv("FAKE_REMESH_FAILURES", file.c_str(), 1);
  ::setenv("FAKE_REMESH", "1000000", 1);
  const auto failures = [&](double bound) {
    options.max_error = bound;
    Worker failing(TETLOD_FAKE_REMESH);
    Result by_collapses(host.memory);
    run(input_of(original), options, failing, host.job, by_collapses);
    const auto count = std::filesystem::file_size(file);
    std::filesystem::remove(file);
    return count;
  };
  const auto loose = failures(1);
  EXPECT_GT(loose, 0u);
  EXPECT_EQ(failures(0.1), loose);
  ::unsetenv("FAKE_REMESH_FAILURES");
  ::unsetenv("FAKE_REMESH");
}

TEST_F(WholeRun, AtAnyScaleAndPlace) {
  Mesh original = kuhn_cube(6);
  set_scalars(original, waves);
  for (double scale : {1e-9, 1e9}) {
    Mesh moved = original;
    transform(moved, [scale](const Vec3 &p) { return scale * (p + Vec3(10, -20, 5)); });
    for (double &s : moved.scalars) s *= 1e-7;
    simplify(moved);
    expect_sound(moved, 0.1);
  }
}

TEST_F(WholeRun, EveryStageIsTold) {
  Mesh original = kuhn_cube(6);
  set_scalars(original, waves);
  std::vector<Stage> stages;
  host.job.progress = [&](Stage stage, double fraction) {
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    if (std::find(stages.begin(), stages.end(), stage) == stages.end()) stages.push_back(stage);
    return false;
  };
  simplify(original);
  ASSERT_EQ(stages.size(), std::size_t(Stage::count));
  const std::vector<Stage> first{Stage::prepare, Stage::boundary}, last{Stage::cull, Stage::remesh, Stage::values};
  EXPECT_TRUE(std::equal(first.begin(), first.end(), stages.begin()));
  EXPECT_TRUE(std::equal(last.begin(), last.end(), stages.end() - 3));
}

TEST_F(WholeRun, CanBeCancelledInEveryStage) {
  Mesh original = kuhn_cube(6);
  set_scalars(original, waves);
  for (int s = 0; s < int(Stage::count); s++) {
    host.job.progress = [s](Stage stage, double) { return int(stage) == s; };
    EXPECT_EQ(status(original), Status::cancelled) << s;
    host.job.progress = nullptr;
    EXPECT_EQ(status(original), Status::ok);
  }
}

TEST_F(WholeRun, WhatIsNoSolidIsRefused) {
  Mesh flat = kuhn_cube(3);
  transform(flat, [](const Vec3 &p) { return Vec3(p.x, p.y, 0); });
  const Status of_flat = status(flat);
  EXPECT_TRUE(of_flat == Status::mesh_degenerate || of_flat == Status::mesh_empty) << int(of_flat);
  EXPECT_EQ(status(Mesh()), Status::mesh_empty);
}

/// A limit is held at middles of edges and triangles, too, of which a bound makes new ones at the end.
TEST_F(WholeRun, TheReportTellsTheLargestDeviation) {
  const std::pair<int, double> cubes[] = {{5, 0.05}, {6, 0.02}, {9, 0.05}};  // cells a side, height of the waves
  const Field fields[] = {waves, [](const Vec3 &p) { return std::exp(-9 * p.x) + p.y * p.y; }};
  for (const auto &[n, height] : cubes) {
    Mesh original = kuhn_cube(n);
    const double most = height;
    transform(original, [most](const Vec3 &p) { return p + most * glm::sin(Vec3(7 * p.y, 5 * p.z, 6 * p.x)); });
    const Surface before = surface_of(original, host.job);
    for (const Field &field : fields)
      for (const auto &[bound, limit] : {std::pair(0.1, 0.02), {0.05, 0.005}, {0.01, 0.01}}) {
        set_scalars(original, field);
        options.max_error = bound;
        options.max_deviation = limit;
        simplify(original);
        const Surface after = surface_of(copy_of_result(), host.job);
        TreeOnDemand tree(before);
        const double deviation =
            largest_deviation(before, tree, after, TreeOnDemand(after), Samples::between_too, host.job) /
            box_of(before.points).diagonal();
        EXPECT_LE(deviation, limit);
        EXPECT_NEAR(report().max_deviation, deviation, 1e-12) << n << ' ' << bound;
      }
  }
}

}  // namespace
}  // namespace tetlod
