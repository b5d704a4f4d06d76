// 3.4  What bad input does to bare TetGen is crash it, hang it, or be altered silently; here each is a Status.
#include <functional>
#include <limits>

#include "remesh_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST_F(Remesh, TooFewPoints) {
  Surface surface(memory);
  EXPECT_EQ(status(surface), Status::mesh_empty);
  for (int count = 1; count < 4; count++) {
    surface.points.push_back(Vec3(count, count * count, 1));
    surface.triangles = {{{0, 0, 0}}, &memory};
    EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
  }
}

TEST_F(Remesh, IdenticalCollinearCoplanarFlat) {
  const Surface good = box(memory, 2);
  for (const auto &squash : std::vector<std::function<Vec3(Vec3)>>{
           [](Vec3) { return Vec3(1, 2, 3); }, [](Vec3 p) { return Vec3(p.x + 2 * p.y + 4 * p.z); },
           [](Vec3 p) { return Vec3(p.x, p.y, 0); }, [](Vec3 p) { return Vec3(p.x, p.y, p.x + p.y); }}) {
    Surface surface(memory);
    surface = good;
    transform(surface, squash);
    EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
  }
}

TEST_F(Remesh, NotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Surface surface = box(memory, 2);
    Array<Vec3> samples(&memory);
    samples = {{Vec3(0.5), Vec3(0.5, bad, 0.5)}, &memory};
    EXPECT_EQ(status(surface, samples), Status::mesh_nonfinite);
    EXPECT_EQ(message, "interior point 1 is not finite");
    surface.points[5].z = bad;
    EXPECT_EQ(status(surface), Status::mesh_nonfinite);
    EXPECT_EQ(message, "boundary vertex 5 is not finite");
  }
}

TEST_F(Remesh, BrokenTriangles) {
  const Surface good = box(memory, 2);
  Surface surface(memory);
  surface = good;
  surface.triangles[7][1] = std::int32_t(good.points.size());
  EXPECT_EQ(status(surface), Status::mesh_index) << message;
  surface.triangles[7][1] = -1;
  EXPECT_EQ(status(surface), Status::mesh_index) << message;
  surface = good;
  surface.triangles[3][2] = surface.triangles[3][0];
  EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
  surface = good;
  surface.triangles.pop_back();
  EXPECT_EQ(status(surface), Status::mesh_nonmanifold) << message;
  surface = good;
  std::swap(surface.triangles[4][0], surface.triangles[4][1]);
  EXPECT_EQ(status(surface), Status::mesh_nonmanifold) << message;
  surface = good;
  surface.triangles.push_back(surface.triangles[0]);
  EXPECT_EQ(status(surface), Status::mesh_nonmanifold) << message;
  surface = good;
  surface.points.push_back(Vec3(0.5));
  EXPECT_EQ(status(surface), Status::remesh) << message;
  surface = Surface(memory);
  append(surface, good, true);
  EXPECT_EQ(status(surface), Status::remesh) << message;
}

TEST_F(Remesh, CoincidentVertices) {
  Surface surface = box(memory, 2);
  append(surface, box(memory, 2, Vec3(1), Vec3(2)));  // share a corner, but not by number
  EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
}

/// Splits an edge of a triangle on one side only: closed by a triangle without area.
TEST_F(Remesh, TJunction) {
  Surface surface = box(memory, 1);
  const Triangle t = surface.triangles[0];
  const auto middle = std::int32_t(surface.points.size());
  surface.points.push_back((surface.points[std::size_t(t[0])] + surface.points[std::size_t(t[1])]) / 2.0);
  surface.triangles[0] = {t[0], middle, t[2]};
  surface.triangles.push_back({middle, t[1], t[2]});
  EXPECT_EQ(status(surface), Status::mesh_nonmanifold) << message;
  surface.triangles.push_back({t[0], t[1], middle});
  EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
}

/// Surfaces that cross themselves are the business of the stages before; here they may end in any status.
TEST_F(Remesh, CrossingSurfacesDoNoHarm) {
  std::vector<Surface> surfaces;
  for (const Vec3 &low : {Vec3(0.5), Vec3(0.25, 0.25, 0.5), Vec3(0.5, 0, 0), Vec3(0.9999999, 0.3, 0.3)}) {
    surfaces.push_back(box(memory, 2));
    append(surfaces.back(), box(memory, 3, low, low + Vec3(1.01)));
  }
  surfaces.push_back(box(memory, 1, Vec3(-1), Vec3(1)));
  surfaces.back().points[0] = Vec3(3, 2.5, 1.25);  // pushed through the opposite side
  surfaces.push_back(box(memory, 2));
  append(surfaces.back(), box(memory, 3, Vec3(1, 0.1, 0.1), Vec3(2, 0.8, 0.8)));  // touch without sharing vertices
  surfaces.push_back(sphere(memory, 4));
  surfaces.back().points[10] = surfaces.back().points[11] * (1 + 1e-10);
  for (const Surface &surface : surfaces) {
    const Status outcome = status(surface);
    if (outcome == Status::ok)
      expect_good(surface, no_samples());
    else
      EXPECT_TRUE(outcome == Status::remesh || outcome == Status::mesh_degenerate) << message;
  }
}

}  // namespace
}  // namespace tetlod
