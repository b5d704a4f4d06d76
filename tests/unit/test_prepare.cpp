// What the caller submits becomes the mesh that the stages read; what is wrong with it is named.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "meshes.hpp"
#include "prepare.hpp"
#include "status.hpp"

namespace tetlod {
namespace {

using namespace test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class Prepare : public testing::Test {
 protected:
  Host host;
  Original original{host.memory};
  std::string message;

  Status status(const Input &input, double tolerance = 0) {
    Original fresh(host.memory);
    try {
      Options options;
      options.merge_tolerance = tolerance;
      prepare_original(input, options, host.job, fresh);
      return Status::ok;
    } catch (const Error &error) {
      message = error.what();
      return error.status();
    }
  }
  void prepare(const Input &input, double tolerance = 0) {
    Options options;
    options.merge_tolerance = tolerance;
    prepare_original(input, options, host.job, original);
  }

  bool says(const std::string &part) const { return message.find(part) != std::string::npos; }

  void expect_view(const Mesh &mesh) {
    ASSERT_EQ(original.view.points.size(), mesh.points.size());
    ASSERT_EQ(original.view.tets.size(), mesh.tets.size());
    for (std::size_t i = 0; i < mesh.points.size(); i++) {
      EXPECT_EQ(original.view.points[i], mesh.points[i]);
      EXPECT_EQ(original.view.scalars[i], mesh.scalars[i]);
    }
    for (std::size_t i = 0; i < mesh.tets.size(); i++) EXPECT_EQ(original.view.tets[i], mesh.tets[i]);
  }
};

/// Coordinates that float holds exactly.
Mesh cube_for_floats() {
  Mesh mesh = kuhn_cube(4);
  set_scalars(mesh, [](const Vec3 &p) { return p.x + 2 * p.y - 4 * p.z; });
  return mesh;
}

TEST_F(Prepare, CommonLayoutIsNotCopied) {
  const Mesh mesh = cube_for_floats();
  prepare(input_of(mesh));
  expect_view(mesh);
  EXPECT_EQ(original.view.points.data(), mesh.points.data());
  EXPECT_EQ(original.view.scalars.data(), mesh.scalars.data());
  EXPECT_EQ(original.view.tets.data(), mesh.tets.data());
  EXPECT_EQ(original.scalar_min, -4);
  EXPECT_EQ(original.scalar_max, 3);
  EXPECT_EQ(original.box.low, Vec3(0));
  EXPECT_EQ(original.box.high, Vec3(1));
  EXPECT_EQ(original.merged_points, 0);
  EXPECT_EQ(original.dropped_tets, 0);
}

TEST_F(Prepare, Floats) {
  const Mesh mesh = cube_for_floats();
  std::vector<float> xyz, values(mesh.scalars.begin(), mesh.scalars.end());
  for (const Vec3 &p : mesh.points)
    for (int k = 0; k < 3; k++) xyz.push_back(float(p[k]));
  Input input = input_of(mesh);
  for (std::size_t k = 0; k < 3; k++)
    input.xyz[k] = strided(xyz.data() + k, mesh.points.size(), 1, 3, ElementType::float32);
  input.scalars = strided(values.data(), values.size(), 1, 1, ElementType::float32);
  prepare(input);
  expect_view(mesh);
}

TEST_F(Prepare, SeparateCoordinates) {
  const Mesh mesh = cube_for_floats();
  std::vector<double> axes[3];
  Input input = input_of(mesh);
  for (std::size_t k = 0; k < 3; k++) {
    for (const Vec3 &p : mesh.points) axes[k].push_back(p[int(k)]);
    input.xyz[k] = strided(axes[k].data(), axes[k].size(), 1, 1, ElementType::float64);
  }
  prepare(input);
  expect_view(mesh);
}

TEST_F(Prepare, GapsAndBackwards) {
  const Mesh mesh = cube_for_floats();
  constexpr std::size_t gap = 5;
  const std::size_t count = mesh.points.size();
  std::vector<double> records(gap * count, nan);  // x y z value, and what is not ours; the last point first
  for (std::size_t i = 0; i < count; i++) {
    double *record = records.data() + gap * (count - 1 - i);
    for (int k = 0; k < 3; k++) record[k] = mesh.points[i][k];
    record[3] = mesh.scalars[i];
  }
  Input input = input_of(mesh);
  double *last = records.data() + gap * (count - 1);
  for (std::size_t k = 0; k < 4; k++) {
    StridedArray array = strided(last + k, count, 1, gap, ElementType::float64);
    array.tuple_stride = -array.tuple_stride;
    (k < 3 ? input.xyz[k] : input.scalars) = array;
  }
  prepare(input);
  expect_view(mesh);
}

TEST_F(Prepare, WideIntegersColumnsAndBaseOne) {
  const Mesh mesh = cube_for_floats();
  for (std::int32_t base : {0, 1}) {
    std::vector<std::int64_t> columns;
    for (std::size_t k = 0; k < 4; k++)
      for (const Tet &t : mesh.tets) columns.push_back(t[k] + base);
    Input input = input_of(mesh);
    input.index_base = base;
    input.tets = strided(columns.data(), mesh.tets.size(), 4, 1, ElementType::int64);
    input.tets.component_stride = std::int64_t(mesh.tets.size() * sizeof(std::int64_t));
    prepare(input);
    expect_view(mesh);

    std::vector<Tet> packed = mesh.tets;
    for (Tet &t : packed)
      for (std::int32_t &v : t) v += base;
    input.tets = strided(packed.data()->data(), packed.size(), 4, 4, ElementType::int32);
    prepare(input);
    expect_view(mesh);
  }
}

TEST_F(Prepare, DropsTetsWithARepeatedVertex) {
  Mesh mesh = cube_for_floats();
  const std::vector<Tet> good = mesh.tets;
  for (std::size_t a = 0; a < 4; a++)
    for (std::size_t b = 0; b < a; b++) {
      Tet bad = good[10 * a + b];
      bad[a] = bad[b];
      mesh.tets.insert(mesh.tets.begin() + std::ptrdiff_t(7 * a), bad);
    }
  prepare(input_of(mesh));
  EXPECT_EQ(original.dropped_tets, 6);
  EXPECT_EQ(original.merged_points, 0);
  mesh.tets = good;
  expect_view(mesh);
}

/// Two cubes side by side, each with points of its own: merged they are one mesh. A tet between two coincident points
/// has no volume and goes.
TEST_F(Prepare, MergesAndDrops) {
  for (double gap : {0.0, 1e-4}) {
    Mesh mesh = kuhn_cube(3), other = mesh;
    const auto first = std::int32_t(mesh.points.size());
    transform(other, [&](const Vec3 &p) { return p + Vec3(1 + gap, 0, 0); });
    append(mesh, other);
    std::vector<std::int32_t> joined(mesh.points.size());
    for (std::size_t i = 0; i < joined.size(); i++) {
      joined[i] = std::int32_t(i);
      for (std::int32_t j = 0; j < first; j++)
        if (std::int32_t(i) >= first && glm::length(mesh.points[i] - mesh.points[std::size_t(j)]) < 1e-3) joined[i] = j;
    }
    std::vector<Tet> expected = mesh.tets;
    for (Tet &t : expected)
      for (std::int32_t &v : t) v = joined[std::size_t(v)];
    std::int32_t twin = first;
    while (joined[std::size_t(twin)] == twin) twin++;
    mesh.tets.push_back({twin, joined[std::size_t(twin)], 5, 50});
    mesh.scalars.assign(mesh.points.size(), 1.0);
    prepare(input_of(mesh), gap > 0 ? 1e-3 : 0);
    EXPECT_EQ(original.merged_points, 16) << gap;
    EXPECT_EQ(original.dropped_tets, 1) << gap;
    ASSERT_EQ(original.view.tets.size(), expected.size());
    for (std::size_t t = 0; t < expected.size(); t++) EXPECT_EQ(original.view.tets[t], expected[t]);
  }
}

/// Elements that pad an array, or that nobody gave a value: their other points lie and mean nothing, too.
TEST_F(Prepare, PointsOfDroppedTetsAreNoneOfTheMesh) {
  Mesh mesh = cube_for_floats();
  const auto padding = std::int32_t(mesh.points.size());
  for (const Vec3 &p : {Vec3(1000), Vec3(1001), Vec3(1002), Vec3(1000, 0, 0)}) mesh.points.push_back(p);
  mesh.scalars.insert(mesh.scalars.end(), {1e6, -1e6, 1e6, nan});
  mesh.tets.push_back({padding, padding, padding, padding});
  mesh.tets.push_back({padding, padding + 1, padding + 2, padding + 3});
  Options options;
  options.on_nonfinite = policy_repair;
  const auto expect_that_of_the_cube = [&](double largest) {
    EXPECT_EQ(original.dropped_tets, 2);
    EXPECT_EQ(original.scalar_min, -4);
    EXPECT_EQ(original.scalar_max, largest);
    EXPECT_EQ(original.box.low, Vec3(0));
    EXPECT_EQ(original.box.high, Vec3(1));
  };
  prepare_original(input_of(mesh), options, host.job, original);
  expect_that_of_the_cube(3);
  mesh.scalars.back() = -1e6;
  mesh.tets.back()[3] = padding;
  original = Original(host.memory);
  prepare_original(input_of(mesh), options, host.job, original);
  expect_that_of_the_cube(3);
  *std::find(mesh.scalars.begin(), mesh.scalars.end(), 3) = 5;
  EXPECT_TRUE(renew_values(input_of(mesh), host.job, original));
  expect_that_of_the_cube(5);
  mesh.scalars.back() = nan;
  EXPECT_TRUE(renew_values(input_of(mesh), host.job, original)) << "no tet has it";
  mesh.scalars[std::size_t(padding)] = nan;
  EXPECT_FALSE(renew_values(input_of(mesh), host.job, original));
}

/// Flat tets that hang on the boundary, one on the other, and one that is given twice.
TEST_F(Prepare, PointsOfTetsThatTheBoundaryLeavesOutAreNoneOfTheMesh) {
  Mesh mesh = cube_for_floats();
  const Mesh sound = mesh;
  Boundary expected(host.memory);
  extract_boundary(mesh.view(), host.job, expected);
  const auto far = std::int32_t(mesh.points.size());
  const Triangle face = *std::find_if(expected.triangles.begin(), expected.triangles.end(), [&](const Triangle &t) {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return mesh.points[std::size_t(v)].z == 0; });
  });
  for (double x : {1000, 2000}) mesh.points.push_back(Vec3(x, -x, 0));
  mesh.scalars.insert(mesh.scalars.end(), {1e6, -1e6});
  mesh.tets.insert(mesh.tets.begin() + 1, {face[0], face[1], face[2], far});
  mesh.tets.insert(mesh.tets.begin() + 3, {face[0], face[1], far, far + 1});
  mesh.tets.push_back(mesh.tets[0]);
  Boundary boundary(host.memory);
  prepare_with_boundary(input_of(mesh), {}, host.job, original, boundary);
  const auto expect_that_of_the_cube = [&](double largest) {
    EXPECT_EQ(original.scalar_min, -4);
    EXPECT_EQ(original.scalar_max, largest);
    EXPECT_EQ(original.box.low, Vec3(0));
    EXPECT_EQ(original.box.high, Vec3(1));
    ASSERT_EQ(original.view.tets.size(), sound.tets.size());
    for (std::size_t t = 0; t < sound.tets.size(); t++) {
      EXPECT_EQ(original.view.tets[t], sound.tets[t]);
      EXPECT_EQ(mesh.tets[std::size_t(original.tet_number[t])], sound.tets[t]);
    }
  };
  expect_that_of_the_cube(3);
  EXPECT_EQ(boundary.flat_tets, 2);
  EXPECT_EQ(boundary.duplicate_tets, 1);
  EXPECT_EQ(boundary.triangles, expected.triangles);
  EXPECT_EQ(boundary.tet_of, expected.tet_of);
  *std::find(mesh.scalars.begin(), mesh.scalars.end(), 3) = 5;
  EXPECT_TRUE(renew_values(input_of(mesh), host.job, original));
  expect_that_of_the_cube(5);
}

