// What a new vertex says between the probes that asked for it.
#include <gtest/gtest.h>

#include "insert_vertices.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

/// One tet, with probes that differ from its linear function.
class InsertVertices : public testing::Test {
 protected:
  static constexpr double off = 0.01;

  InsertVertices() : mesh(host.memory) {
    for (const Vec3 &p : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      mesh.points.push_back(p);
      mesh.values.push_back({linear(p)});
    }
    mesh.tets.push_back({0, 1, 2, 3});
    mesh.kept.assign(4, 0);
    mesh.connect(host.job);
  }
  static double linear(const Vec3 &p) { return 3 * p.x - p.y + 2 * p.z; }

  void add_probe(const Vec3 &p) {
    mesh.probes.push_back({p, {linear(p) + off}});
    mesh.next_probe.push_back(-1);
    mesh.put_probe(std::int32_t(mesh.probes.size()) - 1, 0);
    mesh.measure(0);
  }

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
