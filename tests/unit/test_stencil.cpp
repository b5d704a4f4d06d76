// 3.5  Points as means of original vertices, and what fields of any layout become there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "brute_force.hpp"
#include "extract_boundary.hpp"
#include "geometry.hpp"
#include "meshes.hpp"
#include "transfer.hpp"

namespace tetlod {
namespace {

using namespace test;

class Stencils : public testing::Test {
 protected:
  Host host;
  std::mt19937_64 random{1};
  Mesh mesh = kuhn_cube(6);
  std::vector<Vec3> points;

  void scatter(int count, double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    for (int i = 0; i < count; i++) points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
  }

  Stencil find(std::int64_t leaf, Host &with) {
    Boundary boundary(with.memory);
    extract_boundary(mesh.view(), with.job, boundary);
    Stencil stencil(with.memory);
    find_stencils(mesh.view(), boundary.triangles, {points.data(), points.size()}, {}, leaf, with.job, stencil);
    EXPECT_EQ(stencil.ids.size(), points.size());
    EXPECT_EQ(stencil.weights.size(), points.size());
    return stencil;
  }
  Stencil find(std::int64_t leaf = 500) { return find(leaf, host); }

  Vec3 mean(const Stencil &stencil, std::size_t i) const {
    Vec3 p(0);
    for (std::size_t k = 0; k < 4; k++) p += stencil.weights[i][k] * mesh.points[std::size_t(stencil.ids[i][k])];
    return p;
  }

  void expect_unity(const Stencil &stencil) const {
    for (std::size_t i = 0; i < stencil.ids.size(); i++) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; k++) {
        ASSERT_GE(stencil.weights[i][k], 0);
        ASSERT_TRUE(stencil.ids[i][k] >= 0 && std::size_t(stencil.ids[i][k]) < mesh.points.size());
        sum += stencil.weights[i][k];
      }
      ASSERT_NEAR(sum, 1, 4e-16);
    }
  }
};

TEST_F(Stencils, APointIsTheMeanOfItsVertices) {
  shuffle(mesh, 1);
  scatter(3000, 0, 1);
  const Stencil stencil = find();
  expect_unity(stencil);
  for (std::size_t i = 0; i < points.size(); i++) ASSERT_LT(glm::length(mean(stencil, i) - points[i]), 1e-14) << i;
}

TEST_F(Stencils, AVertexIsItself) {
  points = mesh.points;
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
  const Stencil stencil = find();
  for (std::size_t i = 0; i < points.size(); i++) {
    EXPECT_EQ(stencil.ids[i][0], std::int32_t(i));
    EXPECT_EQ(stencil.weights[i], (std::array<double, 4>{1, 0, 0, 0}));
  }
}

/// Also where the tet beside it holds the vertex on its face: meshes that do not conform have such.
TEST_F(Stencils, AVertexOnTheFaceOfAnotherTetIsItself) {
  mesh = {};
  mesh.points = {Vec3(0, 0, 0), Vec3(3, 0, 0),  Vec3(0, 3, 0),  Vec3(0, 0, 3),
                 Vec3(1, 1, 0), Vec3(3, 1, -1), Vec3(1, 3, -1), Vec3(1, 1, -2)};
  mesh.scalars.assign(8, 0);
  mesh.tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  points = {mesh.points[4]};
  const Stencil stencil = find();
  EXPECT_EQ(stencil.ids[0][0], 4);
  EXPECT_EQ(stencil.weights[0][0], 1);
}

TEST_F(Stencils, OutsideIsTheNearestOfTheBoundary) {
  scatter(500, -2, 3);
  const Stencil stencil = find();
  expect_unity(stencil);
  Boundary boundary(host.memory);
  extract_boundary(mesh.view(), host.job, boundary);
  int outside = 0;
  for (std::size_t i = 0; i < points.size(); i++) {
    const Vec3 at = glm::clamp(points[i], Vec3(0.0), Vec3(1.0));
    if (at == points[i]) continue;
    outside++;
    ASSERT_LT(glm::length(mean(stencil, i) - at), 1e-13);
    const auto &weights = stencil.weights[i];
    EXPECT_EQ(*std::min_element(weights.begin(), weights.end()), 0);
  }
  EXPECT_GT(outside, 400);
}

