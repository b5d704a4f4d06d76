// 3.4  remesh() of several solids, several at once.
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <thread>

#include "remesh_fixture.hpp"
#include "worker_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

constexpr std::size_t each_alone = 1;

/// Three spheres, the middle one with a cavity in which there is a fourth; all with samples.
class RemeshSolids : public Remesh {
 protected:
  Surface surface{memory};
  Array<Vec3> samples{&memory};
  std::vector<std::pair<std::size_t, std::size_t>> points_of, samples_of, triangles_of;  // of each sphere: from, to

  RemeshSolids() {
    for (int i = 0; i < 4; i++) {
      const Vec3 centre(i == 3 ? 2.5 : 2.5 * i, 0, 0);
      const double radius = i == 3 ? 0.3 : 1, cavity = i == 1 ? 0.5 : 0;
      points_of.push_back({surface.points.size(), 0});
      samples_of.push_back({samples.size(), 0});
      triangles_of.push_back({surface.triangles.size(), 0});
      append(surface, sphere(memory, 6 - i, radius, centre));
      if (cavity > 0) append(surface, sphere(memory, 3, cavity, centre), true);
      for (const Vec3 &p : random_points(memory, 300, 0.85, [&](const Vec3 &p) {
             return glm::length(p) < 0.85 && glm::length(p) > cavity * 1.3;
           }))
        samples.push_back(centre + radius * p);
      points_of.back().second = surface.points.size();
      samples_of.back().second = samples.size();
      triangles_of.back().second = surface.triangles.size();
    }
  }

  void run_with(int threads, RemeshResult &into) {
    const Parallel several(threads);
    Job own(memory, several);
    remesh(surface, samples, worker, own, into, each_alone);
  }
};

TEST_F(RemeshSolids, EachForItself) {
  run_with(2, result);
  expect_good(surface, samples);
  EXPECT_EQ(result.report.attempts, 1);
  EXPECT_EQ(result.report.dropped_samples, 0);
  EXPECT_GT(result.report.worker_peak_bytes, 1u << 20);
}

TEST_F(RemeshSolids, SameBytesForAnyNumberOfThreads) {
  run_with(1, result);
  const std::vector<char> first = bytes(result);
  for (const int threads : {2, 3, 8}) {
    RemeshResult again(memory);
    run_with(threads, again);
    EXPECT_EQ(bytes(again), first) << threads;
  }
  EXPECT_EQ(children_of(::getpid()).size(), 4u) << "one for each solid, at most";
}

/// The tets of each solid, and their points, are those that it gets when there is nothing else.
TEST_F(RemeshSolids, EachAsIfItWereAlone) {
  run_with(2, result);
  std::size_t tets = 0;
  for (std::size_t i = 0; i < points_of.size(); i++) {
    const auto [first_point, last_point] = points_of[i];
    const auto [first_sample, last_sample] = samples_of[i];
    Surface own(memory);
    own.points.assign(surface.points.begin() + long(first_point), surface.points.begin() + long(last_point));
    for (std::size_t t = triangles_of[i].first; t < triangles_of[i].second; t++) {
      own.triangles.push_back(surface.triangles[t]);
      for (std::int32_t &corner : own.triangles.back()) corner -= std::int32_t(first_point);
    }
    Array<Vec3> own_samples(samples.begin() + long(first_sample), samples.begin() + long(last_sample), &memory);
    RemeshResult alone(memory);
    remesh(own, own_samples, worker, job, alone, each_alone);
    for (const Tet &tet : alone.tets) {
      for (std::size_t k = 0; k < 4; k++)
        ASSERT_EQ(alone.points[std::size_t(tet[k])], result.points[std::size_t(result.tets[tets][k])]);
      tets++;
    }
  }
  EXPECT_EQ(tets, result.tets.size());
}

TEST_F(RemeshSolids, OneSolidHasTheSameBytesAsEver) {
  Surface one = torus(memory, 30, 12);
  append(one, sphere(memory, 2, 0.2, Vec3(1, 0, 0)), true);
  run(one, no_samples());
  const std::vector<char> before = bytes(result);
  remesh(one, no_samples(), worker, job, result, each_alone);
  EXPECT_EQ(bytes(result), before);
}

TEST_F(RemeshSolids, Groups) {
  for (const std::size_t at_once : {100, 700, 1300, 100000}) {
    remesh(surface, samples, worker, job, result, at_once);
    expect_good(surface, samples);
  }
}

TEST_F(RemeshSolids, SamplesInNoMaterialAreDropped) {
  samples.push_back(Vec3(50, 0, 0));
  samples.push_back(Vec3(2.5, 0.4, 0));  // in the cavity
  samples.push_back(surface.points[10]);
  run_with(2, result);
  expect_good(surface, samples);
  EXPECT_EQ(result.report.dropped_samples, 3);
}

