// Solids in contact: each is simplified for itself.
#include <limits>
#include <map>
#include <random>
#include <set>

#include "disjoint_sets.hpp"
#include "surface_topology.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class Assemblies : public WholeRun {
 protected:
  void add(Mesh part) {
    set_scalars(part, waves);
    append(assembly, part);
    parts.push_back(std::move(part));
  }
  void add(int cells, const Vec3 &low, const Vec3 &high) {
    Mesh part = kuhn_cube(cells);
    transform(part, [&](const Vec3 &p) { return low + p * (high - low); });
    add(std::move(part));
  }

  /// Rows of bricks, each of which lies on two of the row below.
  void start_with_bricks() {
    for (int row = 0; row < 3; row++)
      for (int i = 0; i < 3; i++) {
        const Vec3 low(i + 0.47 * (row % 2), 0.1 * row + 0.03 * i, 0.5 * row);
        add(5 + (row + i) % 3, low, low + Vec3(1, 1, 0.5));
      }
  }

  /// A plate on a block, with waves between them, which their meshes follow in steps of their own.
  void start_with_waves(const Cell &lower, const Cell &upper, const Vec3 &wave) {
    const auto height = [=](double x, double y) { return 0.5 + wave.z * std::sin(wave.x * x) * std::cos(wave.y * y); };
    Mesh block = kuhn_solid(lower, [](const Cell &) { return true; }),
         plate = kuhn_solid(upper, [](const Cell &) { return true; });
    transform(block, [&](Vec3 p) {
      p /= Vec3(lower[0], lower[1], lower[2]);
      return Vec3(p.x, p.y, p.z * height(p.x, p.y));
    });
    transform(plate, [&](Vec3 p) {
      p = Vec3(0.05, 0.05, 0) + p * Vec3(0.9, 0.9, 1) / Vec3(upper[0], upper[1], upper[2]);
      return Vec3(p.x, p.y, height(p.x, p.y) + p.z * (1 - height(p.x, p.y)));
    });
    add(std::move(block));
    add(std::move(plate));
  }

  /// A ball on a plate, into which it reaches by that part of the diagonal, about.
  void start_with_ball(double reach) {
    add(6, Vec3(-1.5, -1.5, -1), Vec3(1.5, 1.5, 0));
    Mesh ball = kuhn_cube(10);
    transform(ball, [&](const Vec3 &p) {
      const Vec3 q = 2.0 * p - Vec3(1);
      const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}), length = glm::length(q);
      return (length > 0 ? largest / length * q : q) + Vec3(0.2, 0.1, 1 - 5 * reach);
    });
    add(std::move(ball));
  }

  void expect_each_sound(double volume_error = 0.01) {
    expect_sound(assembly, volume_error);
    Surface surface(host.memory);
    make_surface({mesh().points, mesh().scalars, mesh().tets}, mesh().boundary, host.job, surface);
    SurfaceTopology topology(host.memory);
    find_topology(surface.points, surface.triangles, host.job, topology);
    for (std::int32_t c = 0; c < topology.components; c++) {
      Surface component(host.memory);
      component.points = surface.points;
      for (std::size_t t = 0; t < surface.triangles.size(); t++)
        if (topology.component[t] == c) component.triangles.push_back(surface.triangles[t]);
      EXPECT_TRUE(crossings(component, host.memory).empty()) << "component " << c;
    }
  }

  struct Extent {
    Vec3 low{std::numeric_limits<double>::infinity()}, high{-low};
    void add(const Vec3 &p) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    double distance(const Extent &other) const { return glm::length(low - other.low) + glm::length(high - other.high); }
  };

  /// The tets that hang together and are where the part is.
  TetMesh result_of(const Mesh &part) {
    DisjointSets sets(mesh().points.size(), host.memory);
    for (const Tet &t : mesh().tets)
      for (const std::int32_t v : t) sets.join(t[0], v);
    std::map<std::int32_t, Extent> extents;
    for (const Tet &t : mesh().tets)
      for (const std::int32_t v : t) extents[sets.lowest(v)].add(mesh().points[std::size_t(v)]);
    Extent of_part;
    for (const Vec3 &p : part.points) of_part.add(p);
    const auto nearer = [&](const auto &a, const auto &b) {
      return a.second.distance(of_part) < b.second.distance(of_part);
    };
    const std::int32_t nearest = std::min_element(extents.begin(), extents.end(), nearer)->first;
    TetMesh result(host.memory);
    result.points = mesh().points;
    result.scalars = mesh().scalars;
    for (const Tet &t : mesh().tets)
      if (sets.lowest(t[0]) == nearest) result.tets.push_back(t);
    return result;
  }

  /// Of a part's vertices in what became of that part, over the range of all.
  double largest_error_of(const Mesh &part) {
    const auto range_of = [](const Mesh &of) {
      const auto [least, most] = std::minmax_element(of.scalars.begin(), of.scalars.end());
      return *most - *least;
    };
    return brute_largest_error(part, result_of(part)) * range_of(part) / range_of(assembly);
  }

  double part_left() const { return double(mesh().tets.size()) / double(assembly.tets.size()); }

  Mesh assembly;
  std::vector<Mesh> parts;
};

