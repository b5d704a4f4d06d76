// What a context may not take over from its earlier runs, one difference at a time.
#include "reuse_fixture.hpp"

namespace tetlod_test {
namespace {

class Stamps : public Reuse {
 protected:
  void set(int option, double value) {
    options.push_back([=](tetlod_context *of) { EXPECT_EQ(tetlod_set_real(of, option, value), TETLOD_OK); });
  }
  void choose(int option, std::int64_t value) {
    options.push_back([=](tetlod_context *of) { EXPECT_EQ(tetlod_set_int(of, option, value), TETLOD_OK); });
  }

  /// Vertex v gets another number, and its number vertex v's.
  void swap_vertices(std::size_t v, std::size_t w) {
    std::swap_ranges(&cube.xyz[3 * v], &cube.xyz[3 * v] + 3, &cube.xyz[3 * w]);
    std::swap(cube.values[v], cube.values[w]);
    const auto a = std::int32_t(v), b = std::int32_t(w);
    for (std::int32_t &corner : cube.corners) corner = corner == a ? b : corner == b ? a : corner;
  }
};

struct Spoiled {
  int option;
  void (*spoil)(Cube &cube);
};

/// What was repaired once is refused once it is to be.
TEST_F(Stamps, APolicyThatTurnsStrict) {
  const Spoiled all[] = {
      {TETLOD_OPT_ON_INVERTED, [](Cube &c) { std::swap(c.corners[0], c.corners[1]); }},
      {TETLOD_OPT_ON_REPEATED,
       [](Cube &c) {
         c.corners.insert(c.corners.end(), {0, 1, 2, 2});
       }},
      {TETLOD_OPT_ON_DUPLICATE, [](Cube &c) { c.corners.insert(c.corners.end(), &c.corners[0], &c.corners[4]); }},
      {TETLOD_OPT_ON_UNUSED,
       [](Cube &c) {
         c.xyz.insert(c.xyz.end(), {2, 2, 2}), c.values.push_back(0);
       }},
      {TETLOD_OPT_ON_FLAT,
       [](Cube &c) {
         c.corners.insert(c.corners.end(), {0, 1, 5, 6});
       }},
      {TETLOD_OPT_ON_COINCIDENT,
       [](Cube &c) {
         for (int k = 0; k < 3; k++) c.xyz.push_back(c.xyz[std::size_t(3 * c.corners[0] + k)]);
         c.values.push_back(c.values[std::size_t(c.corners[0])]);
         c.corners[0] = std::int32_t(c.values.size() - 1);
       }},
      {TETLOD_OPT_ON_OVERLAP, [](Cube &c) { c.xyz[3 * (c.values.size() / 2)] += 0.4; }},  // the vertex in the middle
  };
  for (const Spoiled &defect : all) {
    cube = Cube(4);
    defect.spoil(cube);
    context = make_context();
    set_up(context.get());
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    ASSERT_EQ(tetlod_set_int(context.get(), defect.option, TETLOD_POLICY_ERROR), TETLOD_OK);
    const tetlod_status status = tetlod_run(context.get());
    EXPECT_TRUE(status == TETLOD_ERR_MESH_DEGENERATE || status == TETLOD_ERR_MESH_INTERSECTING)
        << tetlod_option_name(defect.option) << ": " << status;
  }
}

/// The same numbers, counted from elsewhere, are other tets.
TEST_F(Stamps, TheIndexBase) {
  cube.xyz.insert(cube.xyz.end(), {2, 2, 2});
  cube.values.push_back(0);
  for (std::int32_t &v : cube.corners) v++;
  const tetlod_array tets = array_of(TETLOD_INT32, cube.corners.size() / 4, 4, cube.corners.data());
  const Context fresh = make_context();
  for (tetlod_context *of : {context.get(), fresh.get()}) set_up(of);
  ASSERT_EQ(tetlod_submit_tets(context.get(), &tets, 1), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  ASSERT_EQ(tetlod_submit_tets(context.get(), &tets, 0), TETLOD_OK);
  const tetlod_status status = tetlod_run(fresh.get());
  EXPECT_NE(status, TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), status);
}

/// 729 flags: the last one is beyond the last whole word.
TEST_F(Stamps, TheLastFlag) {
  set(TETLOD_OPT_TARGET_RATIO, 0.05);
  swap_vertices(364, cube.values.size() - 1);  // to the end, from inside
  flags.assign(cube.values.size(), 0);
  expect_fresh_bytes();
  flags.back() = TETLOD_FLAG_KEEP;
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0);
}

/// The tets are read again, too, where edges collapse.
TEST_F(Stamps, TheOldArraysMayGo) {
  choose(TETLOD_OPT_EFFORT, TETLOD_EFFORT_ACCURATE);
  set(TETLOD_OPT_TARGET_RATIO, 0.1);
  expect_fresh_bytes();
  Cube other = cube;
  std::swap(other.xyz, cube.xyz);
  std::swap(other.corners, cube.corners);
  std::fill(other.xyz.begin(), other.xyz.end(), 1e300);
  std::fill(other.corners.begin(), other.corners.end(), 0);
  new_values(1);
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets());
}

