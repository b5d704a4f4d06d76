// 3.4  Solids: which triangles are one, and which solid holds a point.
#include <algorithm>
#include <cmath>
#include <memory>

#include "remesh_fixture.hpp"
#include "remesh_parts.hpp"
#include "remesh_solids.hpp"

namespace tetlod {
namespace {

using namespace test;

class SolidsOfSurface : public testing::Test {
 protected:
  Memory memory;
  Parallel parallel{2};
  Job job{memory, parallel};
  Surface surface{memory};
  std::unique_ptr<SurfaceFacts> facts;
  std::unique_ptr<Solids> solids;

  void find() {
    solids = nullptr;
    facts = std::make_unique<SurfaceFacts>(check_surface(surface, job));
    solids = std::make_unique<Solids>(surface, *facts, job);
  }
  std::int32_t count() {
    find();
    return solids->count();
  }
  std::int32_t holding(const Vec3 &p) const {
    Solids::Crossings room{&const_cast<Memory &>(memory)};
    return solids->holding(p, room);
  }
  /// Of a point in no material, with one solid alone around it, nothing is asked.
  void expect_holding(const Vec3 &p, std::int32_t expected, long solids_around) const {
    if (expected >= 0 || solids_around != 1) {
      EXPECT_EQ(holding(p), expected);
    }
  }
  void add(const Surface &other, bool inside_out = false) { append(surface, other, inside_out); }
  void weld() { surface = Surface(welded(memory, surface)); }
};

TEST_F(SolidsOfSurface, One) {
  add(torus(memory, 12, 6));
  EXPECT_EQ(count(), 1);
}

TEST_F(SolidsOfSurface, Beside) {
  for (int i = 0; i < 4; i++) add(sphere(memory, 2, 1, Vec3(2.5 * i, 0.3 * i, 0)));
  EXPECT_EQ(count(), 4);
  for (std::size_t i = 0; i < surface.points.size(); i++)
    EXPECT_EQ(solids->of_point(i), std::int32_t(4 * i / surface.points.size()));
  for (int i = 0; i < 4; i++) EXPECT_EQ(holding(Vec3(2.5 * i, 0.3 * i, 0)), i);
  EXPECT_EQ(holding(Vec3(1.25, 0, 5)), -1);
}

TEST_F(SolidsOfSurface, CavitiesBelongToTheSolidAroundThem) {
  for (int i = 0; i < 2; i++) {
    add(box(memory, 2, Vec3(5 * i, 0, 0), Vec3(5 * i + 4, 4, 4)));
    add(box(memory, 1, Vec3(5 * i + 1, 1, 1), Vec3(5 * i + 2, 2, 2)), true);
    add(sphere(memory, 2, 0.5, Vec3(5 * i + 3, 3, 3)), true);
  }
  EXPECT_EQ(count(), 2);
  for (std::size_t i = 0; i < surface.points.size(); i++)
    EXPECT_EQ(solids->of_point(i), surface.points[i].x < 4.5 ? 0 : 1);
}

/// Eight boxes in each other, by turns a solid and its cavity, all about the same lines.
TEST_F(SolidsOfSurface, Nested) {
  for (int i = 0; i < 8; i++) add(box(memory, 2, Vec3(i - 10), Vec3(10 - i)), i % 2 == 1);
  EXPECT_EQ(count(), 4);
  for (std::size_t i = 0; i < surface.points.size(); i++)
    EXPECT_EQ(solids->of_point(i), std::int32_t(4 * i / surface.points.size()));
  for (int i = 0; i < 8; i++)
    for (const Vec3 &way : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(0.5, -1, 0.25)})
      expect_holding((9.5 - i) * way, i % 2 ? -1 : i / 2, i / 2 + 1);
  EXPECT_EQ(holding(Vec3(7, 0, 0)), -1) << "on a shell";
}

TEST_F(SolidsOfSurface, WhatTouchesIsOne) {
  for (const Vec3 &low : {Vec3(1, 1, 1), Vec3(1, 1, 0)}) {
    surface = Surface(memory);
    add(box(memory, 2));
    add(box(memory, 2, low, low + Vec3(1)));
    add(box(memory, 1, Vec3(5), Vec3(6)));
    weld();
    EXPECT_EQ(count(), 2);
    EXPECT_EQ(holding(Vec3(0.5)), holding(low + Vec3(0.5)));
    EXPECT_NE(holding(Vec3(0.5)), holding(Vec3(5.5)));
  }
}

/// A solid that hangs on the wall of a cavity, one that floats in it, and one in a cavity of the one that hangs.
TEST_F(SolidsOfSurface, InACavity) {
  add(box(memory, 6, Vec3(-3), Vec3(3)));
  add(box(memory, 4, Vec3(-2), Vec3(2)), true);
  Surface hanging = box(memory, 2, Vec3(-1), Vec3(0));
  for (Vec3 &p : hanging.points)
    if (p == Vec3(-1)) p = Vec3(-2);
  add(hanging);
  add(box(memory, 1, Vec3(-0.75), Vec3(-0.25)), true);
  add(box(memory, 1, Vec3(-0.6), Vec3(-0.4)));
  add(box(memory, 1, Vec3(1), Vec3(1.5)));
  weld();
  EXPECT_EQ(count(), 3);
  const std::int32_t outer = holding(Vec3(2.5)), inner = holding(Vec3(-0.5)), floating = holding(Vec3(1.25));
  EXPECT_EQ(holding(Vec3(-0.9)), outer) << "hangs on it";
  EXPECT_EQ((std::set<std::int32_t>{outer, inner, floating}), (std::set<std::int32_t>{0, 1, 2}));
}

TEST_F(SolidsOfSurface, WhatOverlapsIsLeftAlone) {
  const Surface inner = box(memory, 2, Vec3(0.25), Vec3(0.75));
  add(box(memory, 2));
  add(inner);  // in the material
  EXPECT_EQ(count(), 1);
  surface = Surface(memory);
  add(box(memory, 2));
  add(box(memory, 2, Vec3(5), Vec3(5.5)), true);  // a cavity in nothing
  EXPECT_EQ(count(), 1);
  surface = Surface(memory);
  add(box(memory, 2));
  add(inner, true);
  add(box(memory, 2, Vec3(0.3), Vec3(0.7)), true);  // a cavity in a cavity
  EXPECT_EQ(count(), 1);
}

TEST_F(SolidsOfSurface, TooFlatToTell) {
  add(box(memory, 2));
  Surface flat = box(memory, 2, Vec3(2), Vec3(3));
  transform(flat, [](const Vec3 &p) { return Vec3(p.x, p.y, p.x + p.y + 0x1p-49 * (p.z - 2)); });
  add(flat);
  EXPECT_EQ(count(), 1);
}

/// Cubes on a lattice, so that rays run along edges and through vertices of others; every third is in a cavity of a
/// larger one, and has one itself.
TEST_F(SolidsOfSurface, RaysThroughVerticesAndEdges) {
  std::vector<std::pair<Vec3, int>> cells;  // low corner, kind
  for (int i = 0; i < 27; i++) cells.push_back({4.0 * Vec3(i % 3, i / 3 % 3, i / 9), i % 3});
  for (const auto &[low, kind] : cells) {
    add(box(memory, 2, low, low + Vec3(3)));
    if (kind == 0) continue;
    add(box(memory, 2, low + Vec3(0.5), low + Vec3(2.5)), true);
    if (kind == 1) continue;
    add(box(memory, 1, low + Vec3(1), low + Vec3(2)));
    add(box(memory, 1, low + Vec3(1.25), low + Vec3(1.75)), true);
  }
  EXPECT_EQ(count(), 27 + 9);
  for (const auto &[low, kind] : cells)
    for (const double at : {0.25, 0.75, 1.125, 1.5}) {
      const std::int32_t found = holding(low + Vec3(at));
      const bool outer = kind == 0 || at < 0.5, inner = kind == 2 && at > 1 && at < 1.25;
      if (outer || inner) {
        EXPECT_GE(found, 0);
        if (at > 0.25) {
          EXPECT_EQ(found == holding(low + Vec3(0.25)), outer);
        }
      } else if (kind == 2 && at > 1) {
        EXPECT_EQ(found, -1);
      }
    }
}

/// Trees of boxes in boxes, with the answer known.
TEST_F(SolidsOfSurface, RandomNests) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 30; trial++) {
    surface = Surface(memory);
    std::vector<Box> boxes;
    std::int32_t expected = 0;
    const std::function<void(const Box &, int)> nest = [&](const Box &around, int depth) {
      const int parts = depth == 0 ? 3 : int(random() % 3);
      const Vec3 size = (around.high - around.low) / double(std::max(parts, 1));
      for (int i = 0; i < parts && depth < 6; i++) {
        Box own{around.low + Vec3(i * size.x, 0, 0) + 0.125 * size, {}};
        own.high = Vec3(around.low.x + (i + 1) * size.x, around.high.y, around.high.z) - 0.125 * size;
        boxes.push_back(own);
        expected += depth % 2 == 0;
        add(box(memory, 1 + int(random() % 2), own.low, own.high), depth % 2 == 1);
        nest(own, depth + 1);
      }
    };
    nest({Vec3(0), Vec3(8)}, 0);
    ASSERT_EQ(count(), expected);
    for (const Vec3 &p : random_points(memory, 200, 8, [](const Vec3 &q) { return q.x > 0 && q.y > 0 && q.z > 0; })) {
      const auto inside = std::count_if(boxes.begin(), boxes.end(), [&](const Box &b) {
        return glm::all(glm::greaterThan(p, b.low)) && glm::all(glm::lessThan(p, b.high));
      });
      const std::int32_t found = holding(p);
      if (inside % 2) {
        ASSERT_GE(found, 0);
      } else if (inside > 2) {
        ASSERT_EQ(found, -1) << "in a cavity of a solid in a cavity";
      }
    }
  }
}

