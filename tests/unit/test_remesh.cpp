// 3.4  remesh(): whatever closed surface comes in, a mesh that keeps it comes out.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <thread>

#include "remesh_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST_F(Remesh, Tetrahedron) {
  Surface surface(memory);
  surface.points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, &memory};
  for (const auto &face : tet_face) surface.triangles.push_back({face[0], face[1], face[2]});
  run(surface, no_samples());
  expect_good(surface, no_samples());
  EXPECT_EQ(result.tets.size(), 1u);
  EXPECT_EQ(result.report.attempts, 1);
}

TEST_F(Remesh, Sphere) {
  const Surface surface = sphere(memory, 12);
  const auto samples = random_points(memory, 2000, 1, [](const Vec3 &p) { return glm::length(p) < 0.9; });
  run(surface, samples);
  expect_good(surface, samples);
  EXPECT_EQ(result.report.attempts, 1);
  EXPECT_EQ(result.report.dropped_samples, 0);
  EXPECT_GT(result.report.worker_peak_bytes, 1u << 20);
}

TEST_F(Remesh, Cube) {
  const Surface surface = box(memory, 8, Vec3(-1), Vec3(1));
  const auto samples = random_points(memory, 2000, 0.9, [](const Vec3 &) { return true; });
  run(surface, samples);
  expect_good(surface, samples);
}

TEST_F(Remesh, Torus) {
  const Surface surface = torus(memory, 48, 20);
  const auto samples =
      random_points(memory, 1000, 1.4, [](const Vec3 &p) { return std::hypot(std::hypot(p.x, p.y) - 1, p.z) < 0.3; });
  run(surface, samples);
  expect_good(surface, samples);
}

TEST_F(Remesh, CubeWithOneCavity) {
  Surface surface = box(memory, 4, Vec3(-1), Vec3(1));
  append(surface, box(memory, 2, Vec3(-0.3), Vec3(0.4)), true);
  const auto samples = random_points(memory, 300, 0.9, [](const Vec3 &p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > 0.5;
  });
  run(surface, samples);
  expect_good(surface, samples);
  EXPECT_EQ(result.report.attempts, 1);
}

TEST_F(Remesh, CubeWithTwentySevenCavities) {
  Surface surface = box(memory, 8, Vec3(0), Vec3(4));
  for (int i = 0; i < 27; i++) {
    const Vec3 centre(1 + i % 3, 1 + i / 3 % 3, 1 + i / 9);
    append(surface, sphere(memory, 3, 0.3, centre), true);
  }
  run(surface, no_samples());
  expect_good(surface, no_samples());
}

TEST_F(Remesh, SolidInACavityInASolid) {
  Surface surface = box(memory, 3, Vec3(-3), Vec3(3));
  append(surface, box(memory, 2, Vec3(-2), Vec3(2)), true);
  append(surface, box(memory, 2, Vec3(-1), Vec3(1)));
  append(surface, box(memory, 1, Vec3(-0.5), Vec3(0.5)), true);
  run(surface, no_samples());
  expect_good(surface, no_samples());
}

TEST_F(Remesh, TwoSolids) {
  Surface surface = sphere(memory, 6);
  append(surface, sphere(memory, 5, 0.5, Vec3(3, 0, 0)));
  run(surface, no_samples());
  expect_good(surface, no_samples());
}

TEST_F(Remesh, CubesThatShareAVertexOrAnEdge) {
  for (const Vec3 &low : {Vec3(1, 1, 1), Vec3(1, 1, 0)}) {
    Surface apart = box(memory, 2);
    append(apart, box(memory, 2, low, low + Vec3(1)));
    const Surface surface = welded(memory, apart);
    ASSERT_LT(surface.points.size(), apart.points.size());
    run(surface, no_samples());
    expect_good(surface, no_samples());
  }
}

TEST_F(Remesh, CavitiesThatTouchEachOther) {
  for (const int up : {0, 1}) {  // along an edge; at a vertex
    Surface apart = box(memory, 4, Vec3(0), Vec3(4));
    append(apart, box(memory, 1, Vec3(1), Vec3(2)), true);
    append(apart, box(memory, 1, Vec3(2, 2, 1 + up), Vec3(3, 3, 2 + up)), true);
    const Surface surface = welded(memory, apart);
    run(surface, no_samples());
    expect_good(surface, no_samples());
  }
}

TEST_F(Remesh, CavityThatTouchesTheOutside) {
  Surface octahedron(memory);
  octahedron.points = {{{1, 2, 3}, {3, 2, 3}, {2, 1, 3}, {2, 3, 3}, {2, 2, 2}, {2, 2, 4}}, &memory};
  octahedron.triangles = {{{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}},
                          &memory};
  Surface apart = box(memory, 4, Vec3(0), Vec3(4));
  append(apart, octahedron, true);
  const Surface surface = welded(memory, apart);
  ASSERT_EQ(surface.points.size() + 1, apart.points.size());
  run(surface, no_samples());
  expect_good(surface, no_samples());
}