/// Solids in cavities of others, one of which hangs on the wall, and samples everywhere.
TEST_F(RemeshSolids, Nested) {
  Surface nested = box(memory, 6, Vec3(-3), Vec3(3));
  append(nested, box(memory, 4, Vec3(-2), Vec3(2)), true);
  Surface hanging = box(memory, 2, Vec3(-1), Vec3(0));
  for (Vec3 &p : hanging.points)
    if (p == Vec3(-1)) p = Vec3(-2);
  append(nested, hanging);
  append(nested, box(memory, 1, Vec3(-0.75), Vec3(-0.25)), true);
  append(nested, box(memory, 1, Vec3(-0.6), Vec3(-0.4)));
  append(nested, box(memory, 2, Vec3(1), Vec3(1.5)));
  surface = Surface(welded(memory, nested));
  samples = random_points(memory, 2000, 3.2, [](const Vec3 &) { return true; });
  run_with(2, result);
  expect_good(surface, samples);
  EXPECT_GT(result.report.dropped_samples, 200);
  EXPECT_LT(result.report.dropped_samples, 1000);
}

TEST_F(RemeshSolids, AThousandLittleOnes) {
  Surface many(memory);
  for (int i = 0; i < 1000; i++) {
    const Vec3 low = 1.5 * Vec3(i % 10, i / 10 % 10, i / 100);
    append(many, box(memory, 1, low, low + Vec3(1)));
  }
  const Parallel several(3);
  Job own(memory, several);
  remesh(many, no_samples(), worker, own, result, 1000);
  expect_good(many, no_samples());
  EXPECT_EQ(children_of(::getpid()).size(), 3u);
}

TEST_F(RemeshSolids, ProgressNeverGoesBack) {
  double last = 0;
  job.progress = [&](Stage, double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1);
    last = fraction;
    return false;
  };
  remesh(surface, samples, worker, job, result, each_alone);
  EXPECT_GT(last, 0);
}

TEST_F(RemeshSolids, MemoryLimitAtAnyAllocation) {
  const Parallel several(2);
  int failures = 0;
  for (std::size_t limit = 10000;; limit += limit / 4) {
    Memory scarce({}, limit);
    Job poor(scarce, several);
    RemeshResult own(scarce);
    try {
      remesh(surface, samples, worker, poor, own, each_alone);
      break;
    } catch (const Error &error) {
      EXPECT_EQ(error.status(), Status::memory_limit);
      failures++;
    }
    EXPECT_EQ(scarce.in_use(), 0u);
  }
  EXPECT_GT(failures, 5);
}

/// The worker fails so often that at least one of the parts needs further attempts.
TEST_F(RemeshSolids, PartsThatNeedFurtherAttempts) {
  const std::string file = testing::TempDir() + "tetlod_part_failures_" + std::to_string(::getpid());
  ::setenv("FAKE_REMESH_FAILURES", file.c_str(), 1);
  const Parallel several(2);
  Job own(memory, several);
  for (int failures = 1; failures < 6; failures++) {
    ::setenv("FAKE_REMESH", std::to_string(failures).c_str(), 1);
    Worker failing(TETLOD_FAKE_REMESH);
    remesh(surface, samples, failing, own, result, each_alone);
    ::unlink(file.c_str());
    EXPECT_GT(result.report.attempts, 1);
    EXPECT_LE(result.report.attempts, failures + 1);
    expect_good(surface, samples);
  }
  ::unsetenv("FAKE_REMESH_FAILURES");
  ::unsetenv("FAKE_REMESH");
}

TEST_F(RemeshSolids, OneThatCannotBeFilledIsNamed) {
  run_with(2, result);
  const std::vector<char> before = bytes(result);
  Surface pushed_through = sphere(memory, 4, 1, Vec3(10));
  pushed_through.points[0] += 2.5 * (Vec3(10) - pushed_through.points[0]);
  append(surface, pushed_through);
  try {
    run_with(2, result);
    FAIL();
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::remesh);
    EXPECT_NE(std::string(error.what()).find("part 5 of 5, plain: "), std::string::npos) << error.what();
  }
  EXPECT_EQ(bytes(result), before);
  run(sphere(memory, 3), no_samples());  // the worker is as good as before
}

TEST_F(RemeshSolids, CancelEndsAllCalls) {
  Worker spinning(TETLOD_FAKE_REMESH);
  const Parallel several(3);
  Job own(memory, several);
  int calls = 0;
  own.progress = [&](Stage, double) { return ++calls > 10; };
  ::setenv("FAKE_REMESH", "spins", 1);
  try {
    remesh(surface, samples, spinning, own, result, each_alone);
    FAIL();
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::cancelled);
  }
  ::unsetenv("FAKE_REMESH");
  EXPECT_TRUE(children_of(::getpid()).empty());
}

}  // namespace
}  // namespace tetlod
