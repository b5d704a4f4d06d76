// 3.1  Sampling: the leaves of the paper's tree, one sample in each.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "meshes.hpp"
#include "sample_interior.hpp"
#include "sample_residual.hpp"

namespace tetlod {
namespace {

using namespace test;
using Ids = std::vector<std::int32_t>;

class Sample : public testing::Test {
 protected:
  Host host;
  Mesh mesh;
  Ids order;  // the vertices as sampling leaves them

  void random_mesh(int count, unsigned seed, const Field &field, double noise) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    mesh = Mesh();
    for (int i = 0; i < count; i++) {
      mesh.points.push_back(Vec3(uniform(random), uniform(random), uniform(random)));
      mesh.scalars.push_back(field(mesh.points.back()) + noise * uniform(random));
    }
  }

  Ids all() const {
    Ids ids(mesh.points.size());
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
  }

  Ids sample(const Ids &vertices, double variation) {
    order = vertices;
    Array<std::int32_t> samples(&host.memory);
    sample_interior(mesh.view(), {order.data(), order.size()}, variation, host.job, samples);
    return Ids(samples.begin(), samples.end());
  }

  double value(std::int32_t v) const { return mesh.scalars[std::size_t(v)]; }
  const Vec3 &point(std::int32_t v) const { return mesh.points[std::size_t(v)]; }

  double variation_of(const Ids &cell) const {
    const auto [low, high] =
        std::minmax_element(cell.begin(), cell.end(), [&](auto a, auto b) { return value(a) < value(b); });
    return value(*high) - value(*low);
  }

  /// Section 3.1 word by word, for values that are all different at points that are all different.
  void recurse(const Ids &cell, double variation, std::vector<Ids> &leaves) const {
    if (variation_of(cell) <= variation) return leaves.push_back(cell);
    const auto less = [&](std::int32_t a, std::int32_t b) { return value(a) < value(b); };
    const Vec3 low = point(*std::min_element(cell.begin(), cell.end(), less));
    const Vec3 high = point(*std::max_element(cell.begin(), cell.end(), less));
    int axis = 0;
    for (int k : {1, 2})
      if (std::abs(high[k] - low[k]) > std::abs(high[axis] - low[axis])) axis = k;
    const double cut = low[axis] + 0.5 * (high[axis] - low[axis]);
    Ids left, right;
    for (std::int32_t v : cell) (point(v)[axis] < cut ? left : right).push_back(v);
    recurse(left, variation, leaves);
    recurse(right, variation, leaves);
  }

  std::int32_t representative(const Ids &cell) const {
    long double sum = 0;
    for (std::int32_t v : cell) sum += value(v);
    const double mean = double(sum / double(cell.size()));
    return *std::min_element(cell.begin(), cell.end(), [&](std::int32_t a, std::int32_t b) {
      const double p = std::abs(value(a) - mean), q = std::abs(value(b) - mean);
      return p != q ? p < q : a < b;
    });
  }