TEST_F(Stencils, ThreadsAndRunsOfTetsDoNotMatter) {
  mesh = kuhn_cube(12);  // several blocks of tets
  scatter(5000, -0.1, 1.1);
  for (int crowd = 0; crowd < 200; crowd++) points.push_back(Vec3(0.51, 0.52, 0.5 + 1e-5 * crowd));
  points.insert(points.end(), mesh.points.begin(), mesh.points.begin() + 100);
  Host two(2);
  const Stencil one = find();
  const auto expect_same = [&](const Stencil &other) {
    EXPECT_EQ(std::memcmp(one.ids.data(), other.ids.data(), one.ids.size() * sizeof one.ids[0]), 0);
    EXPECT_EQ(std::memcmp(one.weights.data(), other.weights.data(), one.weights.size() * sizeof one.weights[0]), 0);
  };
  expect_same(find(500, two));
  for (std::int64_t leaf : {1, 7, 1000000}) expect_same(find(leaf));
}

TEST_F(Stencils, BruteForceHoldsNoBetterTet) {
  mesh = random_solid(4, 0.6, 3);
  scatter(400, 0, 4);
  const Stencil stencil = find();
  for (std::size_t i = 0; i < points.size(); i++) {
    const bool held = std::any_of(mesh.tets.begin(), mesh.tets.end(), [&](const Tet &t) {
      double w[4];
      return barycentric(points[i], mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])],
                         mesh.points[std::size_t(t[2])], mesh.points[std::size_t(t[3])], w) &&
             std::min({w[0], w[1], w[2], w[3]}) >= 0;
    });
    if (held) {
      ASSERT_LT(glm::length(mean(stencil, i) - points[i]), 1e-14);
    } else {
      ASSERT_GT(glm::length(mean(stencil, i) - points[i]), 0);
    }
  }
}

TEST_F(Stencils, NoPointsNoEntries) { EXPECT_TRUE(find().ids.empty()); }

// Moving fields

class Transfer : public Stencils {
 protected:
  void SetUp() override { scatter(1000, -0.1, 1.1); }

  static double linear(const Vec3 &p, int c) { return 1 + c + (c % 3 + 1) * p.x - 2 * p.y + 0.25 * p.z * c; }
};

TEST_F(Transfer, LinearFieldsOfManyComponents) {
  const Stencil stencil = find();
  for (int components : {1, 3, 9, 64}) {
    const auto width = std::size_t(components);
    std::vector<double> from, to(points.size() * width);
    for (const Vec3 &p : mesh.points)
      for (int c = 0; c < components; c++) from.push_back(linear(p, c));
    transfer(stencil, packed_array(from.data(), mesh.points.size(), components),
             packed_array(to.data(), points.size(), components), host.job);
    for (std::size_t i = 0; i < points.size(); i++)
      for (std::size_t c = 0; c < width; c++) ASSERT_NEAR(to[i * width + c], linear(mean(stencil, i), int(c)), 1e-12);
  }
}

