// What bare TetGen answers with crashes, endless loops and silent changes has a status here, or a valid result.
#include <cmath>
#include <functional>
#include <limits>

#include "fixtures.hpp"

namespace {

using namespace tetlod_test;

constexpr double infinity = std::numeric_limits<double>::infinity();

Cube nothing(std::size_t points) {
  Cube cube(1);
  cube.xyz.resize(3 * points);
  cube.values.resize(points);
  return cube;
}

Cube placed(int n, const std::function<void(double *)> &place) {
  Cube cube(n);
  for (std::size_t i = 0; i < cube.xyz.size(); i += 3) place(&cube.xyz[i]);
  return cube;
}

Cube scaled(double factor) {
  return placed(4, [factor](double *p) {
    for (int k = 0; k < 3; k++) p[k] *= factor;
  });
}

/// A second cube beside the first, moved and turned by `place`.
Cube with_second(int n, const std::function<void(double *)> &place) {
  Cube both(n);
  const Cube second = placed(n, place);
  const auto first_points = std::int32_t(both.values.size());
  for (std::int32_t v : second.corners) both.corners.push_back(v + first_points);
  both.xyz.insert(both.xyz.end(), second.xyz.begin(), second.xyz.end());
  both.values.insert(both.values.end(), second.values.begin(), second.values.end());
  return both;
}

Cube shifted(double x, double y, double z) {
  return with_second(2, [=](double *p) {
    p[0] += x;
    p[1] += y;
    p[2] += z;
  });
}

/// A solid in a cavity of a solid in a cavity of a solid: cells of a 9 x 9 x 9 grid by their distance to the middle.
Cube nested() {
  Cube cube(9);
  std::vector<std::int32_t> kept;
  for (std::size_t cell = 0; cell < 729; cell++) {
    const int at[3] = {int(cell % 9) - 4, int(cell / 9 % 9) - 4, int(cell / 81) - 4};
    const int ring = std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    if (ring % 2 == 0) kept.insert(kept.end(), &cube.corners[24 * cell], &cube.corners[24 * cell] + 24);
  }
  cube.corners = kept;
  return cube;
}

struct BadInput {
  const char *name;
  std::function<Cube()> make;
  std::vector<tetlod_status> allowed;
};

void PrintTo(const BadInput &input, std::ostream *to) { *to << input.name; }

const std::vector<BadInput> inputs = {
    {"no_points", [] { return nothing(0); }, {TETLOD_ERR_MESH_EMPTY}},
    {"one_point", [] { return nothing(1); }, {TETLOD_ERR_MESH_INDEX}},
    {"three_points", [] { return nothing(3); }, {TETLOD_ERR_MESH_INDEX}},
    {"all_at_one_place", [] { return scaled(0); }, {TETLOD_ERR_MESH_EMPTY}},
    {"collinear", [] { return placed(3, [](double *p) { p[1] = p[2] = 0; }); }, {TETLOD_ERR_MESH_EMPTY}},
    {"collinear_all_different",
     [] { return placed(3, [](double *p) { p[0] += 7 * p[1] + 50 * p[2], p[1] = p[2] = p[0]; }); },
     {TETLOD_ERR_MESH_DEGENERATE}},
    {"coplanar",
     [] { return placed(3, [](double *p) { p[0] += 10 * p[2], p[2] = 0; }); },
     {TETLOD_ERR_MESH_DEGENERATE}},
    {"flat_box", [] { return placed(3, [](double *p) { p[2] = 0; }); }, {TETLOD_ERR_MESH_EMPTY}},
    {"nan_on_the_surface",
     [] { return placed(2, [](double *p) { p[0] = p[0] == 0 ? std::nan("") : p[0]; }); },
     {TETLOD_ERR_MESH_NONFINITE}},
    {"infinity_inside",
     [] { return placed(2, [](double *p) { p[1] = p[0] == 0.5 && p[1] == 0.5 && p[2] == 0.5 ? infinity : p[1]; }); },
     {TETLOD_ERR_MESH_NONFINITE}},
    {"times_1e200", [] { return scaled(1e200); }, {TETLOD_OK}},
    {"times_1e30", [] { return scaled(1e30); }, {TETLOD_OK}},
    {"times_1e_60", [] { return scaled(1e-60); }, {TETLOD_OK}},
    {"times_1e_100", [] { return scaled(1e-100); }, {TETLOD_OK}},
    {"times_1e_300", [] { return scaled(1e-300); }, {TETLOD_OK}},
    {"far_away",
     [] { return placed(4, [](double *p) { p[0] += 1e15; }); },
     {TETLOD_OK, TETLOD_ERR_MESH_DEGENERATE, TETLOD_ERR_MESH_EMPTY, TETLOD_ERR_MESH_INTERSECTING,
      TETLOD_ERR_MESH_NONMANIFOLD}},
    {"short_edges",
     [] { return placed(3, [](double *p) { p[0] = p[0] > 0.4 && p[0] < 0.9 ? 1 - 1e-12 : p[0]; }); },
     {TETLOD_OK}},
    {"overlapping_solids", [] { return shifted(0.5, 0.25, 0.125); }, {TETLOD_ERR_MESH_INTERSECTING}},
    {"one_in_the_other",
     [] {
       return with_second(2, [](double *p) {
         for (int k = 0; k < 3; k++) p[k] = 0.4 + 0.1 * p[k];
       });
     },
     {TETLOD_ERR_MESH_INTERSECTING}},
    {"touching_faces", [] { return shifted(1, 0.25, 0.125); }, {TETLOD_ERR_MESH_INTERSECTING}},
    {"touching_edge_on_face",
     [] {
       return with_second(2, [](double *p) {
         const double x = p[0], y = p[1];
         p[0] = 1 + (x + y) / 2;
         p[1] = 0.4 + (y - x) / 2;
       });
     },
     {TETLOD_ERR_MESH_INTERSECTING}},
    {"sharing_a_face", [] { return shifted(1, 0, 0); }, {TETLOD_OK}},
    {"sharing_an_edge", [] { return shifted(1, 1, 0); }, {TETLOD_OK}},
    {"sharing_a_vertex", [] { return shifted(1, 1, 1); }, {TETLOD_OK}},
    {"plate", [] { return placed(6, [](double *p) { p[2] *= 1e-9; }); }, {TETLOD_OK}},
    {"rod", [] { return placed(6, [](double *p) { p[1] *= 1e-6, p[2] *= 1e-6; }); }, {TETLOD_OK}},
    {"solid_in_cavity_in_solid", nested, {TETLOD_OK}},
};

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, HaveAStatusAndLeaveTheContextWhole) {
  const Cube bad = GetParam().make(), good(3);
  const Context context = make_context();
  submit(context.get(), good);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK);
  const std::vector<unsigned char> before = bytes_of(context.get());

  submit(context.get(), bad);
  tetlod_mesh_report found{};
  found.struct_size = sizeof found;
  ASSERT_EQ(tetlod_check(context.get(), &found), TETLOD_OK);
  for (double sigma : {0.1, 1.0}) {
    ASSERT_EQ(tetlod_set_sigma(context.get(), sigma), TETLOD_OK);
    const tetlod_status status = tetlod_run(context.get());
    if (sigma == 1) {
      EXPECT_EQ(found.status, status) << "what tetlod_check says";
    }
    EXPECT_NE(std::find(GetParam().allowed.begin(), GetParam().allowed.end(), status), GetParam().allowed.end())
        << status << ": " << message_of(context.get());
    if (status != TETLOD_OK) {
      EXPECT_GT(message_of(context.get()).size(), 10u);
      EXPECT_EQ(bytes_of(context.get()), before) << "the previous result is still there";
    }
  }

  submit(context.get(), good);
  ASSERT_EQ(tetlod_set_sigma(context.get(), 0.1), TETLOD_OK);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(bytes_of(context.get()), before) << "the next run is fine";
}