TEST_F(Assemblies, PartsThatTouchAreSimplified) {
  start_with_bricks();
  for (const auto effort : {effort_fast, effort_accurate})
    for (const double ratio : {0.5, 0.2, 0.1, 0.05}) {
      options.effort = effort;
      options.target_ratio = ratio;
      simplify(assembly);
      expect_each_sound();
      EXPECT_NEAR(part_left() / ratio, 1, 0.03) << ratio << ' ' << effort;
      EXPECT_LT(report().max_deviation, 0.01) << ratio << ' ' << effort;
      EXPECT_EQ(report().remesh_attempts, 0);
    }
}

/// Cubes that touch with points at one place: along an edge, at a vertex, and with smaller triangles. What were two
/// components are two, and no edge has four triangles.
TEST_F(Assemblies, PartsWithPointsAtOnePlaceStayApart) {
  for (const auto &[cells, corner] : {std::pair(8, Vec3(1, 1, 0)), {8, Vec3(1, 1, 1)}, {13, Vec3(1, 0, 0)}})
    for (const auto effort : {effort_fast, effort_accurate}) {
      assembly = {};
      parts.clear();
      add(8, Vec3(0), Vec3(1));
      add(cells, corner, corner + Vec3(1));
      options.effort = effort;
      options.target_ratio = 0.1;
      simplify(assembly);
      expect_each_sound();
      EXPECT_EQ(report().components, 2);
      EXPECT_EQ(report().nonmanifold_edges, 0);
      for (const Mesh &part : parts) EXPECT_LT(largest_error_of(part), 0.1);
    }
}

/// Each part has its own value and number, which no place that two have in common mixes.
TEST_F(Assemblies, FieldsAndErrorsAreThoseOfTheOwnPart) {
  start_with_bricks();
  std::vector<double> of_points, of_tets;
  for (std::size_t i = 0; i < parts.size(); i++) {
    of_points.insert(of_points.end(), parts[i].points.size(), double(i));
    of_tets.insert(of_tets.end(), parts[i].tets.size(), double(i));
  }
  for (const bool steers : {false, true}) {
    if (steers) assembly.scalars = of_points;
    Input input = input_of(assembly);
    const auto ride_along = [&](const char *name, Association association, const std::vector<double> &values) {
      input.fields.push_back({name, association, strided(values.data(), values.size(), 1, 1, ElementType::float64)});
    };
    ride_along("part of points", Association::point, of_points);
    ride_along("part of tets", Association::cell, of_tets);
    options.target_ratio = 0.1;
    result = Result(host.memory);
    run(input, options, worker, host.job, result);
    const auto &at_points = result.fields[0].values, &in_tets = result.fields[1].values;
    for (std::size_t t = 0; t < mesh().tets.size(); t++)
      for (const std::int32_t v : mesh().tets[t]) EXPECT_EQ(at_points[std::size_t(v)], in_tets[t]);
    EXPECT_EQ(std::set<double>(in_tets.begin(), in_tets.end()).size(), parts.size());
    if (!steers) continue;
    const FieldError error = measure_error(input, options, result, 1, host.job);
    EXPECT_LT(error.max, 1e-12);
    EXPECT_LT(error.max_inner, 1e-12);
  }
}