  /// `order` falls into consecutive runs, each with one of the samples, in order, and of bounded variation: every run
  /// is made as long as it may be, which leaves the least to the next.
  void expect_runs(const Ids &samples, double variation) const {
    std::size_t at = 0;
    for (std::size_t i = 0; i < samples.size(); i++) {
      double low = value(samples[i]), high = low;
      bool has_sample = false;
      while (at < order.size() && (i + 1 == samples.size() || order[at] != samples[i + 1])) {
        low = std::min(low, value(order[at]));
        high = std::max(high, value(order[at]));
        if (high - low > variation) break;
        has_sample = has_sample || order[at] == samples[i];
        at++;
      }
      ASSERT_TRUE(has_sample) << "sample " << i;
    }
    ASSERT_EQ(at, order.size());
  }
};

double waves(const Vec3 &p) { return std::sin(5 * p.x) * std::cos(4 * p.y) + p.z * p.z; }

TEST_F(Sample, LeavesAreThePapers) {
  for (unsigned seed = 0; seed < 8; seed++) {
    random_mesh(3000, seed, waves, seed % 2 ? 0.5 : 1e-9);
    const double range = variation_of(all());
    for (double rho : {0.005, 0.05, 0.3, 0.99}) {
      std::vector<Ids> leaves;
      recurse(all(), rho * range, leaves);
      Ids expected;
      for (const Ids &leaf : leaves) expected.push_back(representative(leaf));
      EXPECT_EQ(sample(all(), rho * range), expected) << seed << " " << rho;
      expect_runs(expected, rho * range);
      Ids sorted = order;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(sorted, all()) << "not the same vertices any more";
    }
  }
}

TEST_F(Sample, OfSomeOfTheVertices) {
  random_mesh(1000, 3, waves, 1e-9);
  Ids odd;
  for (std::int32_t v = 1; v < 1000; v += 2) odd.push_back(v);
  std::vector<Ids> leaves;
  recurse(odd, 0.1, leaves);
  Ids expected;
  for (const Ids &leaf : leaves) expected.push_back(representative(leaf));
  EXPECT_EQ(sample(odd, 0.1), expected);
}

/// Values that tie in great number, on a lattice: there the tree depends on which of equals is taken, the bound not.
TEST_F(Sample, VariationIsBounded) {
  for (double rho : {0.0, 0.01, 0.1, 0.5}) {
    mesh = kuhn_cube(12);
    set_scalars(mesh, [](const Vec3 &p) { return std::floor(6 * p.x) + std::floor(3 * p.y * p.z); });
    const Ids samples = sample(all(), rho * 8);
    expect_runs(samples, rho * 8);
    EXPECT_EQ(std::set<std::int32_t>(samples.begin(), samples.end()).size(), samples.size());
    EXPECT_EQ(sample(all(), rho * 8), samples);
  }
}

TEST_F(Sample, OfAConstantFieldIsOne) {
  random_mesh(
      500, 1, [](const Vec3 &) { return 7.0; }, 0);
  for (double variation : {0.0, 1.0}) EXPECT_EQ(sample(all(), variation), Ids{0});
}

TEST_F(Sample, OfNothingIsNothing) {
  random_mesh(10, 1, waves, 0);
  EXPECT_TRUE(sample({}, 0.1).empty());
  EXPECT_EQ(sample({4}, 0), Ids{4});
}

TEST_F(Sample, AllWhenNoVariationIsAllowed) {
  random_mesh(2000, 5, waves, 1e-3);
  Ids samples = sample(all(), 0);
  std::sort(samples.begin(), samples.end());
  EXPECT_EQ(samples, all());
}

TEST_F(Sample, TheMeanDecides) {
  mesh.points = {Vec3(0), Vec3(1), Vec3(2), Vec3(3)};
  mesh.scalars = {0, 10, 4, 5};  // mean 4.75
  EXPECT_EQ(sample(all(), 10), Ids{3});
  mesh.scalars = {0, 6, 2, 4};  // mean 3: a tie
  EXPECT_EQ(sample(all(), 10), Ids{2});
}

/// With a second field where the first is constant, and with that twice, the samples are those of the second.
TEST_F(Sample, TheFieldThatVariesMostDecides) {
  random_mesh(1000, 9, waves, 1e-9);
  const Ids alone = sample(all(), 0.1);
  ASSERT_GT(alone.size(), 20u);
  for (const bool twice : {false, true}) {
    std::vector<double> both;
    for (double value : mesh.scalars) both.insert(both.end(), {twice ? value : 5.0, value / 8});
    MeshView view = mesh.view();
    view.scalars = {both.data(), both.size()};
    view.fields = 2;
    view.scales.weighted[1] = 8;
    order = all();
    Array<std::int32_t> samples(&host.memory);
    sample_interior(view, {order.data(), order.size()}, 0.1, host.job, samples);
    EXPECT_EQ(Ids(samples.begin(), samples.end()), alone) << twice;
    Array<std::int32_t> vertices(&host.memory), one(&host.memory), two(&host.memory);
    const std::vector<std::uint8_t> interior(mesh.points.size(), 1);
    vertices.assign(order.begin(), order.end());
    std::sort(vertices.begin(), vertices.end());
    Array<std::int32_t> again(vertices, &host.memory);
    sample_residual(mesh.view(), vertices, {interior.data(), interior.size()}, 50, host.job, one);
    sample_residual(view, again, {interior.data(), interior.size()}, 50, host.job, two);
    EXPECT_EQ(one.size(), 50u);
    EXPECT_TRUE(one == two) << twice;
  }
}

/// Points that no plane separates, though their values differ.
TEST_F(Sample, CoincidentPoints) {
  mesh.points.assign(50, Vec3(1, 2, 3));
  for (int i = 0; i < 50; i++) mesh.scalars.push_back(i);
  EXPECT_EQ(sample(all(), 0.1), Ids{24});  // mean 24.5: the lower of two
  for (int i = 0; i < 50; i++) {
    mesh.points.push_back(Vec3(1, 2, 4));
    mesh.scalars.push_back(100 + i);
  }
  EXPECT_EQ(sample(all(), 0.1), (Ids{24, 74}));
}

/// x_min and x_max at one place, other points elsewhere: the middle separates nothing, the median does.
TEST_F(Sample, ExtremesAtOnePlace) {
  for (int i = 0; i < 64; i++) {
    mesh.points.push_back(Vec3(i, 0, 0));
    mesh.scalars.push_back(0.001 * i);
  }
  mesh.points.push_back(Vec3(10, 0, 0));
  mesh.scalars.push_back(-1);
  mesh.points.push_back(Vec3(10, 0, 0));
  mesh.scalars.push_back(1);
  const Ids samples = sample(all(), 0.1);
  std::size_t beside = 0;
  for (std::int32_t v : samples) beside += v < 64 && v != 10;
  EXPECT_GE(beside, 2u);
  EXPECT_LE(samples.size(), 14u) << "only the place of the extremes needs small cells";
}

/// Neighbouring doubles: their middle rounds to one of them.
TEST_F(Sample, PointsOneRoundingApart) {
  const double x = 1, y = std::nextafter(x, 2), z = std::nextafter(y, 2);
  mesh.points = {Vec3(x, 0, 0), Vec3(y, 0, 0), Vec3(z, 0, 0)};
  for (const std::vector<double> &values : {std::vector<double>{0, 1, 2}, {2, 1, 0}, {0, 2, 1}}) {
    mesh.scalars = values;
    EXPECT_EQ(sample(all(), 0.5), (Ids{0, 1, 2}));
  }
}

/// A tree as deep as there are vertices, by its cuts.
TEST_F(Sample, VeryUnbalanced) {
  for (int i = 0; i < 1000; i++) {
    mesh.points.push_back(Vec3(std::ldexp(1.0, -i), 0, 0));
    mesh.scalars.push_back(-i);
  }
  EXPECT_EQ(sample(all(), 0.5).size(), 1000u);
}

/// The extremes of each cell are its last two vertices: cuts alone would take the square of what there is.
TEST_F(Sample, OscillationsThatGrowTakeNoTime) {
  for (int i = 0; i < 60000; i++) {
    mesh.points.push_back(Vec3(i, 0, 0));
    mesh.scalars.push_back(i % 2 ? i : -i);
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(sample(all(), 0.5).size(), 60000u);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5);
}

TEST(AddFlagged, JoinsWhatIsMissingOnce) {
  Host host;
  const std::vector<std::uint8_t> flags = {1, 0, 2, 3, 0, 1, 1};
  const std::vector<std::int32_t> vertices = {6, 4, 3, 2, 1, 0};  // 5 is none of them
  Array<std::int32_t> samples({4, 3}, &host.memory);
  add_flagged({flags.data(), flags.size()}, {vertices.data(), vertices.size()}, samples);
  EXPECT_EQ(std::vector<std::int32_t>(samples.begin(), samples.end()), (std::vector<std::int32_t>{4, 3, 0, 2, 6}));
}

}  // namespace
}  // namespace tetlod
