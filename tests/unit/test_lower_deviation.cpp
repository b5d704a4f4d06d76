// The boundary goes back to where collapses left it farthest off.
#include "decimate_solid_fixture.hpp"
#include "deviation.hpp"
#include "lower_deviation.hpp"

namespace tetlod {
namespace {

using namespace test;

class LowerDeviation : public DecimateSolid {
 protected:
  /// Of the original as it is, but for what `change` does to it.
  template <class Change>
  double lower(std::int64_t most, const Change &change) {
    Mesh changed = original;
    change(changed);
    mesh = as_result(changed, host.memory);
    boundary_of(mesh);
    origin.assign(mesh.points.size(), 0);
    for (std::size_t v = 0; v < origin.size(); v++)
      origin[v] = mesh.points[v] == original.points[v] || is_kept(v) ? std::int32_t(v) : -1;
    return lower_deviation({surface, tree.get(host.job), {stays.data(), stays.size()}, guarded}, least, most, host.job,
                           mesh, origin);
  }

  bool is_kept(std::size_t v) const { return !stays.empty() && stays[v]; }

  void boundary_of(TetMesh &of) {
    Boundary found(host.memory);
    extract_boundary({of.points, of.scalars, of.tets}, host.job, found);
    of.boundary = found.triangles;
  }

  static Mesh wavy_cube(int n) {
    Mesh wavy = kuhn_cube(n);
    transform(wavy,
              [](const Vec3 &p) { return p + 0.1 * Vec3(std::sin(7 * p.y), std::sin(5 * p.z), std::sin(6 * p.x)); });
    set_scalars(wavy, waves);
    return wavy;
  }

  static std::size_t vertex_at(const Mesh &of, const Vec3 &p) {
    return std::size_t(std::find(of.points.begin(), of.points.end(), p) - of.points.begin());
  }

  double volume6(const Tet &t) const {
    const auto at = [&](int k) { return mesh.points[std::size_t(t[std::size_t(k)])]; };
    return det(at(0), at(1), at(2), at(3));
  }

