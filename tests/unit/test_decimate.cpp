// 3.2  Decimation: whatever is asked for, what comes out is closed, of the same topology, and does not cross itself.
#include <chrono>

#include "decimate_fixture.hpp"

namespace tetlod {
namespace {

TEST_F(Decimate, Smooth) {
  const auto round = [&](Surface &&surface, double volume_error) {
    start_with(std::move(surface));
    for (double sigma : {0.5, 0.2, 0.1}) {
      decimate(sigma);
      expect_sound();
      EXPECT_TRUE(reaches(sigma)) << report.edges_out << " edges of " << report.edges_in << " at " << sigma;
      EXPECT_NEAR(relative_volume(), 1, volume_error) << sigma;
    }
  };
  round(sphere(host.memory, 12), 0.01);
  round(torus(host.memory, 40, 24), 0.02);
  for (unsigned seed = 0; seed < 3; seed++) round(random_blob(host.memory, 12, seed), 0.02);
}

TEST_F(Decimate, Edgy) {
  const auto edgy = [&](Surface &&surface, double volume_error) {
    start_with(std::move(surface));
    for (double sigma : {0.3, 0.1}) {
      decimate(sigma);
      expect_sound();
      EXPECT_NEAR(relative_volume(), 1, volume_error) << sigma;
      EXPECT_LT(report.edges_out, report.edges_in / 2);
    }
  };
  edgy(box(host.memory, 10), 0.02);
  edgy(spiky_star(host.memory, 10), 0.05);
  const auto tunnel = [](const Cell &c) { return !(c[0] > 1 && c[0] < 6 && c[1] > 1 && c[1] < 6 && c[2] > 3); };
  edgy(surface_of(kuhn_solid({8, 8, 8}, tunnel), host.job), 0.05);
}

TEST_F(Decimate, CavityAndSeveralSolids) {
  Surface surface = sphere(host.memory, 10);
  append(surface, sphere(host.memory, 8, 0.6), true);
  append(surface, torus(host.memory, 30, 16, 3, 0.5));
  append(surface, box(host.memory, 6, Vec3(5), Vec3(6)));
  start_with(std::move(surface));
  for (double sigma : {0.2, 0.05}) {
    decimate(sigma);
    expect_sound();
    EXPECT_NEAR(relative_volume(), 1, 0.05);
  }
}

/// Everything at once: contacts at edges and vertices, tunnels, cavities.
TEST_F(Decimate, SolidsThatTouch) {
  for (unsigned seed = 0; seed < 12; seed++) {
    start_with(surface_of(random_solid(6, 0.3 + 0.05 * seed, seed), host.job));
    for (double sigma : {0.3, 0.0}) {
      decimate(sigma);
      expect_sound();
      EXPECT_EQ(facts_of(result.triangles).nonmanifold_edges, topology.nonmanifold_edges);
      for (std::size_t v = 0; v < original.points.size(); v++)
        if (topology.touching[v]) expect_stays(v);
    }
  }
}

TEST_F(Decimate, FineSolidsThatTouch) {
  for (const Vec3 &step : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    Surface surface = box(host.memory, 8);
    append(surface, box(host.memory, 8, step, step + Vec3(1)));
    start_with(welded(host.memory, surface));
    decimate(0.2);
    expect_sound();
    EXPECT_NEAR(relative_volume(), 1, 0.03);
    EXPECT_LT(report.edges_out, report.edges_in / 2);
    for (std::size_t v = 0; v < original.points.size(); v++)
      if (topology.touching[v]) expect_stays(v);
  }
}

TEST_F(Decimate, LockedVerticesStay) {
  std::mt19937_64 random(1);
  for (unsigned every : {3u, 20u}) {
    start_with(random_blob(host.memory, 10, every));
    for (std::size_t v = 0; v < original.points.size(); v++) locked.push_back(random() % every == 0);
    decimate(0.05);
    expect_sound();
    for (std::size_t v = 0; v < locked.size(); v++)
      if (locked[v]) expect_stays(v);
    EXPECT_LT(report.edges_out, report.edges_in);
  }
  locked.assign(original.points.size(), 1);
  decimate(0);
  EXPECT_EQ(report.edges_out, report.edges_in) << "all locked";
}

/// When the edges of a box stay, its faces stay flat, however few triangles they get.
TEST_F(Decimate, FlatFacesStayFlat) {
  start_with(box(host.memory, 8));
  for (const Vec3 &p : original.points) {
    int on = 0;
    for (int k = 0; k < 3; k++) on += p[k] == 0 || p[k] == 1;
    locked.push_back(on >= 2);
  }
  decimate(0);
  expect_sound();
  EXPECT_LT(report.edges_out, report.edges_in / 2);
  EXPECT_NEAR(volume(), 1, 1e-9);
  for (const Vec3 &p : result.points) {
    double off = 1;
    for (int k = 0; k < 3; k++) off = std::min({off, std::abs(p[k]), std::abs(p[k] - 1)});
    EXPECT_LT(off, 1e-9);
  }
}

TEST_F(Decimate, AllTheWayDown) {
  for (double lambda : {0.0, 0.1, 100.0}) {
    start_with(torus(host.memory, 24, 12));
    decimate(0, lambda);
    expect_sound();
    EXPECT_LT(report.edges_out, report.edges_in / 5) << lambda;
    start_with(random_blob(host.memory, 8, 1));
    decimate(0, lambda);
    expect_sound();
    EXPECT_GE(report.edges_out, 6);
  }
}

TEST_F(Decimate, SmallestSolidsStay) {
  Surface tetrahedron(host.memory);
  tetrahedron.points = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  tetrahedron.triangles = {{1, 2, 3}, {0, 2, 1}, {0, 1, 3}, {0, 3, 2}};
  start_with(std::move(tetrahedron));
  decimate(0);
  expect_sound();
  EXPECT_EQ(result.triangles.size(), 4u);

  Surface many(host.memory);
  for (int i = 0; i < 5; i++) append(many, box(host.memory, 1 + i % 2, Vec3(3 * i), Vec3(3 * i + 1)));
  start_with(std::move(many));
  decimate(0);
  expect_sound();
}

/// Sagging between its vertices a coarse surface would come through its neighbour at a thousandth.
TEST_F(Decimate, NearLayersDoNotComeThroughOneAnother) {
  Surface shells = sphere(host.memory, 10);
  append(shells, sphere(host.memory, 10, 1.001), true);  // of the same triangles, so that they are apart at first
  append(shells, sphere(host.memory, 8, 1.6));
  start_with(std::move(shells));
  decimate(0.1);
  expect_sound();
  EXPECT_LT(report.edges_out, report.edges_in);

  Surface plates = box(host.memory, 12, Vec3(0), Vec3(1, 1, 0.2));
  append(plates, box(host.memory, 11, Vec3(0, 0, 0.201), Vec3(1, 1, 0.401)));
  transform(plates, [](const Vec3 &p) { return p + Vec3(0, 0, 0.1 * std::sin(5 * p.x) * std::cos(4 * p.y)); });
  complete(plates, [](const Vec3 &p) { return p.x; });
  // Two wavy sheets of different triangles may cross from the start: then the gap is widened until they do not.
  while (!crossings(plates, host.memory).empty())
    for (Vec3 &p : plates.points)
      if (&p - plates.points.data() >= 6 * 144 + 2) p.z += 1e-3;
  start_with(std::move(plates));
  decimate(0.05);
  expect_sound();
  EXPECT_LT(report.edges_out, report.edges_in / 2);
}

TEST_F(Decimate, TwoFacesOfAThinSheet) {
  Surface sheet = box(host.memory, 12, Vec3(0), Vec3(1, 1, 1e-3));
  transform(sheet, [](const Vec3 &p) { return p + Vec3(0, 0, 0.3 * p.x * p.x + 0.2 * std::sin(4 * p.y)); });
  start_with(std::move(sheet));
  decimate(0.1);
  expect_sound();
}

/// As computed twice: the same bytes, and no threads are in it.
TEST_F(Decimate, IsDeterministic) {
  start_with(random_blob(host.memory, 12, 5));
  decimate(0.1);
  Surface first(host.memory);
  first = result;
  Host two(2);
  result = original;
  decimate_boundary(result, topology, {}, {0.1, 0.1, 0}, two.job);
  ASSERT_EQ(first.points.size(), result.points.size());
  EXPECT_EQ(std::memcmp(first.points.data(), result.points.data(), first.points.size() * sizeof(Vec3)), 0);
  EXPECT_TRUE(std::equal(first.scalars.begin(), first.scalars.end(), result.scalars.begin()));
  EXPECT_TRUE(std::equal(first.triangles.begin(), first.triangles.end(), result.triangles.begin()));
}

/// Each collapse is beside them: the time grows with the triangles, not with their square.
TEST_F(Decimate, HubsTakeNoTime) {
  constexpr int n = 20000;
  original.points = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
  for (int i = 0; i < n; i++) {
    const double angle = 2 * 3.14159265358979 * i / n;
    const std::int32_t at = 2 + i, next = 2 + (i + 1) % n;
    original.points.push_back(Vec3(std::cos(angle), std::sin(angle), 0));
    original.triangles.push_back({0, at, next});
    original.triangles.push_back({1, next, at});
  }
  complete(original, [](const Vec3 &p) { return p.x; });
  find_topology(original.points, original.triangles, host.job, topology);
  DecimateOptions careless{0.5, 0.1, 0};
  careless.careful = false;
  const auto before = std::chrono::steady_clock::now();
  decimate(careless);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count(), 3);
  EXPECT_EQ(result.triangles.size(), std::size_t(n));
  careless.sigma = 0;
  decimate(careless);
  EXPECT_LT(result.triangles.size(), 200u) << "they are none any more";
  EXPECT_TRUE(facts_of(result.triangles).closed);
  EXPECT_EQ(facts_of(result.triangles).euler, 2);
}

TEST_F(Decimate, NothingToDo) {
  start_with(random_blob(host.memory, 6, 5));
  decimate(1);
  expect_sound();
  EXPECT_EQ(report.edges_out, report.edges_in);
  EXPECT_EQ(volume(), volume_inside(original.points, original.triangles));
}

/// A mean of equal values may round beyond them; the range is kept to the last bit.
TEST_F(Decimate, ConstantValuesStayWhatTheyAre) {
  for (double constant : {913.1500244140625, 0.1, -1.0 / 3, 3.3144460104e-07}) {
    start_with(random_blob(host.memory, 10, 4));
    complete(original, [constant](const Vec3 &) { return constant; });
    decimate(0.1);
    for (double s : result.scalars) ASSERT_EQ(s, constant);
  }
}

// Cleaning

/// A sphere with some triangles cut into three by a point next to one of their corners.
Surface sphere_with_short_edges(Memory &memory, double length) {
  Surface surface = sphere(memory, 8);
  const std::size_t count = surface.triangles.size();
  for (std::size_t i = 0; i < count; i += 11) {
    const Triangle t = surface.triangles[i];
    const Vec3 a = surface.points[std::size_t(t[0])], b = surface.points[std::size_t(t[1])],
               c = surface.points[std::size_t(t[2])];
    const auto v = std::int32_t(surface.points.size());
    surface.points.push_back(a + length * glm::normalize(b + c - 2.0 * a));
    surface.triangles[i] = {t[0], t[1], v};
    surface.triangles.push_back({t[1], t[2], v});
    surface.triangles.push_back({t[2], t[0], v});
  }
  return surface;
}

std::int64_t shorter_than(const Surface &surface, double limit) {
  std::int64_t count = 0;
  for (const Triangle &t : surface.triangles)
    for (std::size_t k = 0; k < 3; k++)
      count += t[k] < t[(k + 1) % 3] &&
               glm::length(surface.points[std::size_t(t[k])] - surface.points[std::size_t(t[(k + 1) % 3])]) < limit;
  return count;
}

/// The diagonal of a unit sphere's box is 2 sqrt(3).
TEST_F(Decimate, CleaningTakesShortEdges) {
  constexpr double limit = 1e-3;
  for (double sigma : {0.9, 1.0}) {
    start_with(sphere_with_short_edges(host.memory, 1e-5));
    const std::int64_t bad = shorter_than(original, limit);
    ASSERT_GT(bad, 10);
    decimate(DecimateOptions{sigma, 0.1, limit / std::sqrt(12.0)});
    expect_sound();
    EXPECT_EQ(shorter_than(result, limit), 0) << "sigma " << sigma;
    EXPECT_EQ(report.cleaned_edges, bad) << "sigma " << sigma;
  }
}

TEST_F(Decimate, CleaningLeavesLongEdges) {
  start_with(sphere(host.memory, 8));
  decimate(DecimateOptions{1, 0.1, 1e-3});
  EXPECT_EQ(report.cleaned_edges, 0);
  EXPECT_EQ(report.edges_out, report.edges_in);
}

}  // namespace
}  // namespace tetlod
