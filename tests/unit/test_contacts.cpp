// Which solids are in contact, and which overlap.
#include <gtest/gtest.h>

#include <cmath>

#include "contacts.hpp"
#include "meshes.hpp"
#include "nested_solids.hpp"
#include "remesh_surfaces.hpp"
#include "status.hpp"
#include "surface_distance.hpp"

namespace tetlod {
namespace {

using namespace test;
using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// A surface of several components, numbered as they are added.
class ContactsTest : public testing::Test {
 protected:
  void add(const Surface &other, bool turned = false) { append(surface_, other, turned); }

  SurfaceTopology topology(Job &job) {
    complete(surface_, [](const Vec3 &) { return 0.0; });
    SurfaceTopology of(host_.memory);
    find_topology(surface_.points, surface_.triangles, job, of);
    return of;
  }

  Pairs pairs(Host &host) {
    const SurfaceTopology of = topology(host.job);
    TreeOnDemand tree(surface_);
    const Contacts contacts = find_contacts(surface_, of, tree, true, host.job);
    Pairs found;
    for (std::int32_t a = 0; a < of.components; a++)
      for (std::int32_t b = a; b < of.components; b++)
        if (contacts.between(a, b)) found.push_back({a, b});
    EXPECT_EQ(contacts.empty(), found.empty());
    return found;
  }
  Pairs pairs() { return pairs(host_); }

  /// With solids in contact, and without.
  std::pair<bool, bool> is_refused() {
    const SurfaceTopology of = topology(host_.job);
    TreeOnDemand tree(surface_);
    const auto refuses = [&](const auto &refuse) {
      try {
        refuse();
        return false;
      } catch (const Error &error) {
        EXPECT_EQ(error.status(), Status::mesh_intersecting);
        return true;
      }
    };
    ContactsOnDemand contacts;
    return {refuses([&] { refuse_overlaps(surface_, of, contacts, tree, 0, host_.job); }),
            refuses([&] { refuse_intersections(surface_, of, tree, 0, host_.job); })};
  }

  Host host_;
  Surface surface_{host_.memory};
};

constexpr std::pair<bool, bool> in_contact(false, true), overlapping(true, true), apart(false, false);
const Pairs one_pair = {{0, 1}};

/// Any turn: then the planes in which they touch are rounded.
Vec3 turned(const Vec3 &p) {
  const Vec3 axis = glm::normalize(Vec3(0.3, -0.5, 0.8));
  const double angle = 0.7;
  return std::cos(angle) * p + std::sin(angle) * glm::cross(axis, p) + (1 - std::cos(angle)) * glm::dot(axis, p) * axis;
}

TEST_F(ContactsTest, BoxesThatTouchInAnAreaAreInContact) {
  add(box(host_.memory, 3));
  add(box(host_.memory, 2, Vec3(1, 0.25, 0.125), Vec3(2, 1.25, 1.125)));
  add(box(host_.memory, 2, Vec3(3, 0, 0), Vec3(4, 1, 1)));
  EXPECT_EQ(pairs(), one_pair);
  EXPECT_EQ(is_refused(), in_contact);
  transform(surface_, turned);
  EXPECT_EQ(pairs(), one_pair);
  EXPECT_EQ(is_refused(), in_contact);
  Host two(2);
  EXPECT_EQ(pairs(two), one_pair);
}

TEST_F(ContactsTest, BoxesThatReachIntoEachOtherALittleAreInContact) {
  const auto reaching = [&](double reach) {
    surface_ = box(host_.memory, 4);
    add(box(host_.memory, 3, Vec3(1 - reach * std::sqrt(6), 0.25, 0.125), Vec3(2, 0.75, 0.875)));
    return pairs();
  };
  EXPECT_EQ(reaching(-1e-5), Pairs());
  EXPECT_EQ(reaching(0), one_pair);
  EXPECT_EQ(reaching(1e-7), one_pair);
  EXPECT_EQ(reaching(0.0009), one_pair);
  EXPECT_EQ(is_refused(), in_contact);
  EXPECT_EQ(reaching(0.0011), Pairs());
  EXPECT_EQ(is_refused(), overlapping);
  EXPECT_EQ(reaching(0.1), Pairs());
}

/// A box that is bent to a ring, whose ends reach into each other so far.
TEST_F(ContactsTest, ARingThatReachesIntoItselfALittleIsInContactWithItself) {
  const auto reaching = [&](double reach) {
    surface_ = box(host_.memory, 16);
    transform(surface_, [&](const Vec3 &p) {
      const double angle = -p.x * (6.283185307179586 + reach), radius = 1 + 0.5 * p.y;
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), p.z);
    });
    return pairs();
  };
  const Pairs itself = {{0, 0}};
  EXPECT_EQ(reaching(-1e-4), Pairs());
  EXPECT_EQ(is_refused(), apart);
  for (const double reach : {1e-7, 1e-4, 1e-3}) {
    EXPECT_EQ(reaching(reach), itself) << reach;
    EXPECT_EQ(is_refused(), in_contact) << reach;
  }
  EXPECT_EQ(reaching(0.02), Pairs());
  EXPECT_EQ(is_refused(), overlapping);
}