TEST_F(Remesh, RotatedBoxes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.05, 1);
  int retried = 0;
  for (int i = 0; i < 200; i++) {
    Surface surface = box(memory, 1 + i % 3, Vec3(0), Vec3(uniform(random), uniform(random), uniform(random)));
    const glm::dmat3 rotation = random_rotation(random);
    transform(surface, [&](const Vec3 &p) { return rotation * p; });
    ASSERT_EQ(status(surface), Status::ok) << i << ": " << message;
    expect_good(surface, no_samples());
    retried += result.report.attempts > 1;
  }
  RecordProperty("retried", retried);
}

TEST_F(Remesh, AnyScale) {
  for (const int exponent : {-300, -150, -100, -30, -10, 10, 30, 100, 200, 307}) {
    const double scale = std::pow(10.0, exponent);
    Surface surface = sphere(memory, 5);
    transform(surface, [&](const Vec3 &p) { return scale * p; });
    Array<Vec3> samples = random_points(memory, 50, 0.6, [](const Vec3 &p) { return glm::length(p) < 0.6; });
    for (Vec3 &p : samples) p *= scale;
    ASSERT_EQ(status(surface, samples), Status::ok) << message;
    EXPECT_EQ(result.report.attempts, 1);
    expect_good(surface, samples);
  }
}

TEST_F(Remesh, FarFromTheOrigin) {
  Surface surface = sphere(memory, 5);
  transform(surface, [&](const Vec3 &p) { return p + Vec3(1e6, -1e9, 0); });
  ASSERT_EQ(status(surface), Status::ok) << message;
  expect_good(surface, no_samples());
}

TEST_F(Remesh, AtTheEndOfWhatDoublesResolve) {
  const Surface near = box(memory, 3);
  Surface surface(memory);
  surface = near;
  transform(surface, [&](const Vec3 &p) { return p + Vec3(1e15); });  // a ruler of eighths
  ASSERT_EQ(status(surface), Status::ok) << message;
  expect_good(surface, no_samples());
  surface = near;
  transform(surface, [&](const Vec3 &p) { return p + Vec3(1e17, 0, 0); });
  EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
  surface = near;
  transform(surface, [&](const Vec3 &p) { return 4.0 * p + Vec3(1e16); });  // vertices fall together
  EXPECT_EQ(status(surface), Status::mesh_degenerate) << message;
}

TEST_F(Remesh, AThinPlate) {
  const Surface surface = box(memory, 4, Vec3(0), Vec3(1, 1, 1e-9));
  const Status outcome = status(surface);
  if (outcome == Status::ok)
    expect_good(surface, no_samples());
  else
    EXPECT_EQ(outcome, Status::remesh) << message;
}

TEST_F(Remesh, SamplesInBadPlaces) {
  const Surface surface = box(memory, 3, Vec3(-1), Vec3(1));
  Array<Vec3> samples(&memory);
  samples = {{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {5, 0, 0}, {1, 0.1, 0.2}, {1, 1, 1}, {1 - 1e-12, 0.1, 0.1}}, &memory};
  run(surface, samples);
  expect_good(surface, samples);
  EXPECT_GE(result.report.dropped_samples, 3);
}

TEST_F(Remesh, SamplesFarAwayAreLeftOutAtOnce) {
  const Surface surface = box(memory, 3, Vec3(-1), Vec3(1));
  for (const double far : {1e100, 1e305, std::numeric_limits<double>::max()}) {
    Array<Vec3> samples(&memory);
    samples = {{{0.1, 0.2, 0.3}, {far, 0, 0}, {far, -far, far}, {0, 0, -far}}, &memory};
    run(surface, samples);
    expect_good(surface, samples);
    EXPECT_EQ(result.report.dropped_samples, 3);
    EXPECT_EQ(result.report.attempts, 1);
  }
}

/// The worker fails so often that the attempt in question is the one that has to do.
TEST_F(Remesh, EveryAttemptOfTheLadder) {
  Surface surface = sphere(memory, 8);
  append(surface, sphere(memory, 4, 0.3), true);
  const auto samples =
      random_points(memory, 1000, 0.95, [](const Vec3 &p) { return glm::length(p) < 0.95 && glm::length(p) > 0.35; });
  const std::string file = testing::TempDir() + "tetlod_failures_" + std::to_string(::getpid());
  ::setenv("FAKE_REMESH_FAILURES", file.c_str(), 1);
  for (int failures = 0; failures < 8; failures++) {
    ::setenv("FAKE_REMESH", std::to_string(failures).c_str(), 1);
    Worker failing(TETLOD_FAKE_REMESH);
    remesh(surface, samples, failing, job, result);
    ::unlink(file.c_str());
    EXPECT_EQ(result.report.attempts, failures + 1);
    expect_good(surface, samples);
    const std::int64_t dropped = result.report.dropped_samples;
    EXPECT_TRUE(failures == 6 ? dropped > 100 && dropped < 900 : dropped == (failures == 7 ? 1000 : 0)) << dropped;
  }
  ::unsetenv("FAKE_REMESH_FAILURES");
  ::unsetenv("FAKE_REMESH");
}

