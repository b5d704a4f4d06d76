// What comes back through the C++ wrapper: every member that looks at a mesh, a run or its result.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "wrapper_fixture.hpp"

namespace {

using wrapper_test::Cube;

class Results : public testing::Test {
 protected:
  Results() { lod.run(); }
  std::int64_t points() const { return lod.fetch_counts().points; }
  std::int64_t tets() const { return lod.fetch_counts().tets; }

  const Cube cube;
  tetlod::Context lod = cube.submitted();
};

TEST_F(Results, CountsAreTheReports) {
  const tetlod::Counts n = lod.fetch_counts();
  const tetlod_run_report report = lod.fetch_report();
  EXPECT_EQ(n.points, report.points_out);
  EXPECT_EQ(n.tets, report.tets_out);
  EXPECT_EQ(n.boundary_triangles, report.boundary_triangles_out);
}

TEST_F(Results, AViewIsAllOfItsElements) {
  const auto view = lod.view_points();
  EXPECT_EQ(view.tuples(), points());
  EXPECT_EQ(view.components(), 3);
  ASSERT_EQ(view.size(), 3 * std::size_t(points()));
  EXPECT_EQ(view.begin(), view.data());
  EXPECT_EQ(view.end(), &view(points() - 1, 2) + 1);
  EXPECT_EQ(lod.view_scalars().components(), 1);
  EXPECT_EQ(lod.view_tets().components(), 4);
}

TEST_F(Results, FetchedScalarsAreTheViews) {
  std::vector<double> values(std::size_t(points()), -1e9);
  lod.fetch_scalars({values.data(), points()});
  const auto view = lod.view_scalars();
  EXPECT_EQ(values, std::vector<double>(view.begin(), view.end()));
}

TEST_F(Results, TheBoundaryIsClosedAndCountsFromWhatItIsAskedTo) {
  const std::int64_t triangles = lod.fetch_counts().boundary_triangles;
  std::vector<std::int32_t> zero(3 * std::size_t(triangles)), one = zero;
  lod.fetch_boundary(0, {zero.data(), triangles, 3});
  lod.fetch_boundary(1, {one.data(), triangles, 3});
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (std::size_t i = 0; i < zero.size(); i++) {
    EXPECT_EQ(one[i], zero[i] + 1);
    edges[{zero[i], zero[i % 3 == 2 ? i - 2 : i + 1]}]++;
  }
  ASSERT_FALSE(edges.empty());
  for (const auto &[edge, count] : edges) EXPECT_TRUE(count == 1 && edges.count({edge.second, edge.first}) == 1);
}

TEST_F(Results, AStencilIsEachPointAsAMean) {
  std::vector<std::int32_t> zero(4 * std::size_t(points())), one = zero;
  std::vector<double> weights(zero.size());
  lod.fetch_stencil(0, {zero.data(), points(), 4}, {weights.data(), points(), 4});
  lod.fetch_stencil(1, {one.data(), points(), 4}, {weights.data(), points(), 4});
  for (std::size_t i = 0; i < zero.size(); i++) EXPECT_EQ(one[i], zero[i] + 1);
  for (std::int64_t i = 0; i < points(); i++) {
    for (std::int32_t axis = 0; axis < 3; axis++) {
      double mean = 0;
      for (std::size_t k = 4 * std::size_t(i); k < 4 * std::size_t(i) + 4; k++)
        mean += weights[k] * cube.xyz[3 * std::size_t(zero[k]) + std::size_t(axis)];
      EXPECT_NEAR(mean, lod.view_points()(i, axis), 1e-12);
    }
  }
}

TEST_F(Results, ATransferMovesAnotherField) {
  std::vector<double> moved(3 * std::size_t(points()));
  lod.transfer({cube.xyz.data(), cube.points(), 3}, {moved.data(), points(), 3});
  for (std::int64_t i = 0; i < points(); i++)
    for (std::int32_t axis = 0; axis < 3; axis++)
      EXPECT_NEAR(moved[std::size_t(3 * i + axis)], lod.view_points()(i, axis), 1e-12);
}

TEST_F(Results, FieldsOfPointsAndOfCellsRideAlong) {
  std::vector<std::int32_t> cells(std::size_t(cube.tets()));
  std::iota(cells.begin(), cells.end(), 0);
  lod.submit_field("place", TETLOD_POINT_FIELD, {cube.xyz.data(), cube.points(), 3});
  lod.submit_field("cell", TETLOD_CELL_FIELD, {cells.data(), cube.tets()});
  lod.run();
  std::vector<double> places(3 * std::size_t(points()));
  lod.fetch_field("place", {places.data(), points(), 3});
  for (std::size_t i = 0; i < places.size(); i++) EXPECT_NEAR(places[i], lod.view_points().data()[i], 1e-12);
  std::vector<std::int32_t> of(std::size_t(tets()), -1);
  lod.fetch_field("cell", {of.data(), tets()});
  for (std::int32_t cell : of) EXPECT_TRUE(cell >= 0 && cell < cube.tets()) << cell;
}

TEST_F(Results, TheErrorIsMeasuredAtAsManySamplesAsAsked) {
  EXPECT_EQ(lod.measure_error(0).samples_per_tet, 0);
  EXPECT_EQ(lod.measure_error(2).samples_per_tet, 2);
}

TEST_F(Results, AHistogramIsOfTheSideThatIsAskedFor) {
  for (std::int32_t side : {0, 1}) {
    const auto counts = lod.histogram(side, 7);
    EXPECT_EQ(counts.size(), 7u);
    const std::int64_t sum = std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
    EXPECT_EQ(sum, side == 0 ? cube.points() : points());
  }
}

TEST_F(Results, CheckCountsDefects) {
  auto corners = cube.corners;
  std::swap(corners[4 * 17], corners[4 * 17 + 1]);
  for (std::size_t k = 0; k < 4; k++) corners.push_back(corners[k]);
  const auto all = std::int64_t(corners.size() / 4);
  lod.submit_tets({corners.data(), all, 4}, 0);
  const tetlod_mesh_report before = cube.submitted().check(), report = lod.check();
  EXPECT_EQ(report.tets, all);
  EXPECT_EQ(report.points, cube.points());
  EXPECT_EQ(report.duplicate.count, 1);
  EXPECT_EQ(report.duplicate.first, cube.tets());
  EXPECT_EQ(std::abs(report.inverted.count - before.inverted.count), 1);
}

TEST_F(Results, TheEstimateOfMemoryIsNearWhatARunTakes) {
  tetlod::Context fresh = cube.submitted();
  const double estimated = double(fresh.estimate_memory());
  fresh.run();
  const double taken = double(fresh.fetch_report().peak_bytes);
  EXPECT_LT(std::abs(std::log(estimated / taken)), std::log(1.5)) << estimated << ' ' << taken;
}

}  // namespace