/// Their triangles touch, and do not reach into each other anywhere.
TEST_F(ContactsTest, BoxesThatOverlapAlongTheirEdgesAreNot) {
  for (const Vec3 &shift : {Vec3(0.5, 0.25, 0.25), Vec3(0.5, 0, 0), Vec3(0.25, 0.25, 0), Vec3(0, 0, 0)}) {
    surface_ = box(host_.memory, 4);
    add(box(host_.memory, 4, shift, shift + Vec3(1)));
    EXPECT_EQ(pairs(), Pairs()) << shift.x << " " << shift.y << " " << shift.z;
    EXPECT_EQ(is_refused(), overlapping);
  }
}

TEST_F(ContactsTest, ABoxThatTouchesAnotherFromWithinIsNot) {
  for (double low : {0.0, 0.125}) {
    surface_ = box(host_.memory, 4);
    add(box(host_.memory, 2, Vec3(0.25, 0.25, low), Vec3(0.75, 0.75, 0.5)));
    EXPECT_EQ(pairs(), Pairs());
    EXPECT_EQ(is_refused(), overlapping);
  }
}

TEST_F(ContactsTest, WhatFillsACavityIsInContactWithIt) {
  add(box(host_.memory, 4));
  add(box(host_.memory, 3, Vec3(0.25), Vec3(0.75)), true);
  EXPECT_EQ(is_refused(), apart);
  add(box(host_.memory, 2, Vec3(0.25), Vec3(0.75)));
  EXPECT_EQ(pairs(), Pairs({{1, 2}}));
  EXPECT_EQ(is_refused(), in_contact);
}

TEST_F(ContactsTest, AThinPlateIsInContactWithWhatItLiesOn) {
  add(box(host_.memory, 4));
  add(box(host_.memory, 3, Vec3(0.25, 0.25, 1), Vec3(0.75, 0.75, 1 + 1e-5)));
  EXPECT_EQ(pairs(), one_pair);
  EXPECT_EQ(is_refused(), in_contact);
}

/// Bricks in bonds: two touch where their intervals do along all axes.
TEST_F(ContactsTest, OfManyBricksThoseThatTouchAreInContact) {
  std::vector<Vec3> low;
  for (int z = 0; z < 4; z++)
    for (int y = 0; y < 4; y++)
      for (int x = 0; x < 4; x++) low.push_back(Vec3(x + 0.5 * ((y + z) % 2), y + 0.25 * (z % 2), z));
  for (std::size_t i = 0; i < low.size(); i++) add(box(host_.memory, 1 + int(i % 3), low[i], low[i] + Vec3(1)));
  Pairs expected;
  for (std::size_t a = 0; a < low.size(); a++)
    for (std::size_t b = a + 1; b < low.size(); b++) {
      const Vec3 between = glm::abs(low[a] - low[b]);
      if (std::max({between.x, between.y, between.z}) <= 1) expected.push_back({a, b});
    }
  EXPECT_EQ(pairs(), expected);
  EXPECT_EQ(is_refused(), in_contact);
}

/// Beside one pair in contact, another that overlaps: then there are none.
TEST_F(ContactsTest, OverlapsBesideContactsAreRefused) {
  add(box(host_.memory, 4));
  add(box(host_.memory, 3, Vec3(1, 0.1, 0.2), Vec3(2, 1.1, 1.2)));
  EXPECT_EQ(pairs(), one_pair);
  add(box(host_.memory, 3, Vec3(-0.9, 0.3, 0.1), Vec3(0.1, 0.8, 0.9)));
  EXPECT_EQ(pairs(), Pairs());
  EXPECT_EQ(is_refused(), overlapping);
}

