// Thin bodies, and bodies with slits: parts that nothing but the distance holds, and slivers at their rims.
#include <tuple>

#include "decimate_solid_and_check.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class Slits : public WholeRun {
 protected:
  void start_with(int n, int layers, const Field &field = three_waves) {
    slab = slab_with_slits(n, layers);
    set_scalars(slab, field);
  }
  static double two_waves(const Vec3 &p) { return std::sin(6 * p.x) * std::cos(5 * p.y) + p.z * p.z; }
  static double three_waves(const Vec3 &p) { return std::sin(7 * p.x) * std::cos(5 * p.y) + 0.5 * std::sin(6 * p.z); }

  /// Returns what is logged.
  std::string simplify_within(std::size_t bytes) {
    std::string said;
    Memory memory({}, bytes);
    Job job(memory, host.parallel);
    job.log = [&](int, const char *message) { said += std::string(message) + '\n'; };
    Result within(memory);
    run(input_of(slab), options, worker, job, within);
    result.mesh = within.mesh;
    result.report = within.report;
    return said;
  }

  /// A comb: every fourth layer of cells across x is left out but for its back.
  void start_with_comb(const Cell &cells) {
    slab = kuhn_solid(cells, [](const Cell &c) { return c[0] % 4 != 3 || c[1] == 0; });
    set_scalars(slab, [&](const Vec3 &p) {
      return std::tanh(8 * (glm::length(p / Vec3(cells[0], cells[1], cells[2])) - 0.5));
    });
  }

  double rms() { return measure_error(input_of(slab), options, result, 1, host.job).rms; }
  std::size_t tets() const { return slab.tets.size(); }

  Mesh slab;
};

/// Collapses lead far off there, as nothing else holds the end of a slit, which slides along the others' planes.
TEST_F(Slits, KeepTheirLength) {
  start_with(12, 4, two_waves);
  for (const auto &[ratio, bound] : {std::pair(0.3, 0.0), {0.2, 0.0}, {0.0, 0.1}, {0.0, 0.02}})
    for (const auto effort : {effort_fast, effort_accurate}) {
      options.target_ratio = ratio;
      options.max_error = bound;
      options.effort = effort;
      simplify(slab);
      expect_sound(slab, 0.01);
      EXPECT_LT(report().max_deviation, 2 * far_off) << ratio << ' ' << bound << ' ' << effort;
      EXPECT_TRUE(bound == 0 || report().max_error <= bound);
    }
}

/// Where collapses stop a little before the size, which serves as well.
TEST_F(Slits, KeepTheirLengthWhereTheSizeIsNearlyMet) {
  options.effort = effort_fast;
  options.remesh = false;
  for (const auto &[n, ratio] : {std::pair(8, 0.137177), {12, 0.141807}, {14, 0.139886}}) {
    start_with(n, 3, waves);
    options.target_ratio = ratio;
    simplify(slab);
    expect_sound(slab, 0.01);
    EXPECT_LT(report().max_deviation, 2 * far_off) << n;
    EXPECT_LT(double(report().tets_out), 1.03 * ratio * double(tets())) << n;
  }
}

/// Collapses that are made again to come nearer, and TetGen where they miss the size, take more than the first.
TEST_F(Slits, WhatAMemoryLimitRefusesIsLeftOut) {
  start_with(12, 4, two_waves);
  for (const auto &[ratio, effort, least] : {std::tuple(0.2, effort_accurate, 0.6), {0.05, effort_fast, 0.9}}) {
    options.target_ratio = ratio;
    options.effort = effort;
    simplify(slab);
    const double peak = double(report().peak_bytes);
    for (const double part : {0.9, 0.7, 0.6}) {
      if (part < least) continue;
      const std::string said = simplify_within(std::size_t(part * peak));
      expect_sound(slab, 0.01);
      EXPECT_LE(double(report().peak_bytes), part * peak);
      EXPECT_NE(said.find("left out"), said.npos) << ratio << ' ' << part << '\n' << said;
    }
    EXPECT_THROW(simplify_within(std::size_t(0.2 * peak)), Error);
  }
}

/// As without, where collapses were made again within a limit of their own.
TEST_F(Slits, HowFarOffTheyAreIsToldOfVertices) {
  options.effort = effort_fast;
  for (const auto &[cells, ratio, bound] : {std::tuple(Cell{9, 5, 3}, 0.06, 0.0), {Cell{7, 7, 1}, 0.0, 0.1}}) {
    start_with_comb(cells);
    options.target_ratio = ratio;
    options.max_error = bound;
    simplify(slab);
    const Surface before = surface_of(slab, host.job), after = surface_of(copy_of_result(), host.job);
    TreeOnDemand tree(before);
    const auto largest = [&](Samples samples) {
      return largest_deviation(before, tree, after, TreeOnDemand(after), samples, host.job);
    };
    const double told = report().max_deviation * box_of(before.points).diagonal(),
                 of_vertices = largest(Samples::vertices);
    EXPECT_NEAR(told, of_vertices, 1e-12 * told);
    EXPECT_GT(largest(Samples::between_too), 1.01 * of_vertices) << "else this tells nothing";
  }
}

