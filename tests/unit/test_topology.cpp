// How a surface hangs together: counts known in closed form, and cuts that follow the material where it touches itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "brute_force.hpp"
#include "extract_boundary.hpp"
#include "find_crossing.hpp"
#include "meshes.hpp"
#include "nested_solids.hpp"
#include "remesh_surfaces.hpp"
#include "status.hpp"
#include "surface_distance.hpp"
#include "surface_topology.hpp"

namespace tetlod {
namespace {

using namespace test;

class Topology : public testing::Test {
 protected:
  Host host;
  SurfaceTopology topology{host.memory};

  void find(const Surface &surface) {
    topology = SurfaceTopology(host.memory);
    find_topology(surface.points, surface.triangles, host.job, topology);
  }

  Status status(const Surface &surface) {
    try {
      find(surface);
      return Status::ok;
    } catch (const Error &error) {
      return error.status();
    }
  }

  std::int64_t euler_of_the_cut(const Surface &surface) const {
    return std::int64_t(topology.vertex_of.size()) - std::int64_t(3 * surface.triangles.size() / 2) +
           std::int64_t(surface.triangles.size());
  }

  void expect(std::int64_t components, std::int64_t nonmanifold_edges, std::int64_t nonmanifold_points) const {
    EXPECT_EQ(topology.components, components);
    EXPECT_EQ(topology.nonmanifold_edges, nonmanifold_edges);
    EXPECT_EQ(topology.nonmanifold_points, nonmanifold_points);
  }

  /// Mates run the other way along the same edge and are of two triangles; the corners that mates join are one vertex
  /// of the cut surface, and no others are.
  void expect_consistent(const Surface &surface) {
    const std::size_t count = 3 * surface.triangles.size();
    ASSERT_EQ(topology.mate.size(), count);
    ASSERT_EQ(topology.sheet_vertex.size(), count);
    const auto next = [](std::size_t h) { return h % 3 == 2 ? h - 2 : h + 1; };
    const auto from = [&](std::size_t h) { return surface.triangles[h / 3][h % 3]; };
    std::map<std::int32_t, std::size_t> corners_of;
    for (std::size_t h = 0; h < count; h++) {
      const auto mate = std::size_t(topology.mate[h]);
      ASSERT_LT(mate, count);
      ASSERT_EQ(std::size_t(topology.mate[mate]), h);
      ASSERT_NE(mate / 3, h / 3);
      ASSERT_EQ(from(h), from(next(mate)));
      ASSERT_EQ(from(mate), from(next(h)));
      ASSERT_EQ(topology.sheet_vertex[h], topology.sheet_vertex[next(mate)]);
      ASSERT_EQ(topology.vertex_of[std::size_t(topology.sheet_vertex[h])], from(h));
      corners_of[topology.sheet_vertex[h]]++;
    }
    for (std::size_t h = 0; h < count; h++) {
      std::size_t walked = 0, at = h;
      do {
        at = next(std::size_t(topology.mate[at]));
        walked++;
      } while (at != h && walked <= count);
      ASSERT_EQ(walked, corners_of[topology.sheet_vertex[h]]) << "two fans are one vertex";
    }
    expect_touching(surface);
  }