TEST_F(Prepare, PointsThatNoTetUsesMayBeAnything) {
  Mesh mesh = cube_for_floats();
  mesh.points.push_back(Vec3(nan, infinity, 1e300));
  mesh.points.push_back(mesh.points[0]);
  mesh.scalars.push_back(nan);
  mesh.scalars.push_back(1e300);
  prepare(input_of(mesh));
  EXPECT_EQ(original.merged_points, 0);
  EXPECT_EQ(original.scalar_max, 3);
  EXPECT_EQ(original.box.high, Vec3(1));
}

// What is wrong, and where

TEST_F(Prepare, NamesTheTetAndTheIndex) {
  for (std::int32_t base : {0, 1})
    for (std::int32_t wrong : {base - 1, base + 125, std::numeric_limits<std::int32_t>::min()}) {
      Mesh mesh = cube_for_floats();  // 125 points
      for (Tet &t : mesh.tets)
        for (std::int32_t &v : t) v += base;
      mesh.tets[200][2] = mesh.tets[17][3] = wrong;
      Input input = input_of(mesh);
      input.index_base = base;
      EXPECT_EQ(status(input), Status::mesh_index);
      EXPECT_TRUE(says("tet " + std::to_string(17 + base) + " ")) << message;
      EXPECT_TRUE(says("vertex " + std::to_string(wrong))) << message;
      EXPECT_TRUE(says("125")) << message;
    }
}