/// Where they have vertices and edges in common the surface is one, but for its cut: quads of two boxes, that are cut
/// along different diagonals.
TEST_F(ContactsTest, QuadsThatAreCutAlongDifferentDiagonalsAreInContact) {
  const double corner[8][3] = {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}, {0, 0.5, 0.5}, {2, 0.5, 0.5}};
  for (std::size_t v = 0; v < 6; v++) surface_.points.push_back(Vec3(corner[v][0], corner[v][1], corner[v][2]));
  // Pyramids from the two apexes to the square.
  for (const Triangle &t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{1, 0, 3}, Triangle{1, 3, 2}})
    surface_.triangles.push_back(t);
  for (std::int32_t k = 0; k < 4; k++) {
    const std::int32_t next = (k + 1) % 4;
    surface_.triangles.push_back({next, k, 4});
    surface_.triangles.push_back({k, next, 5});
  }
  const SurfaceTopology of = topology(host_.job);
  EXPECT_EQ(of.components, 2);
  EXPECT_EQ(of.nonmanifold_edges, 4);
  EXPECT_EQ(pairs(), one_pair);
  EXPECT_EQ(is_refused(), in_contact);
}

/// Whatever the order, and however coarse they have become; also where all vertices are those of another, too.
TEST_F(ContactsTest, ComponentsKnowWhatTheyWere) {
  add(box(host_.memory, 4));
  add(box(host_.memory, 3, Vec3(1, 0.1, 0.2), Vec3(2, 1.1, 1.2)));
  const auto first = std::int32_t(surface_.points.size());
  add(box(host_.memory, 1, Vec3(0.25, 0.25, 1), Vec3(0.75, 0.75, 1.25)));
  // The lower corners are vertices of the first box.
  for (Triangle &t : surface_.triangles)
    for (std::int32_t &v : t)
      for (std::int32_t other = 0; v >= first && other < first; other++)
        if (surface_.points[std::size_t(v)] == surface_.points[std::size_t(other)]) v = other;
  const SurfaceTopology of = topology(host_.job);
  ASSERT_EQ(of.components, 3);
  // The same in another order, each vertex with its name.
  Array<Triangle> triangles(&host_.memory);
  std::vector<std::int32_t> expected;
  for (const std::int32_t component : {2, 0, 1})
    for (std::size_t t = 0; t < surface_.triangles.size(); t++)
      if (of.component[t] == component) {
        triangles.push_back(surface_.triangles[t]);
        expected.push_back(component);
      }
  SurfaceTopology of_these(host_.memory);
  find_topology(surface_.points, triangles, host_.job, of_these);
  const Array<std::int32_t> was = original_components(triangles, of_these, surface_.origin, surface_, of, host_.memory);
  EXPECT_TRUE(std::equal(was.begin(), was.end(), expected.begin(), expected.end()));
  // By the vertices that are of one alone, of those that are not known nothing is.
  const Array<std::int32_t> of_vertices = components_of_vertices(surface_, of, surface_.points.size(), host_.memory);
  const Array<std::int32_t> by_corner = components_of_triangles(triangles, surface_.origin, of_vertices, host_.memory);
  for (std::size_t t = 0; t < triangles.size(); t++) {
    const bool shares_all = std::all_of(triangles[t].begin(), triangles[t].end(),
                                        [&](std::int32_t v) { return of_vertices[std::size_t(v)] < 0; });
    EXPECT_EQ(by_corner[t], shares_all ? -1 : expected[t]);
  }
}

/// All triangles at the edge meet all others: that is told once for two of the parts.
TEST_F(ContactsTest, PartsThatMeetAtAnEdgeTakeLittleMemory) {
  constexpr int parts = 200;
  Mesh wheel;
  for (int i = 0; i < parts; i++) {
    const double turn = 2 * std::acos(-1.0) / parts;
    for (const double z : {0.0, 1.0}) wheel.points.push_back(Vec3(0, 0, z));
    for (const double at : {i * turn, (i + 0.5) * turn}) wheel.points.push_back(Vec3(std::cos(at), std::sin(at), 0.5));
    wheel.tets.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  wheel.scalars.resize(wheel.points.size(), 0);
  surface_ = surface_of(wheel, host_.job);
  const SurfaceTopology of = topology(host_.job);
  TreeOnDemand tree(surface_);
  tree.get(host_.job);
  host_.memory.reset_peak();
  const std::uint64_t before = host_.memory.in_use();
  const Contacts contacts = find_contacts(surface_, of, tree, false, host_.job);
  EXPECT_LT(host_.memory.peak() - before, 64u * parts * parts);
  for (std::int32_t a = 0; a < parts; a++)
    for (std::int32_t b = 0; b < parts; b++) EXPECT_EQ(contacts.between(a, b), a != b);
}

}  // namespace
}  // namespace tetlod
