// 3.2  The boundary: faces used once, outward; closed forms on lattices, a map of all faces elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "brute_force.hpp"
#include "extract_boundary.hpp"
#include "face_sweep.hpp"
#include "meshes.hpp"
#include "status.hpp"

namespace tetlod {
namespace {

using namespace test;

class ExtractBoundary : public testing::Test {
 protected:
  Host host;
  Boundary boundary{host.memory};
  std::string message;

  void extract(const Mesh &mesh) {
    boundary = Boundary(host.memory);
    extract_boundary(mesh.view(), host.job, boundary);
  }
  Status status(const Mesh &mesh) {
    try {
      extract(mesh);
      return Status::ok;
    } catch (const Error &error) {
      message = error.what();
      return error.status();
    }
  }

  Span<const Triangle> triangles() const { return boundary.triangles; }

  /// Everything that holds for every boundary.
  void expect_good(const Mesh &mesh) {
    EXPECT_TRUE(facts_of(triangles()).closed);
    const double volume = volume_of(mesh);
    EXPECT_NEAR(volume_inside({mesh.points.data(), mesh.points.size()}, triangles()), volume, 1e-12 * volume);
    ASSERT_EQ(boundary.tet_of.size(), boundary.triangles.size());
    for (std::size_t i = 0; i < boundary.triangles.size(); i++)
      for (std::int32_t v : boundary.triangles[i]) {
        const Tet &t = mesh.tets[std::size_t(boundary.tet_of[i])];
        EXPECT_TRUE(std::count(t.begin(), t.end(), v)) << "triangle " << i;
      }
    expect_interior(mesh);
  }

