// What a new vertex says between the probes that asked for it.
#include <gtest/gtest.h>

#include "adaptive_meshes.hpp"
#include "insert_vertices.hpp"

namespace tetlod {
namespace {

using namespace test;

/// One tet, with probes that differ from its linear function.
class InsertVertices : public testing::Test {
 protected:
  static constexpr double off = 0.01;

  InsertVertices() : mesh(host.memory) { adapt(corner_tet(linear), host, mesh); }
  static double linear(const Vec3 &p) { return 3 * p.x - p.y + 2 * p.z; }

  void add_probe(const Vec3 &p) { test::add_probe(p, linear(p) + off, mesh); }

  /// By which the new vertex differs from the linear function.
  double insert() {
    insert_vertices(tets_a_vertex, host.job, mesh);
    EXPECT_EQ(mesh.points.size(), 5u);
    return mesh.values.back()[0] - linear(mesh.points.back());
  }

  Host host;
  AdaptiveMesh<1> mesh;
};

TEST_F(InsertVertices, TakeTheValueOfAProbeNextToThem) {
  add_probe(Vec3(0.25));
  EXPECT_NEAR(insert(), off, 0.1 * off);
}

/// Whose weight there is next to nothing: that the vertex served them all the same took it far off in between.
TEST_F(InsertVertices, GoNotFarBeyondProbesThatLieFarOff) {
  constexpr double near = 0.01;
  for (const Vec3 &corner : Array<Vec3>(mesh.points, &host.memory))
    add_probe(corner + 4 * near * (Vec3(0.25) - corner));
  const double change = insert();
  EXPECT_GT(change, 0);
  EXPECT_LT(change, 2 * off);
}

}  // namespace
}  // namespace tetlod