/// Two halves of a cube with the same faces between them, and another field in each.
TEST_F(Assemblies, PartsThatAFieldJumpsBetweenStayApart) {
  add(8, Vec3(0), Vec3(1));
  add(8, Vec3(1, 0, 0), Vec3(2, 1, 1));
  Mesh &second = parts[1];
  for (double &value : second.scalars) value = 3 - value;
  std::copy(second.scalars.begin(), second.scalars.end(),
            assembly.scalars.begin() + std::ptrdiff_t(parts[0].points.size()));
  for (const auto effort : {effort_fast, effort_accurate}) {
    options.effort = effort;
    options.target_ratio = 0.1;
    simplify(assembly);
    expect_each_sound();
    EXPECT_EQ(report().components, 2);
    for (const Mesh &part : parts) EXPECT_LT(largest_error_of(part), 0.15);
  }
  options.target_ratio = 0;
  options.max_error = 0.02;
  simplify(assembly);
  for (const Mesh &part : parts) EXPECT_LE(largest_error_of(part), 0.02 * (1 + 1e-9));
}

/// Also where parts are in each other a little, and what is nearest on the boundary, or at a place inside, is
/// another's.
TEST_F(Assemblies, NoPartGetsAnothersValues) {
  for (const auto &[n, other] : {std::pair(17, 15), {18, 23}, {30, 27}})
    for (const auto effort : {effort_fast, effort_accurate}) {
      assembly = {};
      parts.clear();
      start_with_waves({n, n, 6}, {other, other, 6}, Vec3(3.5, 3, 0.1));
      for (std::size_t v = 0; v < assembly.points.size(); v++)
        assembly.scalars[v] = v < parts[0].points.size() ? 0.1 * assembly.points[v].x : 1 - 0.1 * assembly.points[v].y;
      std::vector<double> of_tets(parts[0].tets.size(), 0.0);
      of_tets.resize(assembly.tets.size(), 1.0);
      Input input = input_of(assembly);
      input.fields.push_back(
          {"part of tets", Association::cell, strided(of_tets.data(), of_tets.size(), 1, 1, ElementType::float64)});
      options.effort = effort;
      options.target_ratio = n == 30 ? 0.03 : n == 18 ? 0.14 : 0.09;
      result = Result(host.memory);
      run(input, options, worker, host.job, result);
      const auto &part = result.fields[0].values;
      for (std::size_t t = 0; t < mesh().tets.size(); t++)
        for (const std::int32_t v : mesh().tets[t]) {
          const double value = mesh().scalars[std::size_t(v)];
          EXPECT_TRUE(part[t] == 0 ? value < 0.11 : value > 0.89) << n << ' ' << effort << ' ' << value;
        }
      EXPECT_LT(measure_error(input, options, result, 1, host.job).max_inner, 0.05);
    }
}

/// Deeper than any two triangles reach into each other.
TEST_F(Assemblies, PartsMayBeInEachOtherBetweenTheirTriangles) {
  options.effort = effort_fast;
  options.target_ratio = 0.1;
  for (const int n : {15, 20, 27}) {
    assembly = {};
    parts.clear();
    start_with_waves({n, n, 4}, {3 * n / 2 + 1, 3 * n / 2 + 1, 2}, Vec3(3, 4, 0.08));
    EXPECT_EQ(status(assembly), Status::ok) << n;
  }
}

/// Each of them meets most others, of which no list is kept.
TEST_F(Assemblies, ManyThatOverlapAreRefusedInLittleMemory) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0, 0.3);
  for (int i = 0; i < 400; i++) {
    const Vec3 low(place(random), place(random), place(random));
    add(1, low, low + Vec3(1));
  }
  options.target_ratio = 0.5;
  options.remesh = false;
  Memory memory({}, std::size_t(20) << 20);
  Job job(memory, host.parallel);
  Result refused(memory);
  try {
    run(input_of(assembly), options, worker, job, refused);
    ADD_FAILURE();
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::mesh_intersecting) << error.what();
  }
}

/// Where two have a place in common, that of the one's vertices in the one, though the other is coarser there.
TEST_F(Assemblies, BoundsHold) {
  start_with_bricks();
  options.target_ratio = 0;
  for (const double bound : {0.1, 0.02}) {
    options.max_error = bound;
    simplify(assembly);
    expect_each_sound();
    EXPECT_LE(report().max_error, bound);
    for (const Mesh &part : parts) EXPECT_LE(largest_error_of(part), bound);
  }
}