/// What cannot be remeshed, as teeth cross each other, collapses can serve: they end before the size, in a sound mesh.
TEST_F(Slits, CollapsesServeWhereTeethCross) {
  start_with_comb({11, 3, 3});
  const auto tip = std::find(slab.points.begin(), slab.points.end(), Vec3(7, 3, 3));
  ASSERT_NE(tip, slab.points.end());
  tip->x += 2;
  std::vector<std::uint8_t> flags;
  for (const Vec3 &p : slab.points) flags.push_back(p.x < 3.3 ? keep_vertex : 0);
  Input input = input_of(slab);
  input.flags = strided(flags.data(), flags.size(), 1, 1, ElementType::uint8);
  options.target_ratio = 0.06;
  std::size_t by_collapses_alone = 0;
  for (const bool remeshes : {false, true}) {
    options.remesh = remeshes;
    result = Result(host.memory);
    ASSERT_NO_THROW(run(input, options, worker, host.job, result));
    if (!remeshes) by_collapses_alone = mesh().tets.size();
    EXPECT_EQ(mesh().tets.size(), by_collapses_alone);
    EXPECT_GT(double(by_collapses_alone), 0.1 * double(tets()));
    const auto at = [&](std::int32_t v) { return mesh().points[std::size_t(v)]; };
    for (const Tet &t : mesh().tets) EXPECT_GT(det(at(t[0]), at(t[1]), at(t[2]), at(t[3])), 0);
  }
}

/// Once for all that are made again, which take as long each.
TEST_F(Slits, CareIsFoundToBeNeededOnce) {
  options.effort = effort_fast;
  options.target_ratio = 0.03;
  options.remesh = false;
  for (const int n : {16, 20}) {
    start_with(n, 4);
    const std::string said = simplify_within(0);
    const auto far = said.find("of the diagonal off: edges collapse again");
    ASSERT_NE(far, said.npos) << said;
    EXPECT_LT(said.find("with more care"), far) << said;
    EXPECT_EQ(said.find("with more care", far), said.npos) << said;
  }
}

/// However little they are open, if it is more than rounding: each side keeps its values.
TEST_F(Slits, CracksStayOpen) {
  for (const double opening : {1e-3, 1e-6}) {
    slab = open_cracked_cube(16, opening);
    for (const auto &[ratio, bound] : {std::pair(0.2, 0.0), {0.0, 0.02}}) {
      options.target_ratio = ratio;
      options.max_error = bound;
      simplify(slab);
      expect_sound(slab, 0.01);
      EXPECT_LT(report().max_error, 0.02 + 1e-12) << opening;
      EXPECT_LT(report().max_deviation, opening) << opening;
    }
  }
}

/// Its sides are so near that their normals cancel around each edge of the rim. Without a limit `accurate` takes that
/// nearer then, for half a hundredth of the volume at most.
TEST_F(Slits, AThinSlabKeepsItsVolume) {
  slab = kuhn_solid({30, 30, 1}, [](const Cell &) { return true; });
  transform(slab, [](const Vec3 &p) { return Vec3(p.x, p.y, 1e-3 * p.z); });
  set_scalars(slab, [](const Vec3 &p) { return std::sin(9 * p.x) * std::cos(7 * p.y); });
  for (const auto &[effort, limit, volume] :
       {std::tuple(effort_fast, 0.0, 1e-3), {effort_accurate, 0.05, 1e-3}, {effort_accurate, 0.0, 0.0051}})
    for (const double ratio : {0.5, 0.12}) {
      options.effort = effort;
      options.max_deviation = limit;
      options.target_ratio = ratio;
      simplify(slab);
      expect_sound(slab, volume);
      EXPECT_NEAR(double(mesh().tets.size()) / (ratio * double(tets())), 1, 0.03);
    }
}

/// What is cheapest is not admissible, for slivers: passed over, it would leave ever dearer edges to collapse.
TEST_F(Slits, SliversGiveWayBeforeDearEdgesDo) {
  start_with(20, 8);
  options.effort = effort_fast;
  options.target_ratio = 0.1;
  simplify(slab);
  expect_sound(slab, 0.01);
  EXPECT_LT(rms(), 0.035);
  options.target_ratio = 0;
  options.max_error = 0.03;
  simplify(slab);
  expect_sound(slab, 0.01);
  EXPECT_LE(report().max_error, options.max_error);
  EXPECT_LT(double(mesh().tets.size()), 0.18 * double(tets()));
}

/// Between their sides the best place of an edge often turns a tet over, where an end's place would not.
TEST_F(Slits, EndsServeWhereNoBetterPlaceDoes) {
  start_with(30, 8);
  options.effort = effort_fast;
  options.target_ratio = 0.05;
  options.remesh = false;
  simplify(slab);
  expect_sound(slab, 0.01);
  EXPECT_LT(double(mesh().tets.size()), 1.03 * options.target_ratio * double(tets()));
}

}  // namespace
}  // namespace tetlod
