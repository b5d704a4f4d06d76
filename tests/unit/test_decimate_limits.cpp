// 3.2, past the paper: how far the boundary may go, and how carefully.
#include "decimate_fixture.hpp"
#include "deviation.hpp"

namespace tetlod {
namespace {

/// The two sides of a thin bowl pass through each other when nobody looks.
TEST_F(Decimate, WhatCrossesAfterwardsIsDoneAgainWithCare) {
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
  result = original;
  report = decimate_and_check(result, topology, {}, options, 0, host.job);
  expect_sound();
  EXPECT_EQ(result.triangles, careful.triangles);

  start_with(sphere(host.memory, 12));  // where nothing crosses, care changes nothing
  decimate(options);
  careful = result;
  result = original;
  report = decimate_and_check(result, topology, {}, options, 0, host.job);
  EXPECT_EQ(result.triangles, careful.triangles);
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
