// Worker: nothing that the worker process does reaches the host but as a value or a Status.
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <thread>
#include <utility>

#include "worker_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST_F(WorkerTest, Works) {
  use(TETLOD_REMESH);
  for (int i = 0; i < 3; i++) EXPECT_TRUE(works());
  EXPECT_EQ(children_of(::getpid()).size(), 1u) << "one process for all calls";
}

TEST_F(WorkerTest, IsNotStartedBeforeItIsNeeded) {
  use("/nonexistent/tetlod-remesh");
  EXPECT_EQ(children_of(::getpid()).size(), 0u);
}

TEST_F(WorkerTest, FakeWorksWhenItDoesNotMisbehave) {
  fake("");
  EXPECT_TRUE(works());
  EXPECT_TRUE(works());
}

TEST_F(WorkerTest, TetGenErrorIsACodeAndTheNextCallWorks) {
  use(TETLOD_REMESH);
  Surface crossing = box(memory, 2);
  append(crossing, box(memory, 3, Vec3(0.5), Vec3(1.5)));
  TetgenRequest request = tetrahedron_request();
  request.points = crossing.points;
  request.triangles = crossing.triangles;
  request.switches = "pY";  // without Q
  int lines = 0;
  job.log = [&](int, const char *) { lines++; };
  tetrahedralize(*worker, request, 0, job, reply);
  EXPECT_GT(lines, 0) << "what TetGen prints before it fails";
  EXPECT_EQ(reply.code, 3);
  EXPECT_EQ(reply.failure, "a self-intersection of the boundary");
  EXPECT_TRUE(works());
}

TEST_F(WorkerTest, TetGenAssertionIsACode) {
  use(TETLOD_REMESH);
  const std::vector<Vec3> identical(10, Vec3(1));
  TetgenRequest request = tetrahedron_request();
  request.points = {identical.data(), identical.size()};
  tetrahedralize(*worker, request, 0, job, reply);
  EXPECT_NE(reply.code, 0);
  EXPECT_FALSE(reply.failure.empty());
  EXPECT_TRUE(works());
}

// What the worker may do wrong

TEST_F(WorkerTest, Dies) {
  const std::pair<const char *, const char *> ways[] = {
      {"crashes", "signal 11 (SEGV)"},     {"aborts", "signal 6 (ABRT)"},   {"exits", "exit status 9"},
      {"leaves a child", "exit status 9"}, {"hangs up", "signal 9 (KILL)"},
  };
  for (const auto &[mode, said] : ways) {
    fake(mode);
    const auto start = Clock::now();
    call();
    EXPECT_EQ(reply.code, worker_died) << mode;
    EXPECT_TRUE(sanitized || reply.failure.find(said) != std::string::npos) << mode << ": " << reply.failure;
    EXPECT_LT(seconds_since(start), 1.5) << mode;
    ::setenv("FAKE_REMESH", "", 1);
    EXPECT_TRUE(works()) << mode;
  }
}

/// As by a system that is short of memory: no other attempt may take its place.
TEST_F(WorkerTest, IsKilled) {
  for (const char *mode : {"is killed", "dies half-way"}) {
    fake(mode);
    EXPECT_EQ(thrown(), Status::memory) << mode;
    EXPECT_NE(message.find("were killed"), std::string::npos) << message;
    ::setenv("FAKE_REMESH", "", 1);
    EXPECT_TRUE(works()) << mode;
  }
}

TEST_F(WorkerTest, IsKilledOnce) {
  const std::string file = testing::TempDir() + "tetlod_killed_once_" + std::to_string(::getpid());
  std::ofstream(file) << "";
  ::setenv("FAKE_REMESH_ONCE", file.c_str(), 1);
  fake("is killed once");
  EXPECT_TRUE(works());
  EXPECT_FALSE(std::ifstream(file).good()) << "it was killed";
}

