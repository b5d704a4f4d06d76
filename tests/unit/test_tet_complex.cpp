// What a complex knows of its tets, against definitions.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "adaptive_meshes.hpp"
#include "brute_force.hpp"

namespace tetlod {
namespace {

using namespace test;

/// Vertices whose tets hang together by faces with the vertex in more than one piece.
std::set<std::int32_t> touching_at_vertices(const Mesh &mesh) {
  std::map<std::int32_t, std::vector<std::size_t>> stars;
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    for (std::int32_t v : mesh.tets[t]) stars[v].push_back(t);
  std::set<std::int32_t> found;
  for (const auto &[v, star] : stars) {
    std::set<std::size_t> reached{star[0]}, left(star.begin() + 1, star.end());
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t t : std::set<std::size_t>(left))
        for (std::size_t r : reached) {
          const std::set<std::int32_t> corners(mesh.tets[r].begin(), mesh.tets[r].end());
          if (std::count_if(mesh.tets[t].begin(), mesh.tets[t].end(), [&](auto u) { return corners.count(u); }) != 3)
            continue;
          reached.insert(t);
          left.erase(t);
          grows = true;
          break;
        }
    }
    if (!left.empty()) found.insert(v);
  }
  return found;
}

/// Ends of edges that more than two triangles of the boundary have.
std::set<std::int32_t> touching_along_edges(const Mesh &mesh) {
  std::map<std::set<std::int32_t>, int> triangles_of;
  for (const Triangle &t : brute_boundary(mesh))
    for (std::size_t k = 0; k < 3; k++) triangles_of[{t[k], t[(k + 1) % 3]}]++;
  std::set<std::int32_t> found;
  for (const auto &[edge, count] : triangles_of)
    if (count > 2) found.insert(edge.begin(), edge.end());
  return found;
}

class Complex : public testing::TestWithParam<int> {};

TEST_P(Complex, KnowsItsBoundaryAndWhereItTouchesItself) {
  Host host(GetParam());
  int by_edges_alone = 0;
  for (unsigned seed = 1; seed <= 3; seed++) {
    const Mesh solid = random_solid(12, 0.6, seed);
    AdaptiveMesh<1> mesh(host.memory);
    adapt(solid, host, mesh);
    std::set<std::int32_t> boundary;
    for (const Triangle &t : brute_boundary(solid)) boundary.insert(t.begin(), t.end());
    const std::set<std::int32_t> at_vertices = touching_at_vertices(solid), along_edges = touching_along_edges(solid);
    for (std::int32_t v = 0; v < std::int32_t(solid.points.size()); v++) {
      const int expected = at_vertices.count(v) + along_edges.count(v) > 0 ? touching : int(boundary.count(v));
      EXPECT_EQ(int(mesh.fixed[std::size_t(v)]), expected) << v << " of seed " << seed;
      by_edges_alone += along_edges.count(v) > at_vertices.count(v);
    }
  }
  EXPECT_GT(by_edges_alone, 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, Complex, testing::Values(1, 3));

}  // namespace
}  // namespace tetlod
