// Worker: several processes with a call each. What one of them does is no matter of the others.
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <map>
#include <thread>

#include "patience.hpp"
#include "worker_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

class SeveralWorkers : public WorkerTest {
 protected:
  SeveralWorkers() { fake(""); }

  /// The mode is that of a process which is not running yet.
  void begin(std::size_t process, const char *mode, double seconds = 0) {
    ::setenv("FAKE_REMESH", mode, 1);
    worker->begin(process, tetrahedron_request(), seconds, job);
  }

  /// The codes of the replies to `count` calls, by process.
  std::map<std::size_t, int> finish(std::size_t count) {
    std::map<std::size_t, int> codes;
    for (std::size_t i = 0; i < count; i++) {
      const std::size_t process = worker->finish_any(job, reply);
      EXPECT_EQ(codes.count(process), 0u);
      codes[process] = reply.code;
      if (reply.code == 0) {
        EXPECT_EQ(reply.tets.size(), 1u);
      }
    }
    return codes;
  }

  Status finish_thrown() {
    try {
      worker->finish_any(job, reply);
      return Status::ok;
    } catch (const Error &error) {
      message = error.what();
      return error.status();
    }
  }

  static bool no_children() { return children_of(::getpid()).empty(); }
};

using Codes = std::map<std::size_t, int>;

TEST_F(SeveralWorkers, LiveOnBetweenCalls) {
  use(TETLOD_REMESH);
  for (int round = 0; round < 3; round++) {
    for (std::size_t i = 0; i < 4; i++) begin(i, "");
    EXPECT_EQ(finish(4), (Codes{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
    EXPECT_TRUE(works());
    EXPECT_EQ(children_of(::getpid()).size(), 4u);
  }
}

TEST_F(SeveralWorkers, WorkAtTheSameTime) {
  const auto start = Clock::now();
  for (std::size_t i = 0; i < 4; i++) begin(i, "waits");
  EXPECT_EQ(finish(4).size(), 4u);
  EXPECT_LT(seconds_since(start), 3 * 0.3) << "each waits 0.3 s";
}

TEST_F(SeveralWorkers, AreAnsweredInTheOrderInWhichTheyEnd) {
  begin(0, "waits");
  begin(1, "");
  EXPECT_EQ(worker->finish_any(job, reply), 1u);
  begin(1, "");  // again while the other still waits
  EXPECT_EQ(worker->finish_any(job, reply), 1u);
  EXPECT_EQ(worker->finish_any(job, reply), 0u);
}

TEST_F(SeveralWorkers, OneDiesOrLies) {
  const std::pair<const char *, int> ways[] = {
      {"crashes", worker_died},       {"aborts", worker_died},          {"exits", worker_died},
      {"hangs up", worker_died},      {"negative counts", worker_lied}, {"nan", worker_lied},
      {"short message", worker_lied},
  };
  for (const auto &[mode, code] : ways) {
    fake("");
    begin(0, "waits");
    begin(1, mode);
    begin(2, "");
    EXPECT_EQ(finish(3), (Codes{{0, 0}, {1, code}, {2, 0}})) << mode;
    for (std::size_t i = 0; i < 3; i++) begin(i, "");
    EXPECT_EQ(finish(3), (Codes{{0, 0}, {1, 0}, {2, 0}})) << mode;
  }
}

TEST_F(SeveralWorkers, OneTakesTooLong) {
  for (const char *mode : {"hangs", "spins", "stops", "prints for ever"}) {
    fake("");
    const auto start = Clock::now();
    begin(0, mode, 0.1);
    begin(1, "");
    EXPECT_EQ(finish(2), (Codes{{0, worker_exhausted}, {1, 0}})) << mode;
    EXPECT_LT(seconds_since(start), 1.5) << mode;
  }
}

TEST_F(SeveralWorkers, AllAreKilledBetweenCalls) {
  use(TETLOD_REMESH);
  for (int round = 0; round < 2; round++) {
    for (std::size_t i = 0; i < 3; i++) begin(i, "");
    EXPECT_EQ(finish(3), (Codes{{0, 0}, {1, 0}, {2, 0}}));
    for (const pid_t pid : children_of(::getpid())) ::kill(pid, SIGKILL);
  }
}

TEST_F(SeveralWorkers, CancelEndsAll) {
  std::atomic<bool> cancel{false};
  job.cancel = &cancel;
  for (std::size_t i = 0; i < 3; i++) begin(i, "spins");
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    cancel = true;
  });
  const auto start = Clock::now();
  EXPECT_EQ(finish_thrown(), Status::cancelled);
  EXPECT_LT(seconds_since(start), 0.5);
  other.join();
  EXPECT_TRUE(no_children());
  cancel = false;
  ::setenv("FAKE_REMESH", "", 1);
  EXPECT_TRUE(works());
}

TEST_F(SeveralWorkers, TimeLimitEndsAll) {
  for (std::size_t i = 0; i < 3; i++) begin(i, "hangs");
  job.time_limit = 0.01;
  EXPECT_EQ(finish_thrown(), Status::time_limit);
  EXPECT_TRUE(no_children());
}

TEST_F(SeveralWorkers, FailureOfOneToStartEndsAll) {
  begin(0, "spins");
  begin(1, "hangs");
  try {
    begin(2, "other version");
    FAIL();
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::backend_missing);
  }
  EXPECT_TRUE(no_children());
}

TEST_F(SeveralWorkers, LogThatThrowsEndsAll) {
  job.log = [](int, const char *) { throw Error(Status::memory, "the log is full"); };
  begin(0, "spins");
  begin(1, "prints");
  EXPECT_EQ(finish_thrown(), Status::memory);
  EXPECT_TRUE(no_children());
}