  void expect_interior(const Mesh &mesh) {
    std::set<std::int32_t> inner;
    for (const Tet &t : mesh.tets) inner.insert(t.begin(), t.end());
    EXPECT_EQ(boundary.unused_points, std::int64_t(mesh.points.size() - inner.size()));
    for (const Triangle &t : boundary.triangles)
      for (std::int32_t v : t) inner.erase(v);
    EXPECT_EQ(std::vector<std::int32_t>(boundary.interior.begin(), boundary.interior.end()),
              std::vector<std::int32_t>(inner.begin(), inner.end()));
  }
};

TEST_F(ExtractBoundary, OfACube) {
  for (int n : {1, 2, 5, 9}) {
    Mesh mesh = kuhn_cube(n);
    shuffle(mesh, unsigned(n));
    extract(mesh);
    EXPECT_EQ(boundary.triangles.size(), std::size_t(12 * n * n));
    EXPECT_EQ(boundary.interior.size(), std::size_t((n - 1) * (n - 1) * (n - 1)));
    EXPECT_EQ(facts_of(triangles()).euler, 2);
    EXPECT_EQ(boundary.flat_tets, 0);
    EXPECT_EQ(boundary.duplicate_tets, 0);
    expect_good(mesh);
  }
}

TEST_F(ExtractBoundary, OfOneTetOfEitherWinding) {
  Mesh mesh;
  mesh.points = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.scalars.assign(4, 0.0);
  for (const Tet &tet : {Tet{0, 1, 2, 3}, Tet{1, 0, 2, 3}}) {
    mesh.tets = {tet};
    extract(mesh);
    expect_good(mesh);
    EXPECT_EQ(oriented_triangles(triangles()), (std::multiset<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  }
}

TEST_F(ExtractBoundary, OfACavityATunnelAndSeveralSolids) {
  const auto middle = [](const Cell &c) { return c[0] == 2 && c[1] == 2; };
  Mesh mesh = kuhn_solid({5, 5, 5}, [&](const Cell &c) { return !(middle(c) && c[2] == 2); });
  extract(mesh);
  EXPECT_EQ(boundary.triangles.size(), 12u * 25 + 12);
  EXPECT_EQ(facts_of(triangles()).components, 2);
  EXPECT_EQ(facts_of(triangles()).euler, 4);
  expect_good(mesh);

  mesh = kuhn_solid({5, 5, 5}, [&](const Cell &c) { return !middle(c); });
  extract(mesh);
  EXPECT_EQ(boundary.triangles.size(), 12u * 25 - 4 + 8 * 5);
  EXPECT_EQ(facts_of(triangles()).euler, 0);
  expect_good(mesh);

  mesh = kuhn_solid({5, 5, 5}, [&](const Cell &c) { return c[0] != 2 && c[1] != 2; });
  shuffle(mesh, 3);
  extract(mesh);
  EXPECT_EQ(facts_of(triangles()).components, 4);
  EXPECT_EQ(facts_of(triangles()).euler, 8);
  expect_good(mesh);
}

TEST_F(ExtractBoundary, AgainstAMapOfAllFaces) {
  for (unsigned seed = 0; seed < 20; seed++) {
    Mesh mesh = random_solid(6, 0.1 + 0.04 * seed, seed);
    transform(mesh, [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(p.y), std::cos(p.z), std::sin(2 * p.x)); });
    shuffle(mesh, seed);
    extract(mesh);
    EXPECT_EQ(oriented_triangles(triangles()), brute_boundary(mesh)) << seed;
    expect_good(mesh);
  }
}

/// Of tets of any vertices, some faces used often, some vertices with many faces.
TEST_F(ExtractBoundary, FacesAreSweptWithAllTheirUses) {
  std::mt19937 random(5);
  for (const std::int32_t vertices : {5, 8, 12, 40, 400}) {
    Mesh mesh;
    mesh.points.resize(std::size_t(vertices));
    for (int i = 0; i < 300; i++) {
      std::set<std::int32_t> corners;
      if (vertices > 12 && i % 2) corners.insert(0);
      while (corners.size() < 4) corners.insert(std::int32_t(random() % std::uint32_t(vertices)));
      Tet tet;
      std::copy(corners.begin(), corners.end(), tet.begin());
      std::shuffle(tet.begin(), tet.end(), random);
      mesh.tets.push_back(tet);
    }
    using Face = std::array<std::int32_t, 3>;
    std::map<Face, std::vector<std::uint32_t>> expected, visited;
    for (std::size_t t = 0; t < mesh.tets.size(); t++)
      for (std::uint32_t k = 0; k < 4; k++) {
        Face face;
        for (std::size_t i = 0; i < 3; i++) face[i] = mesh.tets[t][std::size_t(tet_face[k][i])];
        std::sort(face.begin(), face.end());
        expected[face].push_back(std::uint32_t(4 * t) + k);
      }
    Face last{};
    const MeshView view = mesh.view();
    FaceSweep(view, {}, host.job).visit([&](std::size_t, std::int32_t low, const FaceUse *first, const FaceUse *end) {
      const Face face{low, first->middle, first->high};
      for (const FaceUse *f = first; f != end; f++) visited[face].push_back(f->use);
      if (end - first != 1) return;
      EXPECT_LE(last, face);
      last = face;
    });
    EXPECT_EQ(visited, expected) << vertices;
  }
}

TEST_F(ExtractBoundary, UnusedPointsAreCounted) {
  Mesh mesh = kuhn_cube(3);
  mesh.points.insert(mesh.points.begin(), 5, Vec3(7));
  for (Tet &t : mesh.tets)
    for (std::int32_t &v : t) v += 5;
  mesh.points.push_back(Vec3(0.5));
  mesh.scalars.assign(mesh.points.size(), 0.0);
  extract(mesh);
  EXPECT_EQ(boundary.unused_points, 6);
  expect_good(mesh);
}

// Flat tets

/// The four corners of the square above cell (x, y) of the top face of n^3 unit cells.
std::array<std::int32_t, 4> top_square(const Mesh &mesh, int n, int x, int y) {
  std::array<std::int32_t, 4> corners{};
  for (int k = 0; k < 4; k++) {
    const Vec3 p(x + (k == 1 || k == 2), y + (k >= 2), n);
    corners[std::size_t(k)] = std::int32_t(std::find(mesh.points.begin(), mesh.points.end(), p) - mesh.points.begin());
  }
  return corners;
}

TEST_F(ExtractBoundary, FlatTetsArePeeled) {
  constexpr int n = 4;
  Mesh mesh = kuhn_solid({n, n, n}, [](const Cell &) { return true; });
  extract(mesh);
  const std::multiset<Triangle> expected = oriented_triangles(triangles());
  const std::vector<Tet> good = mesh.tets;
  std::int64_t flat = 0;
  for (const auto &[x, y] : {std::pair(0, 0), std::pair(1, 2), std::pair(3, 3)}) {
    const auto square = top_square(mesh, n, x, y);
    mesh.tets.insert(mesh.tets.begin() + 5 * x, {square[0], square[1], square[2], square[3]});
    flat++;
  }
  extract(mesh);
  EXPECT_EQ(boundary.flat_tets, flat);
  EXPECT_EQ(oriented_triangles(triangles()), expected);

  // A second flat tet on the first: it covers the other diagonal, and is itself covered.
  const auto square = top_square(mesh, n, 2, 1);
  const auto centre = std::int32_t(mesh.points.size());
  mesh.points.push_back(0.25 * (mesh.points[std::size_t(square[0])] + mesh.points[std::size_t(square[1])] +
                                mesh.points[std::size_t(square[2])] + mesh.points[std::size_t(square[3])]));
  mesh.scalars.push_back(0);
  mesh.tets.push_back({square[0], square[1], square[2], square[3]});
  mesh.tets.push_back({square[0], square[1], square[3], centre});
  mesh.tets.push_back({square[1], square[2], square[3], centre});
  extract(mesh);
  EXPECT_EQ(boundary.flat_tets, flat + 3);
  EXPECT_EQ(oriented_triangles(triangles()), expected);
  EXPECT_EQ(boundary.unused_points, 1) << "only flat tets use it";
  EXPECT_EQ(std::count(boundary.interior.begin(), boundary.interior.end(), centre), 0);
}

/// The upper half is pressed onto the lower one, layer on layer.
TEST_F(ExtractBoundary, FlatLayersArePeeled) {
  constexpr int n = 8;
  Mesh mesh = kuhn_solid({n, n, n}, [](const Cell &) { return true; });
  transform(mesh, [](const Vec3 &p) { return Vec3(p.x, p.y, std::min(p.z, n / 2.0)); });
  shuffle(mesh, 3);
  extract(mesh);
  EXPECT_EQ(boundary.flat_tets, 6 * n * n * n / 2);
  EXPECT_EQ(triangles().size(), std::size_t(8 * n * n));
  EXPECT_TRUE(facts_of(triangles()).closed);
  EXPECT_NEAR(volume_inside({mesh.points.data(), mesh.points.size()}, triangles()), n * n * n / 2, 1e-9);
}

TEST_F(ExtractBoundary, OfNothingButFlatTets) {
  Mesh mesh = kuhn_cube(2);
  transform(mesh, [](const Vec3 &p) { return Vec3(p.x, p.y, p.x + p.y); });
  EXPECT_EQ(status(mesh), Status::mesh_degenerate);
}

// What is no solid

TEST_F(ExtractBoundary, AFaceOfThreeTetsIsRefused) {
  Mesh mesh = kuhn_cube(2);
  const Tet t = mesh.tets[20];
  mesh.points.push_back(Vec3(9));
  mesh.scalars.push_back(0);
  const auto apex = std::int32_t(mesh.points.size() - 1);
  mesh.tets.push_back({t[0], t[1], t[3], apex});  // a face inside a cell: it has the cell's diagonal
  EXPECT_EQ(status(mesh), Status::mesh_nonmanifold);
  EXPECT_NE(message.find("3 tets"), std::string::npos) << message;
  EXPECT_NE(message.find("20"), std::string::npos) << message;
}

/// Each with each they would be compared for minutes, and no cancelling heard.
TEST_F(ExtractBoundary, AFaceOfVeryManyTetsIsSoonRefused) {
  Mesh mesh;
  mesh.points = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  constexpr std::int32_t count = 200000;
  for (std::int32_t i = 0; i < count; i++) {
    mesh.points.push_back(Vec3(0.1, 0.1, 1 + i));
    mesh.tets.push_back({0, 1, 2, 3 + i});
  }
  mesh.tets.push_back(mesh.tets[7]);
  mesh.scalars.resize(mesh.points.size(), 0);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(status(mesh), Status::mesh_nonmanifold);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 5);
  EXPECT_NE(message.find("200000 tets"), std::string::npos) << message;
}

/// A tet given twice or three times counts once, wherever it is and however it is wound.
TEST_F(ExtractBoundary, TetsGivenAgainAreLeftOut) {
  std::mt19937_64 random(1);
  for (unsigned seed = 0; seed < 5; seed++) {
    Mesh mesh = random_solid(4, seed == 0 ? 0.0 : 0.2 * seed, seed);
    const std::multiset<Triangle> expected = brute_boundary(mesh);
    const double volume = volume_of(mesh);
    const std::size_t count = mesh.tets.size();
    for (std::size_t i = 0; i < 10; i++) {
      Tet again = mesh.tets[random() % count];
      std::shuffle(again.begin(), again.end(), random);
      mesh.tets.push_back(again);
    }
    std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
    extract(mesh);
    EXPECT_EQ(boundary.duplicate_tets, 10);
    EXPECT_EQ(oriented_triangles(triangles()), expected);
    EXPECT_NEAR(volume_inside({mesh.points.data(), mesh.points.size()}, triangles()), volume, 1e-12 * volume);
    expect_interior(mesh);
  }
}

TEST_F(ExtractBoundary, ThreadsDoNotMatter) {
  Mesh mesh = random_solid(14, 0.7, 1);
  shuffle(mesh, 1);
  extract(mesh);
  Host two(2);
  Boundary other(two.memory);
  extract_boundary(mesh.view(), two.job, other);
  EXPECT_TRUE(
      std::equal(other.triangles.begin(), other.triangles.end(), boundary.triangles.begin(), boundary.triangles.end()));
  EXPECT_TRUE(std::equal(other.tet_of.begin(), other.tet_of.end(), boundary.tet_of.begin(), boundary.tet_of.end()));
  EXPECT_TRUE(
      std::equal(other.interior.begin(), other.interior.end(), boundary.interior.begin(), boundary.interior.end()));
}

// The surface with points of its own

TEST_F(ExtractBoundary, SurfaceHasItsOwnPoints) {
  Mesh mesh = random_solid(5, 0.5, 4);
  set_scalars(mesh, [](const Vec3 &p) { return p.x + 10 * p.y; });
  extract(mesh);
  Surface surface(host.memory);
  make_surface(mesh.view(), boundary.triangles, host.job, surface);
  ASSERT_EQ(surface.triangles.size(), boundary.triangles.size());
  ASSERT_EQ(surface.points.size(), surface.origin.size());
  ASSERT_EQ(surface.points.size(), surface.scalars.size());
  const std::set<std::int32_t> origins(surface.origin.begin(), surface.origin.end());
  EXPECT_EQ(origins.size(), surface.origin.size()) << "a vertex is there twice";
  for (std::size_t i = 0; i < surface.points.size(); i++) {
    const auto v = std::size_t(surface.origin[i]);
    EXPECT_EQ(surface.points[i], mesh.points[v]);
    EXPECT_EQ(surface.scalars[i], mesh.scalars[v]);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); t++)
    for (std::size_t k = 0; k < 3; k++)
      EXPECT_EQ(surface.origin[std::size_t(surface.triangles[t][k])], boundary.triangles[t][k]);
}

}  // namespace
}  // namespace tetlod