std::string told(const Cube &cube, std::int32_t index_base, tetlod_status status) {
  const Context context = make_context();
  const tetlod_array points = array_of(TETLOD_FLOAT64, cube.values.size(), 3, cube.xyz.data()),
                     tets = array_of(TETLOD_INT32, cube.corners.size() / 4, 4, cube.corners.data()),
                     values = array_of(TETLOD_FLOAT64, cube.values.size(), 1, cube.values.data());
  EXPECT_EQ(tetlod_submit_points(context.get(), &points), TETLOD_OK);
  EXPECT_EQ(tetlod_submit_tets(context.get(), &tets, index_base), TETLOD_OK);
  EXPECT_EQ(tetlod_submit_scalars(context.get(), "values", &values), TETLOD_OK);
  EXPECT_EQ(tetlod_run(context.get()), status);
  return message_of(context.get());
}

/// Points that no tet uses, and a tet that is dropped, come before.
TEST(Messages, NameVerticesAndTetsAsTheHostDoes) {
  Cube fan = nothing(9);
  for (std::size_t v = 0; v < 9; v++) {
    fan.xyz[3 * v] = v == 4;
    fan.xyz[3 * v + 1] = v == 5;
    fan.xyz[3 * v + 2] = v > 5 ? double(v) : 0;
    fan.values[v] = double(v);
  }
  fan.corners = {3, 3, 4, 5, 3, 4, 5, 6, 3, 4, 5, 7, 3, 4, 5, 8};
  EXPECT_NE(told(fan, 0, TETLOD_ERR_MESH_NONMANIFOLD).find("vertices 3, 4 and 5 (the first are tets 1, 2, 3)"),
            std::string::npos);
  for (std::int32_t &v : fan.corners) v++;
  EXPECT_NE(told(fan, 1, TETLOD_ERR_MESH_NONMANIFOLD).find("vertices 4, 5 and 6 (the first are tets 2, 3, 4)"),
            std::string::npos);

  // Two tets on the same side of the edge 7, 8, whose faces interleave there.
  Cube wedges = nothing(13);
  const double places[][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-1, 1, 0}};
  for (std::size_t v = 0; v < 6; v++) std::copy(places[v], places[v] + 3, &wedges.xyz[3 * (v + 7)]);
  wedges.corners = {7, 8, 9, 10, 7, 8, 11, 12};
  EXPECT_NE(told(wedges, 0, TETLOD_ERR_MESH_INTERSECTING).find("edge from vertex 7 to vertex 8"), std::string::npos);
}