TEST_F(SolidsOfSurface, AnyScale) {
  for (const double scale : {1e-200, 1e-30, 1e30, 1e300}) {
    surface = Surface(memory);
    for (int i = 0; i < 6; i++) add(box(memory, 2, Vec3(i - 10), Vec3(10 - i)), i % 2 == 1);
    transform(surface, [&](const Vec3 &p) { return scale * p; });
    EXPECT_EQ(count(), 3) << scale;
    EXPECT_EQ(holding(Vec3(scale * 7.5)), 1) << scale;
  }
}

// Parts

TEST_F(SolidsOfSurface, SmallOnesGoTogether) {
  for (int i = 0; i < 200; i++) add(box(memory, 1, Vec3(2 * i, 0, 0), Vec3(2 * i + 1, 1, 1)));
  add(sphere(memory, 8, 1, Vec3(-5)));
  Array<Vec3> samples(&memory);
  for (int i = 0; i < 200; i++) samples.push_back(Vec3(2 * i + 0.5, 0.5, 0.5));
  samples.push_back(Vec3(0, 50, 0));  // in none
  facts = std::make_unique<SurfaceFacts>(check_surface(surface, job));
  const RemeshParts parts(surface, *facts, samples, 100, job);
  ASSERT_EQ(parts.count(), 200u / 11 + 1 + 1) << "11 of 9 points and samples, and the sphere";
  std::size_t points = 0, given = 0, triangles = 0, alone = 0;
  for (std::size_t p = 0; p < parts.count(); p++) {
    const RemeshPart part = parts.part(p);
    const SurfaceFacts own = check_surface(part.surface, job);
    EXPECT_EQ(part.components, own.components);
    EXPECT_EQ(parts.size(p), part.surface.points.size() + part.samples.size());
    if (parts.size(p) > 100)
      alone++;
    else
      EXPECT_EQ(part.surface.points.size(), 8 * part.samples.size());
    points += part.surface.points.size();
    given += part.samples.size();
    triangles += part.surface.triangles.size();
  }
  EXPECT_EQ(alone, 1u);
  EXPECT_EQ(points, surface.points.size());
  EXPECT_EQ(triangles, surface.triangles.size());
  EXPECT_EQ(given, 200u);
}

TEST_F(SolidsOfSurface, FewPointsAreOnePart) {
  for (int i = 0; i < 5; i++) add(box(memory, 1, Vec3(2 * i, 0, 0), Vec3(2 * i + 1, 1, 1)));
  facts = std::make_unique<SurfaceFacts>(check_surface(surface, job));
  EXPECT_EQ(RemeshParts(surface, *facts, {}, 40, job).count(), 1u);
  EXPECT_EQ(RemeshParts(surface, *facts, {}, 39, job).count(), 2u);
}

}  // namespace
}  // namespace tetlod
