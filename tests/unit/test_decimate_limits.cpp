// 3.2, past the paper: how far the boundary may go, and how carefully.
#include "decimate_fixture.hpp"
#include "deviation.hpp"

namespace tetlod {
namespace {

class CheckedDecimate : public Decimate {
 protected:
  void decimate_and_check(const DecimateOptions &options) {
    result = original;
    report = tetlod::decimate_and_check(result, topology, options, 0, host.job,
                                        [&](Surface &surface, const DecimateOptions &way) {
                                          return decimate_boundary(surface, topology, {}, way, host.job);
                                        });
  }
};

/// The two sides of a thin bowl pass through each other when nobody looks.
TEST_F(CheckedDecimate, WhatCrossesAfterwardsIsDoneAgainWithCare) {
  Surface bowl = box(host.memory, 16, Vec3(-1, -1, 0), Vec3(1, 1, 0.01));
  transform(bowl, [](const Vec3 &p) { return Vec3(p.x, p.y, p.z + 0.5 * (p.x * p.x + p.y * p.y)); });
  start_with(std::move(bowl));
  DecimateOptions options{0.1, 0.1};
  options.careful = false;
  decimate(options);
  EXPECT_FALSE(crossings(result, host.memory).empty()) << "a surface that tells nothing";
  options.careful = true;
  decimate(options);
  Surface careful(host.memory);
  careful = result;
  decimate_and_check(options);
  expect_sound();
  EXPECT_EQ(result.triangles, careful.triangles);

  start_with(sphere(host.memory, 12));  // where nothing crosses, care changes nothing
  decimate(options);
  careful = result;
  decimate_and_check(options);
  EXPECT_EQ(result.triangles, careful.triangles);
}

/// How far out of the box of all that is around its edge each collapse puts a vertex, as a part of its diagonal.
std::vector<double> ways_out(const CollapseLog &log, const Surface &surface, const SurfaceTopology &topology) {
  std::vector<Vec3> point;
  for (std::int32_t v : topology.vertex_of) point.push_back(surface.points[std::size_t(v)]);
  std::vector<std::int32_t> corner(topology.sheet_vertex.begin(), topology.sheet_vertex.end());
  std::vector<double> ways;
  for (const Collapse &c : log.collapses) {
    Box around;
    for (std::size_t i = 0; i < corner.size(); i++) {
      if (corner[i] != c.from && corner[i] != c.to) continue;
      for (std::size_t k = 0; k < 3; k++) around.add(point[std::size_t(corner[i - i % 3 + k])]);
    }
    ways.push_back(c.moves ? std::sqrt(distance2(around, c.point)) / around.diagonal() : 0);
    std::replace(corner.begin(), corner.end(), c.from, c.to);
    if (c.moves) point[std::size_t(c.to)] = c.point;
    const auto has_gone = [&](std::size_t t) {
      return corner[t] == corner[t + 1] || corner[t + 1] == corner[t + 2] || corner[t + 2] == corner[t];
    };
    for (std::size_t t = corner.size(); t > 0; t -= 3)
      if (has_gone(t - 3)) corner.erase(corner.begin() + std::ptrdiff_t(t - 3), corner.begin() + std::ptrdiff_t(t));
  }
  return ways;
}

/// At the jagged rim of a thin plate the volume says little of where a vertex goes.
TEST_F(Decimate, VerticesStayAmongTheirNeighbours) {
  for (unsigned seed = 0; seed < 5; seed++) {
    std::mt19937 random(seed);
    const auto inside = [](int c) { return c > 1 && c < 12; };
    Mesh plate = kuhn_solid({14, 14, 1}, [&](const Cell &c) { return (inside(c[0]) && inside(c[1])) || random() % 3; });
    transform(plate, [](const Vec3 &p) { return Vec3(p.x, p.y, 0.1 * p.z); });
    start_with(surface_of(plate, host.job));
    CollapseLog log(host.memory);
    for (double sigma : {0.5, 0.0}) {
      result = original;
      log = CollapseLog(host.memory);
      report = decimate_boundary(result, topology, {}, {sigma, 0.1, 0}, host.job, log);
      expect_sound();
      const std::vector<double> ways = ways_out(log, original, topology);
      ASSERT_FALSE(ways.empty());
      const double farthest = *std::max_element(ways.begin(), ways.end());
      EXPECT_LT(farthest, sigma > 0 ? 0.021 : 0.251);
      EXPECT_TRUE(sigma > 0 || farthest > 0.021) << "edges ran out, and no vertex went farther";
    }
    DecimateOptions clean{1, 0.1, 0.03};
    decimate(clean);
    EXPECT_GT(report.cleaned_edges, 10) << "at the rim, too";
  }
}

TEST_F(Decimate, DeviationStaysWithinItsLimit) {
  start_with(random_blob(host.memory, 12, 7));
  TreeOnDemand tree(original);
  for (double field_weight : {0.0, 0.1}) {
    DecimateOptions options{0.05, 0.1};
    options.field_weight = {field_weight};
    std::int64_t edges = 0;
    for (double limit : {0.0, 0.1, 0.03, 0.01}) {
      options.max_deviation = limit;
      decimate(options);
      expect_sound();
      const double deviation =
          largest_deviation(original, tree, result, TreeOnDemand(result), samples_for(limit), host.job);
      EXPECT_NEAR(deviation, brute_deviation(limit > 0), 1e-12);
      EXPECT_TRUE(limit == 0 || deviation <= limit) << deviation << " beyond " << limit;
      EXPECT_GE(report.edges_out, edges) << "a tighter limit keeps no less";
      edges = report.edges_out;
    }
    EXPECT_FALSE(reaches(0.05)) << "the last limit was none";
  }
  start_with(box(host.memory, 8));
  DecimateOptions flat{0.1, 0.1};
  flat.max_deviation = 1e-12;
  decimate(flat);
  EXPECT_TRUE(reaches(0.5)) << "plane walls need no triangles";
}

}  // namespace
}  // namespace tetlod
