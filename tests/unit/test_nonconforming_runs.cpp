// Runs on meshes that do not conform: quads are cut along both diagonals, or vertices hang on edges.
#include <numeric>

#include "geometry.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

class NonconformingRuns : public WholeRun {
 protected:
  static constexpr int n = 9;
  Mesh original = cubes_in_five(n);
  NonconformingRuns() { set_scalars(original, waves); }

  /// Of the cube, as if its quads were cut along one diagonal each.
  void expect_cube() {
    simplify(original);
    const SurfaceFacts is = facts_of(mesh().boundary);
    EXPECT_TRUE(is.closed);
    EXPECT_EQ(is.components, 1);
    EXPECT_EQ(is.euler, 2);
    EXPECT_EQ(oriented_triangles(mesh().boundary), brute_boundary(copy_of_result()));
    EXPECT_EQ(report().tets_in, std::int64_t(original.tets.size()));
    EXPECT_EQ(report().dropped_tets, 0);
    for (const Tet &t : mesh().tets) {
      const auto at = [&](std::size_t k) { return mesh().points[std::size_t(t[k])]; };
      ASSERT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)), 0);
    }
    EXPECT_NEAR(volume_of(copy_of_result()), 1, as_published(options) ? 0.05 : 0.001);
  }
};

TEST_F(NonconformingRuns, MeetTheSize) {
  for (const auto effort : {effort_fast, effort_accurate})
    for (const double ratio : {0.9, 0.5, 0.1, 0.03}) {
      options.effort = effort;
      options.target_ratio = ratio;
      expect_cube();
      EXPECT_NEAR(double(mesh().tets.size()) / double(original.tets.size()) / ratio, 1, 0.03);
      EXPECT_LT(report().max_error, ratio > 0.2 ? 0.05 : 0.2) << ratio;
    }
}

TEST_F(NonconformingRuns, HoldTheBound) {
  options.target_ratio = 0;
  for (const double bound : {0.1, 0.01}) {
    options.max_error = bound;
    expect_cube();
    EXPECT_LE(report().max_error, bound);
    EXPECT_LE(brute_largest_error(original, mesh()), bound * (1 + 1e-9));
  }
}

/// That of the submitted tet that holds the middle of a tet is its number, also where others took the place of several.
TEST_F(NonconformingRuns, CellsTakeTheValueOfTheSubmittedTet) {
  std::vector<std::int32_t> numbers(original.tets.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  Input input = input_of(original);
  input.fields.push_back(
      {"number", Association::cell, strided(numbers.data(), numbers.size(), 1, 1, ElementType::int32)});
  for (const double ratio : {1.0, 0.5, 0.1}) {
    options.target_ratio = ratio;
    result = Result(host.memory);
    run(input, options, worker, host.job, result);
    const auto &taken = result.fields.at(0).integers;
    ASSERT_EQ(taken.size(), mesh().tets.size());
    for (std::size_t t = 0; t < taken.size(); t++) {
      Vec3 middle(0);
      for (const std::int32_t v : mesh().tets[t]) middle += 0.25 * mesh().points[std::size_t(v)];
      const Tet &source = original.tets[std::size_t(taken[t])];
      double w[4];
      ASSERT_TRUE(barycentric(middle, original.points[std::size_t(source[0])], original.points[std::size_t(source[1])],
                              original.points[std::size_t(source[2])], original.points[std::size_t(source[3])], w));
      EXPECT_GT(*std::min_element(w, w + 4), -1e-6) << "tet " << t << " to " << ratio;
    }
  }
}

TEST_F(NonconformingRuns, AsPublished) {
  options.target_ratio = 0;
  expect_cube();
  EXPECT_EQ(report().boundary_triangles_in, 12 * n * n);
}

/// A third of the cells is fine: the coarse ones are divided where they are next to one, before anything else.
TEST_F(NonconformingRuns, OfMeshesThatAreRefinedInPlaces) {
  original = refined_cubes(6, [](const Cell &c) { return (c[0] * c[0] + 2 * c[1] + 3 * c[2]) % 3 == 0; });
  set_scalars(original, waves);
  for (const auto effort : {effort_fast, effort_accurate})
    for (const double ratio : {0.6, 0.1}) {
      options.effort = effort;
      options.target_ratio = ratio;
      expect_cube();
      EXPECT_NEAR(double(mesh().tets.size()) / double(original.tets.size()) / ratio, 1, 0.03);
    }
  options.target_ratio = 0;
  options.max_error = 0.02;
  expect_cube();
  EXPECT_LE(brute_largest_error(original, mesh()), 0.02 * (1 + 1e-9));
  options.max_error = 0;
  expect_cube();
}

TEST_F(NonconformingRuns, AreRefusedWhereOverlapsAreErrors) {
  options.on_overlap = policy_error;
  options.target_ratio = 0.5;
  EXPECT_EQ(status(original), Status::mesh_intersecting);
}

}  // namespace
}  // namespace tetlod