/// An endless loop of each attempt would take minutes.
TEST_F(Remesh, TheFirstRungIsOneAttemptOfASecond) {
  ::setenv("FAKE_REMESH", "spins", 1);
  Worker endless(TETLOD_FAKE_REMESH);
  const Surface surface = sphere(memory, 4);
  try {
    remesh(surface, no_samples(), endless, job, result, usual_points_at_once, {}, Ladder::first_rung);
    ADD_FAILURE() << "it ended";
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::remesh);
    EXPECT_NE(std::string(error.what()).find("(plain: took more than 1000 ms)"), std::string::npos) << error.what();
  }
  ::unsetenv("FAKE_REMESH");
}

TEST_F(Remesh, FailureLeavesTheResultAlone) {
  run(sphere(memory, 4), no_samples());
  const std::vector<Vec3> before(result.points.begin(), result.points.end());
  Surface crossing = box(memory, 2);
  append(crossing, box(memory, 3, Vec3(0.5), Vec3(1.5)));
  EXPECT_EQ(status(crossing), Status::remesh);
  EXPECT_NE(message.find("facets reversed"), std::string::npos) << message;
  EXPECT_TRUE(std::equal(before.begin(), before.end(), result.points.begin(), result.points.end()));
}

TEST_F(Remesh, MemoryIsAllGivenBack) {
  const std::size_t before = memory.in_use();
  {
    const Surface surface = sphere(memory, 6);
    RemeshResult own(memory);
    remesh(surface, no_samples(), worker, job, own);
  }
  EXPECT_EQ(memory.in_use(), before);
}

TEST_F(Remesh, MemoryLimitAtAnyAllocation) {
  const Surface surface = sphere(memory, 3);
  const std::vector<Vec3> points(surface.points.begin(), surface.points.end());
  int failures = 0;
  for (std::size_t limit = 1000;; limit += limit / 4) {
    Memory scarce({}, limit);
    Job poor(scarce, parallel);
    RemeshResult own(scarce);
    try {
      remesh(surface, no_samples(), worker, poor, own);
      break;
    } catch (const Error &error) {
      EXPECT_EQ(error.status(), Status::memory_limit);
      failures++;
    }
    EXPECT_EQ(scarce.in_use(), 0u);
  }
  EXPECT_GT(failures, 5);
}

TEST_F(Remesh, SameBytesEveryTime) {
  Surface surface = sphere(memory, 10);
  append(surface, sphere(memory, 4, 0.4), true);
  const auto samples =
      random_points(memory, 3000, 0.9, [](const Vec3 &p) { return glm::length(p) < 0.9 && glm::length(p) > 0.5; });
  run(surface, samples);
  const std::vector<char> first = bytes(result);
  run(surface, samples);
  EXPECT_EQ(bytes(result), first) << "second call of a worker";
  run(torus(memory, 30, 12), no_samples());
  run(surface, samples);
  EXPECT_EQ(bytes(result), first) << "after another mesh";
  for (int threads : {1, 2, 4}) {
    const Parallel several(threads);
    Job other(memory, several);
    Worker fresh(TETLOD_REMESH);
    remesh(surface, samples, fresh, other, result);
    EXPECT_EQ(bytes(result), first) << "a fresh worker, threads: " << threads;
  }
}

TEST_F(Remesh, FourThreadsWithAWorkerEach) {
  const Surface surface = sphere(memory, 8);
  const auto samples = random_points(memory, 500, 0.8, [](const Vec3 &p) { return glm::length(p) < 0.8; });
  run(surface, samples);
  const std::vector<char> expected = bytes(result);
  std::vector<std::vector<char>> found(4);
  std::vector<std::thread> threads;
  for (auto &mine : found)
    threads.emplace_back([&] {
      Memory own;
      Job own_job(own, parallel);
      Worker own_worker(TETLOD_REMESH);
      for (int round = 0; round < 5; round++) {
        RemeshResult own_result(own);
        remesh(surface, samples, own_worker, own_job, own_result);
        mine = bytes(own_result);
      }
    });
  for (std::thread &thread : threads) thread.join();
  for (const auto &mine : found) EXPECT_EQ(mine, expected);
}

TEST_F(Remesh, ProgressNeverGoesBack) {
  double last = 0;
  job.progress = [&](Stage, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return false;
  };
  Surface crossing = box(memory, 2);
  append(crossing, box(memory, 3, Vec3(0.5), Vec3(1.5)));
  EXPECT_EQ(status(crossing), Status::remesh);
}

}  // namespace
}  // namespace tetlod