TEST_F(WorkerTest, Lies) {
  for (const char *mode :
       {"negative counts", "huge counts", "more than written", "less than written", "other regions", "more regions",
        "hole", "hole of terabytes", "index too large", "index negative", "nan", "region too large", "region negative",
        "short message", "long message", "answers another call"}) {
    fake(mode);
    call();
    EXPECT_EQ(reply.code, worker_lied) << mode << ": " << reply.failure;
    ::setenv("FAKE_REMESH", "", 1);
    EXPECT_TRUE(works()) << mode;
  }
}

TEST_F(WorkerTest, LiesThatOnlyTheMeshShows) {
  for (const char *mode : {"too few points", "no points", "no tets", "moved point", "inside out", "tet twice",
                           "flat tet", "region", "crashes", "nan", "text without end"}) {
    fake(mode);
    RemeshResult result(memory);
    try {
      remesh(tetrahedron, Array<Vec3>(&memory), *worker, job, result);
      EXPECT_TRUE(!std::strcmp(mode, "region") || !std::strcmp(mode, "inside out")) << mode;  // these can be put right
      EXPECT_EQ(result.tets.size(), 1u);
    } catch (const Error &error) {
      EXPECT_EQ(error.status(), Status::remesh) << mode;
    }
  }
}

TEST_F(WorkerTest, DiesOrAnswersAgainAfterItsAnswer) {
  fake("dies afterwards");
  EXPECT_TRUE(works());
  EXPECT_TRUE(works());
  fake("answers twice");
  EXPECT_TRUE(works());
  call();
  EXPECT_EQ(reply.code, worker_lied) << "the old answer to a new question";
  EXPECT_TRUE(works());
}

TEST_F(WorkerTest, IsKilledBetweenCalls) {
  use(TETLOD_REMESH);
  ASSERT_TRUE(works());
  ::kill(children_of(::getpid()).at(0), SIGKILL);
  EXPECT_TRUE(works());
}

/// What a batch system sends to all processes of a job, and a host may ignore: another worker may find another mesh.
TEST_F(WorkerTest, LeavesSignalsToItsHost) {
  use(TETLOD_REMESH);
  ASSERT_TRUE(works());
  const std::vector<pid_t> before = children_of(::getpid());
  for (const int signal : {SIGINT, SIGHUP, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM}) {
    ::kill(before.at(0), signal);
    EXPECT_TRUE(works());
  }
  EXPECT_EQ(children_of(::getpid()), before);
}

TEST_F(WorkerTest, TakesTooLong) {
  for (const char *mode : {"hangs", "spins", "stops"}) {
    fake(mode);
    const auto start = Clock::now();
    call(0.1);
    EXPECT_EQ(reply.code, worker_exhausted) << mode;
    EXPECT_LT(seconds_since(start), 1) << mode;
  }
}

/// Its share is of its own time: who else is on the machine has no part in what a result is.
TEST_F(WorkerTest, IsSlowedDown) {
  fake("waits");
  call(0.15);
  EXPECT_EQ(reply.code, 0) << reply.failure;
}

TEST_F(WorkerTest, TimeLimit) {
  fake("spins");
  Job limited(memory, parallel);
  limited.time_limit = 0.1;
  try {
    tetrahedralize(*worker, tetrahedron_request(), 0, limited, reply);
    FAIL();
  } catch (const Error &error) {
    EXPECT_EQ(error.status(), Status::time_limit);
  }
  EXPECT_TRUE(children_of(::getpid()).empty()) << "killed at once";
  ::setenv("FAKE_REMESH", "", 1);
  EXPECT_TRUE(works());
}

TEST_F(WorkerTest, CancelFromAnotherThread) {
  fake("spins");
  std::atomic<bool> cancel{false};
  job.cancel = &cancel;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    cancel = true;
  });
  const auto start = Clock::now();
  EXPECT_EQ(thrown(), Status::cancelled);
  EXPECT_LT(seconds_since(start), 0.5);
  other.join();
  EXPECT_TRUE(children_of(::getpid()).empty());
}

TEST_F(WorkerTest, CancelWhileItShouldGreet) {
  fake("never greets");
  int calls = 0;
  job.progress = [&](Stage, double) { return ++calls > 3; };
  EXPECT_EQ(thrown(), Status::cancelled);
}