/// As published, and by a policy; else they are simplified each for itself, and tetlod_check says so.
TEST(Assemblies, AreTakenWhereTetGenIsNotNeeded) {
  const Cube parts = shifted(1, 0.25, 0.125), overlap = shifted(0.9, 0.25, 0.125);
  const Context context = make_context();
  const auto expect = [&](const Cube &cube, tetlod_status status) {
    submit(context.get(), cube);
    EXPECT_EQ(tetlod_run(context.get()), status) << message_of(context.get());
    tetlod_mesh_report report{};
    report.struct_size = sizeof report;
    EXPECT_EQ(tetlod_check(context.get(), &report), TETLOD_OK);
    EXPECT_EQ(report.status, status);
    EXPECT_EQ(report.components, 2);
  };
  expect(parts, TETLOD_ERR_MESH_INTERSECTING);
  for (const std::int32_t option : {TETLOD_OPT_TARGET_RATIO, TETLOD_OPT_MAX_ERROR}) {
    ASSERT_EQ(tetlod_set_real(context.get(), option, 0.5), TETLOD_OK);
    expect(parts, TETLOD_OK);
    expect(overlap, TETLOD_ERR_MESH_INTERSECTING);
  }
  ASSERT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 0.001), TETLOD_OK);
  expect(parts, TETLOD_ERR_MESH_INTERSECTING);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_REMESH, 0), TETLOD_OK);
  expect(parts, TETLOD_OK);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_OVERLAP, 0), TETLOD_OK);
  expect(parts, TETLOD_ERR_MESH_INTERSECTING);
}

/// Of an assembly each part alone could be simplified, of a body that crosses itself none.
TEST(Messages, TellSolidsInContactFromABodyThatCrossesItself) {
  EXPECT_EQ(told(shifted(1, 0.25, 0.125), 0, TETLOD_ERR_MESH_INTERSECTING).find("components of the boundary"), 0u);
  // Bent around an axis and beyond.
  Cube ring = placed(6, [](double *p) {
    const double angle = 7 * p[0], radius = 1 + p[1] / 3;
    p[0] = radius * std::cos(angle);
    p[1] = radius * std::sin(angle);
  });
  EXPECT_EQ(told(ring, 0, TETLOD_ERR_MESH_INTERSECTING).find("the boundary crosses or touches itself"), 0u);
}

INSTANTIATE_TEST_SUITE_P(Each, BadInputs, testing::ValuesIn(inputs),
                         [](const auto &info) { return std::string(info.param.name); });

/// One that is given twice is one of them.
TEST(Messages, NameThreeTetsOfAFace) {
  Cube cube(1);
  cube.corners = {0, 1, 2, 4, 4, 2, 1, 0, 0, 1, 2, 5, 0, 1, 2, 6};
  const Context context = make_context();
  submit(context.get(), cube);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MESH_NONMANIFOLD);
  EXPECT_NE(message_of(context.get()).find("3 tets share the face"), std::string::npos) << message_of(context.get());
  EXPECT_NE(message_of(context.get()).find("tets 0, 2, 3)"), std::string::npos) << message_of(context.get());
}

/// Whatever a policy refuses: of a tet with a wrong one the other points are in a tet.
TEST(Messages, NameAWrongIndexFirst) {
  Cube cube(2);
  cube.xyz.insert(cube.xyz.end(), 3, 2);
  cube.values.push_back(0);
  cube.corners.insert(cube.corners.end(), {0, 1, std::int32_t(cube.values.size()) - 1, 4711});
  const Context context = make_context();
  submit(context.get(), cube);
  ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_ON_UNUSED, TETLOD_POLICY_ERROR), TETLOD_OK);
  tetlod_mesh_report found{};
  found.struct_size = sizeof found;
  ASSERT_EQ(tetlod_check(context.get(), &found), TETLOD_OK);
  EXPECT_EQ(found.unused.count, 0);
  EXPECT_EQ(found.index.count, 1);
  EXPECT_EQ(found.status, TETLOD_ERR_MESH_INDEX);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MESH_INDEX);
}

}  // namespace