/// Each layout and type gives what packed doubles give, rounded, and nothing between the elements is touched.
TEST_F(Transfer, AnyLayoutAndType) {
  const Stencil stencil = find();
  std::vector<float> from;
  for (const Vec3 &p : mesh.points)
    for (int c = 0; c < 3; c++) from.push_back(float(linear(p, c)));
  const std::size_t vertices = mesh.points.size(), count = points.size();
  StridedArray packed = strided(from.data(), vertices, 3, 3, ElementType::float32);
  std::vector<double> wanted(3 * count);
  transfer(stencil, packed, packed_array(wanted.data(), count, 3), host.job);
  std::vector<double> separate(3 * vertices);  // x x y y z z, backwards
  for (std::size_t v = 0; v < vertices; v++)
    for (std::size_t c = 0; c < 3; c++) separate[c * vertices + vertices - 1 - v] = from[3 * v + c];
  StridedArray backwards = packed_array(separate.data() + vertices - 1, vertices, 3);
  backwards.tuple_stride = -std::int64_t(sizeof(double));
  backwards.component_stride = std::int64_t(vertices * sizeof(double));
  std::vector<float> spread(5 * count, -7.f);
  transfer(stencil, backwards, strided(spread.data(), count, 3, 5, ElementType::float32), host.job);
  for (std::size_t i = 0; i < count; i++) {
    for (std::size_t c = 0; c < 3; c++) ASSERT_EQ(spread[5 * i + c], float(wanted[3 * i + c]));
    ASSERT_EQ(spread[5 * i + 3], -7.f);
    ASSERT_EQ(spread[5 * i + 4], -7.f);
  }
}

TEST_F(Transfer, ConstantsStayWhatTheyAre) {
  const Stencil stencil = find();
  constexpr double most = std::numeric_limits<double>::max(), infinity = std::numeric_limits<double>::infinity();
  for (double constant : {913.1500244140625, 0.1, -1.0 / 3, -0.0, most, infinity, -infinity}) {
    const std::vector<double> from(mesh.points.size(), constant);
    std::vector<double> to(points.size());
    transfer(stencil, packed_array(from.data(), from.size(), 1), packed_array(to.data(), to.size(), 1), host.job);
    for (double value : to) ASSERT_EQ(std::memcmp(&value, &constant, sizeof value), 0) << value << " for " << constant;
  }
}

/// A vertex whose value is none spoils the tets around it and nothing else; its neighbours keep theirs.
TEST_F(Transfer, NanSpreadsNoFurtherThanItsTets) {
  points.insert(points.end(), mesh.points.begin(), mesh.points.end());
  const Stencil stencil = find();
  const std::int32_t sick = 100;
  std::vector<double> from(mesh.points.size(), 2), to(points.size());
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    from[sick] = bad;
    transfer(stencil, packed_array(from.data(), from.size(), 1), packed_array(to.data(), to.size(), 1), host.job);
    int spoilt = 0;
    for (std::size_t i = 0; i < points.size(); i++) {
      double share = 0;
      for (std::size_t k = 0; k < 4; k++) share += stencil.ids[i][k] == sick ? stencil.weights[i][k] : 0;
      ASSERT_EQ(to[i] == 2, share == 0) << i;
      spoilt += share > 0;
    }
    EXPECT_GT(spoilt, 1);
    const double itself = to[points.size() - mesh.points.size() + sick];
    EXPECT_EQ(std::memcmp(&itself, &bad, sizeof bad), 0);
  }
}

TEST_F(Transfer, ThreadsDoNotMatter) {
  points.clear();
  scatter(20000, 0, 1);
  const Stencil stencil = find();
  std::vector<double> from(mesh.points.size()), one(points.size()), two(points.size());
  for (double &value : from) value = double(random() % 1000) / 7;
  transfer(stencil, packed_array(from.data(), from.size(), 1), packed_array(one.data(), one.size(), 1), host.job);
  Host other(2);
  transfer(stencil, packed_array(from.data(), from.size(), 1), packed_array(two.data(), two.size(), 1), other.job);
  EXPECT_EQ(one, two);
}

TEST_F(Transfer, CopiesByNumber) {
  const std::vector<std::int32_t> ids = {3, 0, 3, 1};
  const std::vector<float> from = {0, 10, 1, 11, 2, 12, 3, 13};
  std::vector<double> to(8, -1);
  Array<std::int32_t> sources(ids.begin(), ids.end(), &host.memory);
  transfer(Span<const std::int32_t>(sources), strided(from.data(), 4, 2, 2, ElementType::float32),
           packed_array(to.data(), 4, 2), host.job);
  EXPECT_EQ(to, (std::vector<double>{3, 13, 0, 10, 3, 13, 1, 11}));
}

}  // namespace
}  // namespace tetlod
