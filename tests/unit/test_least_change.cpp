// How little a field changes along a direction: closed forms on cubes, in any position, scale and number of fields. And
// where samples are sooner, which that is looked at for.
#include <gtest/gtest.h>

#include <cmath>

#include "budget.hpp"
#include "least_change.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

template <class Field>
double of_cube(const Field &field) {
  Mesh mesh = kuhn_cube(20);
  for (Vec3 &p : mesh.points) p -= Vec3(0.5);
  set_scalars(mesh, field);
  return least_change(mesh.view());
}

/// (a^2, b^2, c^2) are the eigenvalues, but for a factor.
double of_changes(double a, double b, double c) {
  return a * a * b * b * c * c / (a * a * b * b + a * a * c * c + b * b * c * c) / (a * a + b * b + c * c);
}

TEST(LeastChange, OfAFieldThatChangesAlongAllAxes) {
  for (const Vec3 &k : {Vec3(1, 1, 1), Vec3(1, 2, 3), Vec3(10, 1, 0.5), Vec3(1e60, 1e60, 1e60), Vec3(1e-60)}) {
    const double change = of_cube([&](const Vec3 &p) { return k.x * p.x * p.x + k.y * p.y * p.y + k.z * p.z * p.z; });
    const Vec3 unit = k / k.x;
    EXPECT_NEAR(change, of_changes(unit.x, unit.y, unit.z), 0.05 * of_changes(unit.x, unit.y, unit.z)) << k.x;
  }
}

/// But for what linear functions of tets make of it, where they are oblique.
TEST(LeastChange, IsNoneAlongAPlaneOrALine) {
  EXPECT_LT(of_cube([](const Vec3 &p) { return p.x * p.x + p.y * p.y; }), 1e-12);
  EXPECT_LT(of_cube([](const Vec3 &p) { return std::sin(2 * (p.x + p.y)) + std::cos(p.y + p.z); }), 2e-3);
  EXPECT_LT(of_cube([](const Vec3 &p) { return std::tanh(p.x + p.y + 2 * p.z); }), 1e-3);
  EXPECT_EQ(of_cube([](const Vec3 &) { return 3; }), 0);
}

TEST(LeastChange, IsTheSameInAnyPosition) {
  const auto field = [](const Vec3 &p) { return p.x * p.x + 0.6 * p.y * p.y + 0.4 * p.z * p.z; };
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto turned = [&](const Vec3 &p) { return field({c * p.x + s * p.z, p.y, c * p.z - s * p.x}); };
  EXPECT_NEAR(of_cube(turned), of_cube(field), 0.1 * of_cube(field));
}

/// At 4 % of a field in layers they had 2.7 times the error of collapses.
TEST(SamplesSooner, WhereLittleOfALargeMeshIsKept) {
  Options options;
  options.effort = effort_fast;
  Report report;
  report.tets_in = 108273;
  report.boundary_triangles_in = 7068;
  report.least_change = 0.0081;
  const auto at = [&](double ratio) {
    options.target_ratio = ratio;
    return samples_sooner(options, report);
  };
  EXPECT_TRUE(at(0.02) && at(0.03));
  EXPECT_FALSE(at(0.031) || at(0.04) || at(0.1));
  report.keeps_some = true;
  EXPECT_FALSE(at(0.02));
  report.keeps_some = false;
  options.max_error = 0.01;
  EXPECT_FALSE(at(0));
  report.least_change = 0.001;
  EXPECT_FALSE(at(0.02));
  report.least_change = 0.0081;
  report.boundary_triangles_in = 14000;
  EXPECT_FALSE(at(0.02));
  report = {};
  report.tets_in = 50000;
  EXPECT_FALSE(at(0.02));
}

}  // namespace
}  // namespace tetlod