TEST_F(WorkerTest, PrintsALot) {
  std::vector<std::string> lines;
  job.log = [&](int level, const char *line) {
    EXPECT_EQ(level, 0);
    EXPECT_LT(std::strlen(line), 600u);
    lines.push_back(line);
  };
  fake("prints");
  EXPECT_TRUE(works());
  ASSERT_GT(lines.size(), 100u);
  EXPECT_LT(lines.size(), 300u);
  EXPECT_EQ(lines[0], "tetlod-remesh: line 0") << "without its end of a text";
  fake("prints for ever");
  call(0.1);
  EXPECT_EQ(reply.code, worker_exhausted);
}

TEST_F(WorkerTest, LogMayThrow) {
  job.log = [](int, const char *) { throw Error(Status::memory, "the log is full"); };
  fake("prints");
  EXPECT_EQ(thrown(), Status::memory);
}

// What may be installed

TEST_F(WorkerTest, IsMissing) {
  use("/nonexistent/tetlod-remesh");
  EXPECT_EQ(thrown(), Status::backend_missing);
  const std::string why = ": No such file or directory; TETLOD_REMESHER or tetlod_config.remesher may name another";
  EXPECT_EQ(message, "cannot execute /nonexistent/tetlod-remesh" + why);
  std::string deep;
  while (deep.size() < 700) deep += "/nonexistent";
  use(deep.c_str());
  EXPECT_EQ(thrown(), Status::backend_missing);
  EXPECT_EQ(message, "cannot execute " + deep + why);
  for (const char *path : {"/etc/passwd", "/tmp", "/bin/true", "/dev/null"}) {
    use(path);
    EXPECT_EQ(thrown(), Status::backend_missing) << path;
    EXPECT_NE(message.find(path), std::string::npos) << message;
  }
}

TEST_F(WorkerTest, IsOfAnotherVersion) {
  for (const char *mode : {"other version", "other protocol", "other magic", "version without end", "short greeting"}) {
    fake(mode);
    EXPECT_EQ(thrown(), Status::backend_missing) << mode;
    EXPECT_NE(message.find(TETLOD_FAKE_REMESH), std::string::npos) << message;
  }
  fake("other version");
  thrown();
  EXPECT_NE(message.find("0.0.7"), std::string::npos) << message;
}

TEST_F(WorkerTest, DiesAtStart) {
  fake("dies at start");
  EXPECT_EQ(thrown(), Status::backend_missing);
  EXPECT_NE(message.find("exit status 127"), std::string::npos) << message;
  EXPECT_NE(message.find("no such library"), std::string::npos) << message;
}

/// Not by a fault of the installation.
TEST_F(WorkerTest, IsKilledAtStart) {
  fake("is killed at start");
  EXPECT_EQ(thrown(), Status::memory);
  EXPECT_NE(message.find("killed"), std::string::npos) << message;
}

/// As before Linux 5.3, whatever the container. Of this thread alone. False: it may not be.
bool do_without_pidfds() {
  sock_filter steps[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                         BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_pidfd_open, 0, 1),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                         BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{4, steps};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST_F(WorkerTest, TheSystemHasNoPidfds) {
  use(TETLOD_REMESH);
  bool has_none = false;
  Status status = Status::ok;
  std::thread([&] {
    has_none = do_without_pidfds();
    status = thrown();
  }).join();
  if (!has_none) GTEST_SKIP() << "the system allows no filter of its calls";
  EXPECT_EQ(status, Status::backend_missing);
  EXPECT_TRUE(children_of(::getpid()).empty());
}

TEST_F(WorkerTest, EnvironmentNamesIt) {
  ::setenv("TETLOD_REMESHER", TETLOD_FAKE_REMESH, 1);
  EXPECT_EQ(find_remesher(), TETLOD_FAKE_REMESH);
  use("");
  ::unsetenv("TETLOD_REMESHER");
  EXPECT_TRUE(works());
  EXPECT_NE(find_remesher().find("tetlod-remesh"), std::string::npos);
}

}  // namespace
}  // namespace tetlod
