// Tets so flat that weights in them are what rounding makes of them: points are taken in their neighbours.
#include <map>
#include <random>
#include <tuple>

#include "extract_boundary.hpp"
#include "interpolate.hpp"
#include "predicates.hpp"
#include "whole_run.hpp"

namespace tetlod {
namespace {

using namespace test;

/// A cube whose tets are divided again and again at points that are nearly on their corners, edges and faces.
Mesh cube_with_flat_tets(unsigned seed) {
  Mesh mesh = kuhn_cube(2);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int split = 0; split < 400; split++) {
    const std::size_t t = random() % mesh.tets.size();
    const Tet tet = mesh.tets[t];
    double w[4], sum = 0;
    for (double &weight : w) sum += weight = uniform(random) < 0.5 ? std::pow(10, -6 * uniform(random)) : 0.5;
    Vec3 middle(0);
    for (std::size_t k = 0; k < 4; k++) middle += w[k] / sum * mesh.points[std::size_t(tet[k])];
    const auto at = [&](std::int32_t v) { return v < 0 ? middle : mesh.points[std::size_t(v)]; };
    const auto part = [&](std::size_t k, std::int32_t v) {
      Tet of = tet;
      of[k] = v;
      return of;
    };
    bool all_positive = true;
    for (std::size_t k = 0; k < 4; k++) {
      const Tet of = part(k, -1);
      all_positive = all_positive && orientation(at(of[0]), at(of[1]), at(of[2]), at(of[3])) > 0;
    }
    if (!all_positive) continue;
    const auto v = std::int32_t(mesh.points.size());
    mesh.points.push_back(middle);
    mesh.tets[t] = part(0, v);
    for (std::size_t k = 1; k < 4; k++) mesh.tets.push_back(part(k, v));
  }
  mesh.scalars.assign(mesh.points.size(), 0);
  return mesh;
}

/// Of vertices that both have, which needs no weights: how far the values are off.
double largest_error_of_common(const Mesh &original, const TetMesh &result) {
  const auto key = [](const Vec3 &p) { return std::tuple(p.x, p.y, p.z); };
  std::map<std::tuple<double, double, double>, double> value;
  for (std::size_t v = 0; v < result.points.size(); v++) value[key(result.points[v])] = result.scalars[v];
  double largest = 0;
  for (std::size_t v = 0; v < original.points.size(); v++)
    if (const auto found = value.find(key(original.points[v])); found != value.end())
      largest = std::max(largest, std::abs(found->second - original.scalars[v]));
  return largest;
}

class FlatTets : public WholeRun {};

TEST_F(FlatTets, ABoundHoldsOrIsRefused) {
  int held = 0;
  for (unsigned seed = 1; seed <= 60; seed++) {
    Mesh original = cube_with_flat_tets(seed);
    set_scalars(original, [](const Vec3 &p) { return std::sin(9 * p.x - 4 * p.y + 7 * p.z); });
    const auto [low, high] = std::minmax_element(original.scalars.begin(), original.scalars.end());
    options.max_error = 1e-4;
    const Status is = status(original);
    ASSERT_TRUE(is == Status::ok || is == Status::max_error) << seed;
    if (is != Status::ok) continue;
    held++;
    EXPECT_LE(largest_error_of_common(original, mesh()), options.max_error * (*high - *low) * (1 + 1e-9)) << seed;
  }
  EXPECT_GT(held, 30);
}

/// Along the axes weights are exact, however flat all tets are.
TEST_F(FlatTets, ASheetIsDecimatedToABound) {
  Mesh sheet = kuhn_cube(8);
  set_scalars(sheet, [](const Vec3 &p) { return std::sin(5 * p.x) * std::cos(4 * p.y); });
  transform(sheet, [](const Vec3 &p) { return Vec3(p.x, p.y, std::ldexp(p.z, -37)); });
  options.max_error = 0.02;
  ASSERT_EQ(status(sheet), Status::ok);
  EXPECT_LT(mesh().tets.size(), sheet.tets.size() / 2);
}

/// Where rounding leaves less and less of the places.
TEST_F(FlatTets, FarOutTheOriginalItselfHoldsAnyBound) {
  for (int exponent : {20, 38, 50}) {
    Mesh original = kuhn_cube(4);
    transform(original, [=](const Vec3 &p) { return 4.0 * p + Vec3(std::ldexp(1.0, exponent)); });
    std::mt19937_64 random(1);
    for (double &s : original.scalars) s = double(random() % 1000);
    options.max_error = 1e-12;
    EXPECT_EQ(status(original), Status::ok) << exponent;
    EXPECT_LE(largest_error_of_common(original, mesh()), 999 * options.max_error) << exponent;
  }
}

TEST_F(FlatTets, LinearFieldsAreNearlyExact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (unsigned seed = 1; seed <= 30; seed++) {
    Mesh original = cube_with_flat_tets(seed);
    set_scalars(original, linear);
    Array<Vec3> points(original.points.begin(), original.points.end(), &host.memory);
    for (int i = 0; i < 2000; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
    Boundary boundary(host.memory);
    extract_boundary(original.view(), host.job, boundary);
    Array<double> values(&host.memory);
    interpolate(original.view(), boundary.triangles, points, 500, host.job, values);
    for (std::size_t i = 0; i < points.size(); i++) ASSERT_NEAR(values[i], linear(points[i]), 1e-4) << seed << ' ' << i;
  }
}

}  // namespace
}  // namespace tetlod