TEST_F(SeveralWorkers, AbandonedOrDestroyedInTheMiddleOfCalls) {
  begin(0, "");
  EXPECT_EQ(finish(1), (Codes{{0, 0}}));
  begin(1, "spins");
  begin(2, "prints for ever");
  worker->abandon();
  EXPECT_EQ(children_of(::getpid()).size(), 1u) << "the idle one stays";
  begin(1, "");
  EXPECT_EQ(finish(1), (Codes{{1, 0}}));
  begin(2, "hangs");
  worker.reset();
  EXPECT_TRUE(no_children());
}

TEST_F(SeveralWorkers, InheritNothingOfEachOther) {
  begin(0, "hangs");
  begin(1, "descriptors");
  EXPECT_EQ(finish(1), (Codes{{1, 106}}));
}

TEST_F(SeveralWorkers, ToldProgressIsEachCallsOwn) {
  std::map<int, double> told;
  const auto request = [&](int call) {
    TetgenRequest of = tetrahedron_request();
    of.progress = [&told, call](double fraction) {
      EXPECT_GE(fraction, told[call]);
      EXPECT_LT(fraction, 1);
      return told[call] = fraction;
    };
    return of;
  };
  ::setenv("FAKE_REMESH", "waits", 1);
  for (int i = 0; i < 2; i++) worker->begin(std::size_t(i), request(i), 0, job);
  EXPECT_EQ(finish(2).size(), 2u);
  EXPECT_GT(told[0], 0.5) << "a tetrahedron takes a millisecond, it is thought";
  EXPECT_GT(told[1], 0.5);
}

/// A job that a batch system suspends, or a debugger stops.
TEST_F(SeveralWorkers, PatienceCountsASecondOfAPauseThatStoppedTheHostToo) {
  double told = 0;
  const Patience patience(0, 1, [&](double fraction) { return told = fraction; });
  std::this_thread::sleep_for(std::chrono::milliseconds(1700));
  patience.poll(job);
  EXPECT_NEAR(told, 0.5, 0.01);
}

/// The clock goes on while the fraction is worked out; what is told must not go back.
TEST_F(SeveralWorkers, PatienceTellsNoLessThanBefore) {
  double told = 0;
  const Patience patience(0, 1e-3, [&](double fraction) {
    EXPECT_GE(fraction, told);
    return told = fraction;
  });
  for (int i = 0; i < 1000000 && !HasFailure(); i++) patience.poll(job);
}

/// A host that forks while calls are under way: they stay the parent's.
TEST_F(SeveralWorkers, ForkedHost) {
  begin(0, "waits");
  begin(1, "waits");
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::setenv("FAKE_REMESH", "", 1);
    bool good = works() && children_of(::getpid()).size() == 1;
    worker.reset();
    ::_exit(good && no_children() ? 0 : 1);
  }
  int status = -1;
  ::waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(finish(2), (Codes{{0, 0}, {1, 0}}));
}

TEST_F(SeveralWorkers, DescriptorsClosedInTheMiddleOfCalls) {
  EXPECT_TRUE(in_a_child([&] {
    begin(0, "waits");
    begin(1, "waits");
    for (int descriptor = 3; descriptor < 64; descriptor++) ::close(descriptor);
    const bool refused = finish_thrown() == Status::state;
    ::setenv("FAKE_REMESH", "", 1);
    return refused && works();
  }));
}

TEST_F(SeveralWorkers, HostIgnoresOrReapsItsChildren) {
  struct sigaction reaping = {}, ignoring = {}, old;
  reaping.sa_handler = [](int) {
    const int before = errno;
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    errno = before;
  };
  ignoring.sa_handler = SIG_IGN;
  for (const struct sigaction *way : {&reaping, &ignoring}) {
    sigaction(SIGCHLD, way, &old);
    fake("");
    begin(0, "crashes");
    begin(1, "waits");
    begin(2, "exits");
    EXPECT_EQ(finish(3), (Codes{{0, worker_died}, {1, 0}, {2, worker_died}}));
    worker.reset();
    sigaction(SIGCHLD, &old, nullptr);
  }
}

TEST_F(SeveralWorkers, EndWithAKilledHost) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t host = ::fork();
  if (host == 0) {
    use(TETLOD_REMESH);
    begin(2, "");
    finish(1);  // one is idle
    const Surface surface = sphere(memory, 20);
    const auto samples = random_points(memory, 500000, 0.5, [](const Vec3 &) { return true; });
    std::vector<Vec3> points(surface.points.begin(), surface.points.end());
    points.insert(points.end(), samples.begin(), samples.end());
    TetgenRequest long_request = tetrahedron_request();
    long_request.points = {points.data(), points.size()};
    long_request.triangles = surface.triangles;
    for (const std::size_t process : {0, 1}) worker->begin(process, long_request, 0, job);
    if (::write(ready[1], "", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::close(ready[0]);
  ::close(ready[1]);
  const std::vector<pid_t> workers = children_of(host);
  EXPECT_EQ(workers.size(), 3u);
  ::kill(host, SIGKILL);
  ::waitpid(host, nullptr, 0);
  const auto ended = [](pid_t pid) { return state_of(pid).state == 'X' || state_of(pid).state == 'Z'; };
  const auto start = Clock::now();
  while (!std::all_of(workers.begin(), workers.end(), ended) && seconds_since(start) < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_TRUE(std::all_of(workers.begin(), workers.end(), ended));
}

}  // namespace
}  // namespace tetlod