TEST_F(Prepare, AWideIndexIsNotCutShort) {
  const Mesh mesh = cube_for_floats();
  std::vector<std::int64_t> corners;
  for (const Tet &t : mesh.tets) corners.insert(corners.end(), t.begin(), t.end());
  corners[4 * 9 + 1] = std::int64_t(1) << 32;  // 0 in 32 bits
  Input input = input_of(mesh);
  input.tets = strided(corners.data(), mesh.tets.size(), 4, 4, ElementType::int64);
  EXPECT_EQ(status(input), Status::mesh_index);
  EXPECT_TRUE(says("tet 9 ") && says("4294967296")) << message;
}

TEST_F(Prepare, NamesWhatIsNotFinite) {
  for (double bad : {nan, infinity, -infinity})
    for (int k = 0; k < 4; k++) {
      Mesh mesh = cube_for_floats();
      (k < 3 ? mesh.points[42][k] : mesh.scalars[42]) = bad;
      EXPECT_EQ(status(input_of(mesh)), Status::mesh_nonfinite);
      EXPECT_TRUE(says("vertex 42")) << message;
      EXPECT_TRUE(says(std::isnan(bad) ? "nan" : "inf")) << message;
      EXPECT_TRUE(k == 3 || says(std::string("coordinate ") + "xyz"[k])) << message;
    }
}

TEST_F(Prepare, Empty) {
  Mesh mesh = cube_for_floats();
  EXPECT_EQ(status(input_of(Mesh())), Status::mesh_empty);
  Mesh no_tets = mesh;
  no_tets.tets.clear();
  EXPECT_EQ(status(input_of(no_tets)), Status::mesh_empty);
  EXPECT_TRUE(says("125")) << message;
  EXPECT_EQ(status(input_of(mesh), 2), Status::mesh_empty) << "merged to a single point";
  for (Tet &t : mesh.tets) t[1] = t[3];
  EXPECT_EQ(status(input_of(mesh)), Status::mesh_empty);
}

TEST_F(Prepare, CountsThatDoNotFit) {
  const Mesh mesh = cube_for_floats();
  Input input = input_of(mesh);
  input.scalars.tuples--;
  EXPECT_EQ(status(input), Status::argument);
  input = input_of(mesh);
  input.tets.tuples = std::int64_t(1) << 29;  // refused before anything is read
  EXPECT_EQ(status(input), Status::mesh_too_large);
}

}  // namespace
}  // namespace tetlod