TEST_F(Assemblies, PartsMayReachIntoEachOtherALittle) {
  options.effort = effort_fast;
  options.target_ratio = 0.1;
  for (const double reach : {0.0, 0.0002, 0.0009}) {
    assembly = {};
    parts.clear();
    start_with_ball(reach);
    simplify(assembly);
    expect_each_sound();
    EXPECT_NEAR(part_left(), 0.1, 0.003);
  }
  assembly = {};
  start_with_ball(0.01);
  EXPECT_EQ(status(assembly), Status::mesh_intersecting);
}

/// The slab's slits come to cross themselves, so that collapses are looked at one by one; the block on it is no
/// hindrance.
TEST_F(Assemblies, CareLeavesContactsAlone) {
  Mesh slab = slab_with_slits(8, 4);
  Vec3 low = slab.points[0], high = low;
  for (const Vec3 &p : slab.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  add(std::move(slab));
  const Vec3 corner(low.x + 0.1, low.y + 0.15, high.z);
  add(5, corner, corner + 0.55 * (high - low));
  options.effort = effort_fast;
  for (const double ratio : {0.1, 0.05}) {
    options.target_ratio = ratio;
    std::string said;
    host.job.log = [&](int, const char *message) { said += message; };
    simplify(assembly);
    EXPECT_NE(said.find("with more care"), std::string::npos);
    expect_each_sound();
    EXPECT_NEAR(part_left() / ratio, 1, 0.03) << ratio;
  }
}

/// From samples, which TetGen has to be asked for, where edges do not collapse first.
TEST_F(Assemblies, EdgesOfLargeOnesCollapseToAnySize) {
  add(26, Vec3(0), Vec3(1));
  add(4, Vec3(0.3, 0.2, 1), Vec3(0.8, 0.7, 1.5));
  options.effort = effort_fast;
  options.target_ratio = 0.02;
  simplify(assembly);
  expect_each_sound();
  EXPECT_NEAR(part_left(), 0.02, 0.0006);
  EXPECT_LT(report().max_deviation, 0.01);
}

TEST_F(Assemblies, AreTheSameForAnyNumberOfThreadsAndInLaterRuns) {
  start_with_bricks();
  options.target_ratio = 0.1;
  simplify(assembly);
  const std::uint64_t hash = report().hash;
  Host two(2);
  Prepared prepared(two.memory);
  for (const double ratio : {0.1, 0.05, 0.1}) {
    options.target_ratio = ratio;
    Result later(two.memory);
    run(input_of(assembly), options, worker, prepared, two.job, later);
    EXPECT_EQ(later.report.hash == hash, ratio == 0.1);
  }
}

/// It takes what touches for one.
TEST_F(Assemblies, APublishedRunBetweenChangesNothing) {
  add(6, Vec3(0), Vec3(1));
  add(6, Vec3(1, 1, 0), Vec3(2, 2, 1));
  Prepared prepared(host.memory);
  std::uint64_t first = 0;
  for (const double ratio : {0.1, 0.0, 0.1}) {
    options.target_ratio = ratio;
    Result later(host.memory);
    run(input_of(assembly), options, worker, prepared, host.job, later);
    EXPECT_EQ(later.report.merged_points, ratio > 0 ? 0 : 7);
    if (first == 0) first = later.report.hash;
    EXPECT_EQ(later.report.hash == first, ratio > 0);
  }
}

TEST_F(Assemblies, AreRefusedWhereTetGenIsNeeded) {
  start_with_bricks();
  options.target_ratio = 0;
  EXPECT_EQ(status(assembly), Status::mesh_intersecting);  // as published
  options.target_ratio = 0.1;
  options.clean_edges = 0.001;
  EXPECT_EQ(status(assembly), Status::mesh_intersecting);
  options.clean_edges = 0;
  options.remesh = 0;
  EXPECT_EQ(status(assembly), Status::ok);
}

TEST_F(Assemblies, OverlapsBesideContactsAreRefused) {
  start_with_bricks();
  add(3, Vec3(-0.8, 0.3, 0.1), Vec3(0.2, 0.8, 0.4));
  for (const auto effort : {effort_fast, effort_accurate})
    for (const bool remesh : {false, true}) {
      options.effort = effort;
      options.remesh = remesh;
      options.target_ratio = 0.1;
      EXPECT_EQ(status(assembly), Status::mesh_intersecting) << effort << remesh;
    }
}

}  // namespace
}  // namespace tetlod