  std::vector<std::uint8_t> stays;
  double least = 0;
  bool guarded = false;
  TetMesh mesh{host.memory};
  Array<std::int32_t> origin{&host.memory};
};

TEST_F(LowerDeviation, AVertexThatIsOffGoesBack) {
  Mesh cube = kuhn_cube(2);
  set_scalars(cube, waves);
  start_with(cube);
  for (double off : {0.2, -0.2}) {
    const std::size_t v = vertex_at(cube, {0.5, 0.5, 1});
    const double left = lower(std::int64_t(cube.tets.size()), [&](Mesh &changed) { changed.points[v].z += off; });
    EXPECT_NEAR(left, 0, 1e-15);
    EXPECT_EQ(mesh.points[v], cube.points[v]);
    EXPECT_NEAR(mesh.scalars[v], cube.scalars[v], 1e-15);
    EXPECT_EQ(mesh.tets.size(), cube.tets.size());
  }
}

/// A wall that was dented goes back, but for where one that stays was drawn out beyond it.
TEST_F(LowerDeviation, GuardedTheBoundaryDoesNotCrossItself) {
  Mesh cubes = kuhn_cube(2), other = cubes;
  transform(other, [](const Vec3 &p) { return p + Vec3(1.1, 0, 0); });
  append(cubes, other);
  set_scalars(cubes, waves);
  start_with(cubes);
  const std::size_t dent = vertex_at(cubes, {1, 0.5, 0.5}), peak = vertex_at(cubes, {1.1, 0.5, 0.5});
  stays.assign(cubes.points.size(), 0);
  stays[peak] = 1;
  for (bool is : {false, true}) {
    guarded = is;
    lower(std::int64_t(cubes.tets.size()), [&](Mesh &changed) {
      changed.points[dent].x = 0.7;
      changed.points[peak].x = 0.96;
    });
    EXPECT_EQ(crosses_itself(mesh), !guarded);
    EXPECT_EQ(mesh.points[peak].x, 0.96);
    EXPECT_GT(mesh.points[dent].x, 0.75);
  }
}

/// A pyramid on a wall of the cube, which the coarse mesh lacks.
TEST_F(LowerDeviation, AVertexThatIsLackingComesWhereThereIsRoomForIt) {
  Mesh cube = kuhn_cube(1);
  Mesh with_peak = cube;
  const Vec3 peak(1.1, 0.6, 0.3);
  const auto at = [&](double y, double z) { return std::int32_t(vertex_at(cube, {1, y, z})); };
  with_peak.points.push_back(peak);
  // The wall's diagonal runs from (0, 0) to (1, 1), and the peak is over the triangle of (1, 0).
  with_peak.tets.push_back({at(0, 0), at(1, 0), at(1, 1), std::int32_t(cube.points.size())});
  set_scalars(with_peak, [](const Vec3 &p) { return 2 * p.x + p.y; });
  start_with(with_peak);
  const auto lacking = [](Mesh &changed) {
    changed.points.pop_back();
    changed.scalars.pop_back();
    changed.tets.pop_back();
  };
  const auto tets = std::int64_t(cube.tets.size());
  const double by_moves = lower(tets, lacking);
  EXPECT_GT(by_moves, 0.05);
  EXPECT_LT(by_moves, 0.1);
  EXPECT_EQ(mesh.points.size(), cube.points.size());
  EXPECT_LT(lower(tets + 2, lacking), 1e-15);
  EXPECT_EQ(mesh.points.back(), peak);
  EXPECT_EQ(mesh.scalars.back(), with_peak.scalars.back());
  EXPECT_EQ(origin.back(), std::int32_t(cube.points.size()));
  stays.assign(with_peak.points.size(), 1);  // and so the triangle
  EXPECT_NEAR(lower(tets + 2, lacking), 0.1, 1e-15);
  EXPECT_EQ(mesh.points.size(), cube.points.size());
}

/// Two pyramids over one triangle, the one nearly as high as the other: neither is in the other's way.
TEST_F(LowerDeviation, VerticesThatAreLackingTogetherCome) {
  const Mesh cube = kuhn_cube(1);
  const auto at = [&](double y, double z) { return std::int32_t(vertex_at(cube, {1, y, z})); };
  const std::int32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), middle = 8, first = 9, second = 10;
  Mesh with_peaks = cube;
  for (const Vec3 &p : {Vec3(1, 2.0 / 3, 1.0 / 3), Vec3(1.1, 5.0 / 9, 1.0 / 9), Vec3(1.098, 8.0 / 9, 4.0 / 9)})
    with_peaks.points.push_back(p);
  for (std::size_t t = cube.tets.size(); t-- > 0;) {
    const auto number = [&](std::int32_t v) {
      return std::find(cube.tets[t].begin(), cube.tets[t].end(), v) - cube.tets[t].begin();
    };
    if (number(a) == 4 || number(b) == 4 || number(c) == 4) continue;
    with_peaks.tets.erase(with_peaks.tets.begin() + std::ptrdiff_t(t));
    for (std::int32_t v : {a, b, c}) {
      Tet part = cube.tets[t];
      part[std::size_t(number(v))] = middle;
      with_peaks.tets.push_back(part);
    }
  }
  with_peaks.tets.push_back({a, b, middle, first});
  with_peaks.tets.push_back({b, c, middle, second});
  set_scalars(with_peaks, [](const Vec3 &p) { return 2 * p.x + p.y; });
  start_with(with_peaks);
  const double left = lower(std::int64_t(cube.tets.size()) + 6, [&](Mesh &changed) { changed = cube; });
  EXPECT_LT(left, 0.065);  // 0.073 where only what comes within nine tenths of the largest may stay
}

/// It cannot go back all the way, past a vertex inside.
TEST_F(LowerDeviation, AVertexGoesBackAsFarAsTetsLetIt) {
  Mesh cube = kuhn_cube(2);
  const std::size_t outer = vertex_at(cube, {0.5, 0.5, 1}), inner = vertex_at(cube, {0.5, 0.5, 0.5});
  set_scalars(cube, waves);
  start_with(cube);
  constexpr double off = 0.8, inside_is_off = 0.565;  // no part of the way that is tried leads less far
  const double left = lower(std::int64_t(cube.tets.size()), [&](Mesh &changed) {
    changed.points[outer].z += off;
    changed.points[inner].z = 1 + inside_is_off;
  });
  EXPECT_LT(left, 0.9 * off);
  EXPECT_GE(left, inside_is_off);
  for (const Tet &t : mesh.tets) EXPECT_GT(volume6(t), 0);
}

/// All vertices are where they should be, but the walls have their other diagonals.
TEST_F(LowerDeviation, AMiddleThatIsOffComesNearerWhereThereIsRoomForIt) {
  Mesh cube = kuhn_cube(1);
  const auto mirrored = [&](std::int32_t v) {
    const Vec3 p = cube.points[std::size_t(v)];
    return std::int32_t(vertex_at(cube, {1 - p.x, p.y, p.z}));
  };
  std::vector<Tet> others;
  for (const Tet &t : cube.tets) others.push_back({mirrored(t[1]), mirrored(t[0]), mirrored(t[2]), mirrored(t[3])});
  cube.points[vertex_at(cube, {1, 1, 1})] = {1.2, 1.3, 1.4};
  set_scalars(cube, waves);
  start_with(cube);
  const auto distance_with = [&](std::size_t more) {
    lower(std::int64_t(cube.tets.size() + more), [&](Mesh &changed) { changed.tets = others; });
    Surface lowered(host.memory);
    boundary_of(mesh);
    make_surface({mesh.points, mesh.scalars, mesh.tets, 1}, mesh.boundary, host.job, lowered);
    return largest_deviation(surface, tree, lowered, TreeOnDemand(lowered), Samples::between_too, host.job);
  };
  least = std::numeric_limits<double>::infinity();  // nothing is served
  const double before = distance_with(0);
  least = 0;
  const double after = distance_with(20);
  EXPECT_GT(before, 0.05);
  EXPECT_LT(after, 0.95 * before);
  EXPECT_GT(mesh.points.size(), cube.points.size());
}

TEST_F(LowerDeviation, LowersWhatCollapsesLeft) {
  start_with(wavy_cube(12));
  double all = 1;  // one may be stuck
  for (double ratio : {0.5, 0.2, 0.1}) {
    lowered = 0;
    CoarseSolid without(host.memory), with(host.memory);
    ASSERT_TRUE(decimate(ratio, host, without));
    lowered = options.tets + options.tets / 100;
    ASSERT_TRUE(decimate(ratio, host, with));
    expect_sound(with);
    EXPECT_LE(with.deviation, without.deviation) << ratio;
    all *= with.deviation / without.deviation;
    EXPECT_LE(with.mesh.tets.size(), std::size_t(lowered));
    const double measured =
        largest_deviation(surface, tree, with.surface, TreeOnDemand(with.surface), Samples::vertices, host.job);
    EXPECT_NEAR(with.deviation, measured, 1e-12 * measured);
    EXPECT_EQ(with.origin.size(), with.mesh.points.size());
    for (std::size_t v = 0; v < with.origin.size(); v++) {
      const std::int32_t at = with.origin[v];
      EXPECT_TRUE(at < 0 || with.mesh.points[v] == original.points[std::size_t(at)]);
    }
  }
  EXPECT_LT(all, 0.8);
}

/// Where nothing is lowered otherwise, what is farther off than 2 % of the diagonal is.
TEST_F(LowerDeviation, LowersWhatStandsOutInAnyCase) {
  start_with(wavy_cube(12));
  const double far = 0.02 * box_of(surface.points).diagonal();
  int were_far = 0;
  for (double ratio : {0.1, 0.05, 0.03, 0.02, 0.015, 0.01}) {
    CoarseSolid with(host.memory), without(host.memory);
    SolidHistory history(host.memory);
    ASSERT_TRUE(decimate(ratio, host, with)) << failure;
    const MeshView view = original.view();
    decimate_solid({view, boundary, surface, topology, tree, contacts}, options, history, host.job, without.mesh,
                   without.origin);
    make_surface({without.mesh.points, without.mesh.scalars, without.mesh.tets, 1}, without.mesh.boundary, host.job,
                 without.surface);
    const double before =
        largest_deviation(surface, tree, without.surface, TreeOnDemand(without.surface), Samples::vertices, host.job);
    expect_sound(with);
    EXPECT_EQ(with.mesh.tets.size(), without.mesh.tets.size());
    if (before <= far)
      EXPECT_EQ(with.deviation, before);
    else
      EXPECT_LT(with.deviation, before);
    were_far += before > far;
  }
  EXPECT_GT(were_far, 0);
  EXPECT_LT(were_far, 6);
}

/// Vertices that a bound has restored, as those that the host keeps.
TEST_F(LowerDeviation, LeavesRestoredVerticesWhereTheyAre) {
  start_with(wavy_cube(12));
  std::vector<std::uint8_t> restored(original.points.size(), 0);
  for (std::size_t s = 0; s < surface.points.size(); s += 23) restored[std::size_t(surface.origin[s])] = 1;
  options.restored = {restored.data(), restored.size()};
  CoarseSolid coarse(host.memory);
  decimate(0.01, host, coarse);
  ASSERT_TRUE(coarse.is_sound) << failure;
  for (std::size_t v = 0; v < restored.size(); v++) {
    const auto left = std::count(coarse.origin.begin(), coarse.origin.end(), std::int32_t(v));
    EXPECT_TRUE(!restored[v] || left == 1) << v;
  }
}

/// Bumps on one wall of a cube are as large as dents in the other, which stay.
TEST_F(LowerDeviation, KeepsTheVolume) {
  constexpr int cells = 6;
  Mesh cube = kuhn_cube(cells);
  set_scalars(cube, waves);
  start_with(cube);
  stays.assign(cube.points.size(), 0);
  lower(std::int64_t(cube.tets.size()), [&](Mesh &changed) {
    for (int i = 1; i < cells; i += 2)
      for (int j = 1; j < cells; j += 2) {
        const double x = double(i) / cells, y = double(j) / cells;
        changed.points[vertex_at(cube, {x, y, 1})].z += 0.1;
        changed.points[vertex_at(cube, {x, y, 0})].z += 0.1;
        stays[vertex_at(cube, {x, y, 0})] = 1;
      }
  });
  int bumps = 0;
  for (const Vec3 &p : mesh.points) bumps += p.z > 1;
  EXPECT_GT(bumps, 0);
  EXPECT_LT(bumps, 9);
  Mesh now = cube;
  now.points.assign(mesh.points.begin(), mesh.points.end());
  EXPECT_NEAR(volume_of(now), 1, 0.0051);
}

}  // namespace
}  // namespace tetlod