/// Samples just beneath a surface that bends are inside of one level and outside of another.
TEST_F(Stamps, WhatCullingFoundIsOfOneLevel) {
  cube = Cube(10);
  make_ball(cube);
  for (std::size_t v = 0; v < cube.values.size(); v++) {
    double *const p = &cube.xyz[3 * v];
    const double radius = std::hypot(p[0], p[1], p[2]);
    for (int k = 0; k < 3 && radius > 0; k++) p[k] *= std::pow(radius, 0.07 - 1);
  }
  set(TETLOD_OPT_RHO, 0.02);
  set(TETLOD_OPT_MIN_DISTANCE, 0);
  for (double sigma : {0.03, 0.2, 0.5, 0.1, 0.9}) {
    set(TETLOD_OPT_SIGMA, sigma);
    expect_fresh_bytes();
  }
}

/// A cost that sees the field, of values with the range of those before.
TEST_F(Stamps, ValuesOfTheSameRange) {
  options.push_back([](tetlod_context *of) { EXPECT_EQ(tetlod_set_preset(of, TETLOD_PRESET_FAST), TETLOD_OK); });
  set(TETLOD_OPT_CLEAN_EDGES, 1e-15);
  for (double phase : {0.0, 1.0}) {
    new_values(phase);
    cube.values[364] = -9;
    cube.values[365] = 9;
    EXPECT_EQ(expect_fresh_bytes().reused_triangles, 0);
  }
}

/// What collapsed without a limit is not what begins with one.
TEST_F(Stamps, MaxDeviation) {
  cube = Cube(10);
  make_ball(cube);
  for (double limit : {0.0, 0.0, 0.01, 0.0, 0.01, 0.002}) {
    set(TETLOD_OPT_TARGET_RATIO, limit > 0 ? 0.08 : 0.1);
    set(TETLOD_OPT_MAX_DEVIATION, limit);
    expect_fresh_bytes();
  }
}

/// Large enough for haste.
TEST_F(Stamps, Effort) {
  cube = large_cube_with_front();
  set(TETLOD_OPT_TARGET_RATIO, 0.1);
  choose(TETLOD_OPT_THREADS, 2);
  for (int effort : {TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE, TETLOD_EFFORT_FAST, TETLOD_EFFORT_ACCURATE}) {
    choose(TETLOD_OPT_EFFORT, effort);
    expect_fresh_bytes();
  }
}

/// Samples, or what collapses leave.
TEST_F(Stamps, Remesh) {
  cube = large_cube_with_front();
  set(TETLOD_OPT_TARGET_RATIO, 0.02);
  choose(TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
  for (int remesh : {1, 0, 1, 0}) {
    choose(TETLOD_OPT_REMESH, remesh);
    EXPECT_EQ(expect_fresh_bytes().remesh_attempts > 0, remesh == 1);
  }
}

}  // namespace
}  // namespace tetlod_test
