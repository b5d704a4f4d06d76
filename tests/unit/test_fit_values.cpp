// Values by least squares over probes, of which those at original vertices count for more.
#include <gtest/gtest.h>

#include "adaptive_meshes.hpp"
#include "fit_values.hpp"
#include "place_probes.hpp"

namespace tetlod {
namespace {

using namespace test;

/// One tet of value 0, with a probe at an original vertex and one inside the original, both at its first corner.
class FitValues : public testing::TestWithParam<double> {
 protected:
  static constexpr double at_vertex = 3, inside = 1;

  FitValues() : mesh(host.memory) {
    adapt(corner_tet([](const Vec3 &) { return 0; }), host, mesh);
    mesh.vertex_probes = 1;
    mesh.vertex_weight = GetParam();
    for (double value : {at_vertex, inside}) add_probe(Vec3(0), value, mesh);
  }

  double weighted_mean(double of_vertex, double of_inside) const {
    return (GetParam() * of_vertex + of_inside) / (GetParam() + 1);
  }

  Host host;
  AdaptiveMesh<1> mesh;
};

TEST_P(FitValues, AreTheWeightedMeanOfProbesAtOnePlace) {
  fit_values(4, host.job, mesh);
  const double pulled = 0.01;  // to the value that there was
  EXPECT_NEAR(mesh.values[0][0], weighted_mean(at_vertex, inside), pulled * at_vertex);
  for (std::size_t v = 1; v < 4; v++) EXPECT_EQ(mesh.values[v][0], 0);
}

TEST_P(FitValues, LeaveTheLeastMeanSquare) {
  EXPECT_DOUBLE_EQ(mesh.mean_square(), weighted_mean(at_vertex * at_vertex, inside * inside));
  fit_values(4, host.job, mesh);
  const double best = weighted_mean(at_vertex, inside);
  EXPECT_NEAR(mesh.mean_square(), weighted_mean(std::pow(at_vertex - best, 2), std::pow(inside - best, 2)), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Weights, FitValues, testing::Values(1, 2, 8));

/// The more, the more rounds there are.
TEST(PlaceProbes, CountVerticesForMore) {
  const Mesh cube = kuhn_cube(4);
  Host host;
  double before = 1;
  for (int rounds : {0, 1, 12}) {
    AdaptiveMesh<1> mesh(host.memory);
    adapt(cube, host, mesh);
    place_probes(cube.view(), enough_probes(double(cube.tets.size()), rounds, true), host.job, mesh);
    EXPECT_GT(mesh.weight_of(0), before);
    EXPECT_EQ(mesh.weight_of(std::int32_t(mesh.vertex_probes)), 1);
    before = mesh.weight_of(0);
  }
}

}  // namespace
}  // namespace tetlod