  /// Touching: an end of an edge with more than two triangles, or several vertices of the cut.
  void expect_touching(const Surface &surface) {
    std::map<std::pair<std::int32_t, std::int32_t>, int> uses;
    for (const Triangle &t : surface.triangles)
      for (std::size_t k = 0; k < 3; k++) uses[std::minmax(t[k], t[(k + 1) % 3])]++;
    std::vector<int> sheets(surface.points.size(), 0), expected(surface.points.size(), 0);
    for (std::int32_t v : topology.vertex_of) sheets[std::size_t(v)]++;
    for (const auto &[edge, count] : uses)
      if (count > 2) expected[std::size_t(edge.first)] = expected[std::size_t(edge.second)] = 1;
    std::int64_t split = 0, used = 0;
    for (std::size_t v = 0; v < expected.size(); v++) {
      split += sheets[v] > 1;
      used += sheets[v] > 0;
      ASSERT_EQ(topology.touching[v] != 0, expected[v] || sheets[v] > 1) << v;
    }
    EXPECT_EQ(topology.nonmanifold_points, split);
    EXPECT_EQ(topology.used_points, used);
    EXPECT_EQ(topology.edges, facts_of(surface.triangles).edges);
    EXPECT_EQ(topology.nonmanifold_edges, facts_of(surface.triangles).nonmanifold_edges);
  }
};

TEST_F(Topology, OfASphere) {
  const Surface surface = sphere(host.memory, 5);
  find(surface);
  expect_consistent(surface);
  expect(1, 0, 0);
  EXPECT_EQ(topology.edges, 18 * 25);
  EXPECT_EQ(topology.used_points, 6 * 25 + 2);
  EXPECT_EQ(euler_of_the_cut(surface), 2);
}

TEST_F(Topology, OfATorus) {
  const Surface surface = torus(host.memory, 12, 8);
  find(surface);
  expect_consistent(surface);
  expect(1, 0, 0);
  EXPECT_EQ(euler_of_the_cut(surface), 0);
}

TEST_F(Topology, OfACavity) {
  Surface surface = sphere(host.memory, 4);
  append(surface, sphere(host.memory, 3, 0.5), true);
  find(surface);
  expect_consistent(surface);
  expect(2, 0, 0);
  EXPECT_EQ(euler_of_the_cut(surface), 4);
}

TEST_F(Topology, PointsThatNoTriangleUses) {
  Surface surface = sphere(host.memory, 2);
  surface.points.push_back(Vec3(9));
  find(surface);
  EXPECT_EQ(topology.used_points, 26);
  EXPECT_FALSE(topology.touching.back());
}

// Solids that touch

/// Two cubes of n^3 cells, the second moved by `step` cubes.
Surface two_cubes(Memory &memory, int n, const Vec3 &step) {
  Surface surface = box(memory, n);
  append(surface, box(memory, n, step, step + Vec3(1)));
  return welded(memory, surface);
}

TEST_F(Topology, CubesWithACommonEdge) {
  for (int n : {1, 3}) {
    const Surface surface = two_cubes(host.memory, n, Vec3(1, 1, 0));
    find(surface);
    expect_consistent(surface);
    expect(2, n, n + 1);
    EXPECT_EQ(euler_of_the_cut(surface), 4);
    for (std::size_t h = 0; h < topology.mate.size(); h++)  // the first 12 n^2 triangles are the first cube's
      EXPECT_EQ(h / 3 < 12u * unsigned(n * n), unsigned(topology.mate[h]) / 3 < 12u * unsigned(n * n));
  }
}

TEST_F(Topology, CubesWithACommonVertex) {
  for (const Vec3 &step : {Vec3(1, 1, 1), Vec3(-1, 1, 1)}) {
    const Surface surface = two_cubes(host.memory, 2, step);
    find(surface);
    expect_consistent(surface);
    expect(2, 0, 1);
    EXPECT_EQ(euler_of_the_cut(surface), 4);
  }
}

TEST_F(Topology, CavitiesThatTouch) {
  // Two empty cells at a common edge inside a solid: cut along the material they are one cavity, not two.
  const Mesh mesh = kuhn_solid({4, 4, 3}, [](const Cell &c) { return !(c == Cell{1, 1, 1}) && !(c == Cell{2, 2, 1}); });
  const Surface surface = surface_of(mesh, host.job);
  find(surface);
  expect_consistent(surface);
  EXPECT_EQ(topology.nonmanifold_edges, 1);
  EXPECT_EQ(topology.components, 2);
}

/// Two pillars side by side, touching along their edge, from a floor to a ceiling of 2 x 2 cells.
Mesh pillars(int height) {
  return kuhn_solid({2, 2, height + 2},
                    [height](const Cell &c) { return c[2] == 0 || c[2] == height + 1 || c[0] == c[1]; });
}

TEST_F(Topology, OneContactEdgeInAConnectedSolid) {
  const Surface surface = surface_of(pillars(1), host.job);
  find(surface);
  expect_consistent(surface);
  expect(1, 1, 0);
  EXPECT_EQ(euler_of_the_cut(surface), 0) << "a ring";
  EXPECT_EQ(topology.used_points - topology.edges + std::int64_t(surface.triangles.size()), 1);
  EXPECT_EQ(std::count(topology.touching.begin(), topology.touching.end(), 1), 2);
}

TEST_F(Topology, AChainOfContactEdges) {
  for (int height : {2, 5}) {
    const Surface surface = surface_of(pillars(height), host.job);
    find(surface);
    expect_consistent(surface);
    expect(1, height, height - 1);
    EXPECT_EQ(euler_of_the_cut(surface), 0) << "a ring";
  }
}

/// Where four triangles meet at an edge, mates belong to one wedge of material: to cells that share a face.
TEST_F(Topology, CutsFollowTheMaterial) {
  int seen = 0;
  for (unsigned seed = 0; seed < 10; seed++) {
    const Mesh mesh = random_solid(6, 0.5, seed);
    Boundary boundary(host.memory);
    extract_boundary(mesh.view(), host.job, boundary);
    Surface surface(host.memory);
    make_surface(mesh.view(), boundary.triangles, host.job, surface);
    find(surface);
    expect_consistent(surface);
    const auto cell_of = [&](std::size_t triangle) {
      const std::size_t first = std::size_t(boundary.tet_of[triangle]) / 6 * 6;
      return mesh.points[std::size_t(mesh.tets[first][0])];  // its lowest corner
    };
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> edges;
    for (std::size_t h = 0; h < topology.mate.size(); h++) {
      const Triangle &t = surface.triangles[h / 3];
      edges[std::minmax(t[h % 3], t[(h + 1) % 3])].push_back(h);
    }
    for (const auto &[edge, sides] : edges) {
      if (sides.size() == 2) continue;
      for (std::size_t h : sides) {
        const Vec3 step = glm::abs(cell_of(h / 3) - cell_of(std::size_t(topology.mate[h]) / 3));
        EXPECT_LE(step.x + step.y + step.z, 0) << "the two cells only touch";
        seen++;
      }
    }
  }
  EXPECT_GT(seen, 200);
}

/// Wedges at any angle around one edge: petals of a book, each a thin tet.
TEST_F(Topology, ManyWedgesAroundAnEdge) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  for (int wedges : {2, 3, 7}) {
    Surface surface(host.memory);
    surface.points = {Vec3(0), Vec3(0, 0, 1)};
    for (int i = 0; i < wedges; i++) {
      const double low = i + 0.4 * uniform(random), high = i + 0.5 + 0.4 * uniform(random);
      for (double turn : {low, high}) {
        const double angle = 2 * M_PI * turn / wedges;
        surface.points.push_back(Vec3(std::cos(angle), std::sin(angle), uniform(random)));
      }
      const std::int32_t a = 2 * i + 2, b = a + 1;
      for (const Triangle &t : {Triangle{0, b, a}, Triangle{0, a, 1}, Triangle{0, 1, b}, Triangle{1, a, b}})
        surface.triangles.push_back(t);
    }
    find(surface);
    expect_consistent(surface);
    expect(wedges, 1, 2);
    for (std::size_t h = 0; h < topology.mate.size(); h++) EXPECT_EQ(std::size_t(topology.mate[h]) / 12, h / 12);
  }
}

// A surface that crosses itself

std::pair<std::int32_t, std::int32_t> crossing_of(const Surface &surface, Job &job) {
  TreeOnDemand tree(surface);
  return find_crossing(surface, tree, job);
}

TEST_F(Topology, CrossingsAreFound) {
  const std::pair<std::int32_t, std::int32_t> none(-1, -1);
  EXPECT_EQ(crossing_of(random_blob(host.memory, 8, 1), host.job), none);
  EXPECT_EQ(crossing_of(two_cubes(host.memory, 3, Vec3(1, 1, 0)), host.job), none);
  for (double shift : {0.3, 1.9, 2.1}) {  // two unit spheres, the last two apart
    Surface surface = sphere(host.memory, 6);
    append(surface, sphere(host.memory, 5, 1, Vec3(shift, 0.1, 0.1)));
    complete(surface, [](const Vec3 &) { return 0.0; });
    TreeOnDemand tree(surface);
    const auto expected = crossings(surface, host.memory);
    const auto found = crossing_of(surface, host.job);
    EXPECT_EQ(expected.empty(), shift > 2);
    if (expected.empty()) {
      EXPECT_EQ(found, none);
      refuse_crossing(surface, tree, 0, host.job);
      continue;
    }
    const auto [low, high] = std::minmax({found.first, found.second});
    EXPECT_EQ(std::count(expected.begin(), expected.end(), std::make_pair(low, high)), 1);
    Host two(2);
    EXPECT_EQ(crossing_of(surface, two.job), found);
    EXPECT_THROW(refuse_crossing(surface, tree, 0, host.job), Error);
  }
}

/// Only what lies in material is refused: not what lies beside it, and no cavity.
TEST_F(Topology, SolidsInSolidsAreRefused) {
  const auto nested = [&](Surface surface) {
    complete(surface, [](const Vec3 &) { return 0.0; });
    find(surface);
    TreeOnDemand tree(surface);
    try {
      refuse_nested_solids(surface, topology, tree, 0, host.job);
      return false;
    } catch (const Error &error) {
      EXPECT_EQ(error.status(), Status::mesh_intersecting);
      return true;
    }
  };
  const auto with = [&](const Surface &other, bool turned) {
    Surface surface = sphere(host.memory, 6);
    append(surface, other, turned);
    return surface;
  };
  EXPECT_FALSE(nested(sphere(host.memory, 6)));
  EXPECT_FALSE(nested(box(host.memory, 3)));
  EXPECT_FALSE(nested(with(sphere(host.memory, 5, 1, Vec3(3, 0, 0)), false)));
  EXPECT_FALSE(nested(with(sphere(host.memory, 5, 0.5), true)));
  EXPECT_TRUE(nested(with(sphere(host.memory, 5, 0.5), false)));
  Surface in_cavity = with(sphere(host.memory, 5, 0.7), true);
  append(in_cavity, sphere(host.memory, 4, 0.4));
  EXPECT_FALSE(nested(std::move(in_cavity)));
}

/// Each is looked at beside what a ray to it meets, not beside all.
TEST_F(Topology, ASolidInASolidIsFoundAmongMany) {
  constexpr int n = 30;
  Surface surface(host.memory);
  for (int i = 0; i < n * n * n; i++) {
    const Vec3 low(2 * (i % n), 2 * (i / n % n) + 0.1 * (i % n), 2 * (i / n / n) + 0.2 * (i / n % n));
    append(surface, box(host.memory, 1, low, low + Vec3(1)));
    append(surface, box(host.memory, 1, low + Vec3(0.2), low + Vec3(0.8)), true);
  }
  const auto status_of = [&](Surface of) {
    complete(of, [](const Vec3 &) { return 0.0; });
    find(of);
    EXPECT_GE(topology.components, 2 * n * n * n);
    try {
      TreeOnDemand tree(of);
      refuse_nested_solids(of, topology, tree, 0, host.job);
      return Status::ok;
    } catch (const Error &error) {
      return error.status();
    }
  };
  EXPECT_EQ(status_of(copy_of(surface, host)), Status::ok);
  const Vec3 low(24, 24 + 1.2, 24 + 2.4);  // of one of them
  Surface in_cavity = copy_of(surface, host);
  append(in_cavity, box(host.memory, 1, low + Vec3(0.3), low + Vec3(0.7)));
  EXPECT_EQ(status_of(std::move(in_cavity)), Status::ok);
  append(surface, box(host.memory, 1, low + Vec3(0.05), low + Vec3(0.15)));
  EXPECT_EQ(status_of(std::move(surface)), Status::mesh_intersecting);
}

// What is no boundary of a solid

TEST_F(Topology, AnOpenSurfaceIsRefused) {
  Surface surface = sphere(host.memory, 2);
  surface.triangles.pop_back();
  EXPECT_EQ(status(surface), Status::mesh_nonmanifold);
}

TEST_F(Topology, ATriangleTurnedRoundIsRefused) {
  Surface surface = sphere(host.memory, 2);
  std::swap(surface.triangles[5][0], surface.triangles[5][1]);
  EXPECT_EQ(status(surface), Status::mesh_intersecting);
}

/// Two tets at a common edge whose wedges overlap: in, in, out, out around the edge.
TEST_F(Topology, OverlappingWedgesAreRefused) {
  Surface surface(host.memory);
  surface.points = {Vec3(0), Vec3(0, 0, 1)};
  const double angles[] = {0.0, 1.0, 0.5, 1.5};
  for (double angle : angles) surface.points.push_back(Vec3(std::cos(angle), std::sin(angle), 0.5));
  for (std::int32_t a : {2, 4})
    for (const Triangle &t : {Triangle{0, a + 1, a}, Triangle{0, a, 1}, Triangle{0, 1, a + 1}, Triangle{1, a, a + 1}})
      surface.triangles.push_back(t);
  EXPECT_EQ(status(surface), Status::mesh_intersecting);
}

}  // namespace
}  // namespace tetlod
