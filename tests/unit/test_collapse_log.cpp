// A decimation done again from its log: bit for bit what the decimation itself gives, as far as it went.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "decimate_boundary.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

struct Case {
  std::string name;
  std::function<Surface(Host &)> surface;
  DecimateOptions options;
  int locked_every = 0;  ///< so many points on, one is locked; 0: none
};

Surface touching_solids(Host &host) { return surface_of(random_solid(6, 0.5, 3), host.job); }

const Case cases[] = {
    {"Blob", [](Host &host) { return random_blob(host.memory, 12, 7); }, {}},
    {"BlobWithALimit", [](Host &host) { return random_blob(host.memory, 12, 7); }, {0.05, 0.1, 0, 0.02}},
    {"Star", [](Host &host) { return spiky_star(host.memory, 8); }, {0.02, 1, 0.01}},
    {"TouchesItself", touching_solids, {0.1}},
    {"Cleaned", touching_solids, {0.6, 0.1, 0.1}},
    {"Locked", [](Host &host) { return random_blob(host.memory, 10, 1); }, {0.1}, 5},
    {"Exhausted", touching_solids, {0}},
};

class Replay : public testing::TestWithParam<Case> {
 protected:
  Host host;
  Surface original{host.memory};
  SurfaceTopology topology{host.memory};
  std::vector<std::uint8_t> locked;

  void SetUp() override {
    original = GetParam().surface(host);
    complete(original, [](const Vec3 &p) { return p.x + 2 * p.y * p.z; });
    find_topology(original.points, original.triangles, host.job, topology);
    if (GetParam().locked_every)
      for (std::size_t v = 0; v < original.points.size(); v++) locked.push_back(int(v) % GetParam().locked_every == 0);
  }

  Surface decimated(const DecimateOptions &options, CollapseLog &log) {
    Surface out(host.memory);
    out = original;
    decimate_boundary(out, topology, {locked.data(), locked.size()}, options, host.job, log);
    return out;
  }

  std::int64_t edges() const { return std::int64_t(topology.mate.size() / 2); }

  void expect_again(const CollapseLog &log, double sigma, MovedValues values, const Surface &wanted) {
    const std::int64_t count = collapses_to(sigma, edges(), log);
    ASSERT_GE(count, 0) << sigma;
    Surface again(host.memory);
    again = original;
    replay(log, std::size_t(count), topology, values, host.job, again);
    EXPECT_TRUE(again.triangles == wanted.triangles) << "triangles, sigma " << sigma;
    EXPECT_TRUE(again.points == wanted.points) << "points, sigma " << sigma;
    EXPECT_TRUE(again.scalars == wanted.scalars) << "values, sigma " << sigma;
    EXPECT_TRUE(again.origin == wanted.origin) << "origins, sigma " << sigma;
  }
};

TEST_P(Replay, AsFarAndLessFar) {
  DecimateOptions options = GetParam().options;
  CollapseLog log(host.memory);
  const Surface end = decimated(options, log);
  EXPECT_GT(log.collapses.size(), 10u);
  expect_again(log, options.sigma, MovedValues::along_edges, end);
  expect_again(log, options.sigma, MovedValues::logged, end);
  for (double way : {0.1, 0.5, 0.9, 1.0}) {
    options.sigma = GetParam().options.sigma + way * (1 - GetParam().options.sigma);
    CollapseLog other(host.memory);
    expect_again(log, options.sigma, MovedValues::along_edges, decimated(options, other));
  }
}

/// The paper's cost does not see the field.
TEST_P(Replay, OtherValues) {
  CollapseLog log(host.memory), other(host.memory);
  decimated(GetParam().options, log);
  for (std::size_t v = 0; v < original.points.size(); v++) original.scalars[v] = 3 - original.points[v].x;
  expect_again(log, GetParam().options.sigma, MovedValues::along_edges, decimated(GetParam().options, other));
}

/// A cost that does sees the same field again.
TEST_P(Replay, CostThatSeesTheField) {
  DecimateOptions options = GetParam().options;
  options.field_weight = {0.3};
  CollapseLog log(host.memory);
  expect_again(log, options.sigma, MovedValues::logged, decimated(options, log));
  options.sigma = 0.8;
  CollapseLog other(host.memory);
  expect_again(log, options.sigma, MovedValues::logged, decimated(options, other));
}

/// Of two fields; the paper's cost sees neither, and gives each the values that it would have alone.
TEST_P(Replay, TwoFields) {
  const Array<double> first(original.scalars, &host.memory);
  const auto second = [](const Vec3 &p) { return 9 - p.z * p.x; };
  original.fields = 2;
  original.scalars.clear();
  for (std::size_t v = 0; v < first.size(); v++)
    for (double value : {first[v], second(original.points[v])}) original.scalars.push_back(value);
  for (double weight : {0.0, 0.3}) {
    DecimateOptions options = GetParam().options;
    options.field_weight = {weight, weight};
    CollapseLog log(host.memory);
    const Surface both = decimated(options, log);
    ASSERT_EQ(both.scalars.size(), 2 * both.points.size());
    expect_again(log, options.sigma, weight > 0 ? MovedValues::logged : MovedValues::along_edges, both);
    if (weight > 0) continue;
    const Array<double> together(original.scalars, &host.memory);
    original.scalars = first;
    original.fields = 1;
    CollapseLog other(host.memory);
    const Surface alone = decimated(options, other);
    original.scalars = together;
    original.fields = 2;
    ASSERT_TRUE(alone.points == both.points);
    for (std::size_t v = 0; v < alone.points.size(); v++) ASSERT_EQ(both.scalars[2 * v], alone.scalars[v]);
  }
}

TEST_P(Replay, FurtherThanItWent) {
  DecimateOptions options = GetParam().options;
  options.sigma = 0.9;
  CollapseLog log(host.memory);
  decimated(options, log);
  EXPECT_FALSE(log.exhausted);
  EXPECT_EQ(collapses_to(0.5, edges(), log), -1);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Replay, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case> &info) { return info.param.name; });

}  // namespace
}  // namespace tetlod
