// Worker: hosts that fork, close descriptors, run out of them, ignore or reap their children, or are killed.
#include <fcntl.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <map>
#include <thread>

#include "worker_fixture.hpp"

namespace tetlod {
namespace {

using namespace test;

bool has_ended(pid_t pid) {
  const char state = state_of(pid).state;
  return state == 'X' || state == 'Z';
}

template <class Condition>
bool soon(double seconds, const Condition &condition) {
  const auto start = Clock::now();
  while (!condition()) {
    if (seconds_since(start) > seconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

TEST_F(WorkerTest, InheritsNothing) {
  std::vector<int> opened;
  for (int i = 0; i < 20; i++) opened.push_back(::open("/dev/null", O_RDONLY));  // not close-on-exec
  fake("descriptors");
  call();
  for (const int descriptor : opened) ::close(descriptor);
  EXPECT_EQ(reply.code, 106);
}

TEST_F(WorkerTest, SignalsAreFresh) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  struct sigaction ignored = {}, old;
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGUSR1, &ignored, &old);
  fake("signals");
  call();
  sigaction(SIGUSR1, &old, nullptr);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_TRUE(sanitized || reply.code == 100) << reply.code;
}

TEST_F(WorkerTest, HostIgnoresSigchld) {
  struct sigaction ignored = {}, old;
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGCHLD, &ignored, &old);
  use(TETLOD_REMESH);
  EXPECT_TRUE(works());
  fake("crashes");
  call();
  EXPECT_EQ(reply.code, worker_died);
  EXPECT_TRUE(children_of(::getpid()).empty());
  use(TETLOD_REMESH);
  EXPECT_TRUE(works());
  worker.reset();
  sigaction(SIGCHLD, &old, nullptr);
}

TEST_F(WorkerTest, HostReapsEveryChild) {
  struct sigaction reaping = {}, old;
  reaping.sa_handler = [](int) {
    const int before = errno;
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    errno = before;
  };
  sigaction(SIGCHLD, &reaping, &old);
  use(TETLOD_REMESH);
  EXPECT_TRUE(works());
  for (const char *mode : {"crashes", "exits"}) {
    fake(mode);
    call();
    EXPECT_EQ(reply.code, worker_died);
  }
  use("/bin/true");
  EXPECT_EQ(thrown(), Status::backend_missing);
  worker.reset();
  sigaction(SIGCHLD, &old, nullptr);
}

TEST_F(WorkerTest, ThreeThousandOpenDescriptors) {
  rlimit old, wide;
  ::getrlimit(RLIMIT_NOFILE, &old);
  wide = old;
  wide.rlim_cur = std::min<rlim_t>(old.rlim_max, 4000);
  ::setrlimit(RLIMIT_NOFILE, &wide);
  std::vector<int> opened;
  while (opened.size() < 3000) {
    const int descriptor = ::open("/dev/null", O_RDONLY);
    if (descriptor < 0) break;
    opened.push_back(descriptor);
  }
  const bool has_all = opened.size() == 3000;
  use(TETLOD_REMESH);
  const bool good = has_all && works();
  for (const int descriptor : opened) ::close(descriptor);
  ::setrlimit(RLIMIT_NOFILE, &old);
  if (!has_all) GTEST_SKIP() << "only " << opened.size() << " descriptors may be open";
  EXPECT_TRUE(good);
}

TEST_F(WorkerTest, NoDescriptorsLeft) {
  rlimit old;
  ::getrlimit(RLIMIT_NOFILE, &old);
  for (rlim_t more = 0; more < 40; more++) {
    use(TETLOD_REMESH);
    rlimit tight = old;
    tight.rlim_cur = rlim_t(descriptors) + more;
    ::setrlimit(RLIMIT_NOFILE, &tight);
    const Status status = thrown();
    ::setrlimit(RLIMIT_NOFILE, &old);
    if (status == Status::ok) {
      EXPECT_GT(more, 3u);
      return;
    }
    EXPECT_EQ(status, Status::memory) << message;
    EXPECT_NE(message.find("Too many open files"), std::string::npos) << message;
    EXPECT_TRUE(children_of(::getpid()).empty());
  }
  FAIL() << "never enough";
}

TEST_F(WorkerTest, FilesMayNotGrow) {
  use(TETLOD_REMESH);
  rlimit old;
  ::getrlimit(RLIMIT_FSIZE, &old);
  rlimit tight = old;
  tight.rlim_cur = 64;
  ::setrlimit(RLIMIT_FSIZE, &tight);
  const Status status = thrown();
  ::setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_EQ(status, Status::memory);
  EXPECT_TRUE(works());
}

TEST_F(WorkerTest, StandardDescriptorsClosed) {
  for (int keep = 0; keep < 8; keep++)
    EXPECT_TRUE(in_a_child([&] {
      for (int descriptor = 0; descriptor < 3; descriptor++)
        if (!(keep >> descriptor & 1)) ::close(descriptor);
      use(TETLOD_REMESH);
      const bool good = works() && works();
      worker.reset();
      return good;
    })) << keep;
}

/// As a daemon does, which then opens files of its own: these are neither written to nor closed.
TEST_F(WorkerTest, DescriptorsClosedBetweenCalls) {
  EXPECT_TRUE(in_a_child([&] {
    constexpr int count = 64;
    use(TETLOD_REMESH);
    if (!works()) return false;
    for (int descriptor = 3; descriptor < count; descriptor++) ::close(descriptor);
    std::vector<int> opened;
    while (opened.empty() || opened.back() < count) {
      opened.push_back(::memfd_create("host", 0));
      if (::write(opened.back(), "host", 4) != 4) return false;
    }
    const bool good = works() && works();
    worker.reset();
    return good && std::all_of(opened.begin(), opened.end(), [](int descriptor) {
             struct stat status;
             return ::fstat(descriptor, &status) == 0 && status.st_size == 4;
           });
  }));
}

/// Whose handles have the numbers that those of the workers had.
TEST_F(WorkerTest, ChildrenOfTheHostAreLeftAlone) {
  for (const bool by_a_call : {false, true})
    EXPECT_TRUE(in_a_child([&] {
      use(TETLOD_REMESH);
      if (!works()) return false;
      for (int descriptor = 3; descriptor < 64; descriptor++) ::close(descriptor);
      const pid_t child = ::fork();
      if (child == 0) {
        ::pause();
        ::_exit(0);
      }
      for (int i = 0; i < 64; i++) ::syscall(SYS_pidfd_open, child, 0);
      const bool good = !by_a_call || works();
      worker.reset();
      const bool lives = ::waitpid(child, nullptr, WNOHANG) == 0;
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
      return good && lives;
    }));
}

/// Which may be of the same anonymous file.
TEST_F(WorkerTest, EventsOfTheHostAreLeftAlone) {
  EXPECT_TRUE(in_a_child([&] {
    use(TETLOD_REMESH);
    if (!works()) return false;
    for (int descriptor = 3; descriptor < 64; descriptor++) ::close(descriptor);
    std::vector<int> opened;
    while (opened.empty() || opened.back() < 64) opened.push_back(::eventfd(7, EFD_NONBLOCK));
    const bool good = works() && works();
    worker.reset();
    return good && std::all_of(opened.begin(), opened.end(), [](int descriptor) {
             eventfd_t count = 0;
             return ::eventfd_read(descriptor, &count) == 0 && count == 7;
           });
  }));
}

TEST_F(WorkerTest, ForkedHost) {
  use(TETLOD_REMESH);
  ASSERT_TRUE(works());
  EXPECT_TRUE(in_a_child([&] { return works() && children_of(::getpid()).size() == 1; })) << "used";
  EXPECT_TRUE(in_a_child([&] {
    worker.reset();
    return true;
  })) << "destroyed unused";
  ASSERT_EQ(children_of(::getpid()).size(), 1u) << "the parent's is alive";
  EXPECT_TRUE(works());
}

/// Each file in memory that is shared with a worker, by its number among all files, with its bytes.
std::map<ino_t, off_t> shared_files() {
  std::map<ino_t, off_t> files;
  for (const auto &entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code gone;
    struct stat status;
    if (std::filesystem::read_symlink(entry, gone).native().rfind("/memfd:tetlod-", 0) == 0 &&
        ::stat(entry.path().c_str(), &status) == 0)
      files[status.st_ino] = status.st_size;
  }
  return files;
}

TEST_F(WorkerTest, FilesAreEmptyAfterACallThatFailed) {
  fake("crashes");
  call();
  EXPECT_EQ(reply.code, worker_died);
  const std::map<ino_t, off_t> files = shared_files();
  EXPECT_EQ(files.size(), 2u);
  for (const auto &[file, bytes] : files) EXPECT_EQ(bytes, 0);
}

/// No process is left whose child the host could not be, but files are.
TEST_F(WorkerTest, ForkedHostHasFilesOfItsOwnAfterACallThatFailed) {
  fake("crashes");
  call();
  const std::map<ino_t, off_t> parents = shared_files();
  EXPECT_TRUE(in_a_child([&] {
    call();
    const std::map<ino_t, off_t> own = shared_files();
    return own.size() == 2 &&
           std::none_of(own.begin(), own.end(), [&](const auto &file) { return parents.count(file.first); });
  }));
}

TEST_F(WorkerTest, EndsWithTheThreadThatStartedItOnlyIfTheHostDoes) {
  use(TETLOD_REMESH);
  std::thread([&] { EXPECT_TRUE(works()); }).join();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(children_of(::getpid()).size(), 1u);
  EXPECT_TRUE(works());
}

/// A host of our own that calls the worker with a request of seconds, or is idle, and is killed; the worker has to go.
void expect_worker_ends_with_host(bool busy, bool socket_kept_by_fork) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t host = ::fork();
  if (host == 0) {
    Memory memory;
    const Parallel parallel(1);
    Job job(memory, parallel);
    Worker worker(TETLOD_REMESH);
    RemeshResult result(memory);
    const Surface surface = sphere(memory, 3);
    remesh(surface, Array<Vec3>(&memory), worker, job, result);
    if (socket_kept_by_fork && ::fork() == 0) {
      ::sleep(3);
      ::_exit(0);
    }
    if (::write(ready[1], "", 1) != 1) ::_exit(1);
    if (!busy) ::pause();
    for (;;)
      remesh(surface, random_points(memory, 200000, 0.5, [](const Vec3 &) { return true; }), worker, job, result);
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::close(ready[0]);
  ::close(ready[1]);
  if (busy) std::this_thread::sleep_for(std::chrono::milliseconds(200));
  std::vector<pid_t> workers;
  for (const pid_t pid : children_of(host)) {
    std::ifstream name("/proc/" + std::to_string(pid) + "/comm");
    std::string comm;
    if (std::getline(name, comm) && comm == "tetlod-remesh") workers.push_back(pid);
  }
  ::kill(host, SIGKILL);
  ::waitpid(host, nullptr, 0);
  ASSERT_EQ(workers.size(), 1u);
  EXPECT_TRUE(soon(1, [&] { return has_ended(workers[0]); })) << busy << socket_kept_by_fork;
}

TEST_F(WorkerTest, EndsWithAKilledHost) {
  for (const bool busy : {false, true})
    for (const bool forked : {false, true}) expect_worker_ends_with_host(busy, forked);
}

/// A sphere with points inside.
struct LargeRequest {
  LargeRequest(Memory &memory, std::size_t samples)
      : surface(sphere(memory, 4)), points(surface.points.begin(), surface.points.end()) {
    const auto inside = random_points(memory, samples, 0.6, [](const Vec3 &) { return true; });
    points.insert(points.end(), inside.begin(), inside.end());
  }
  TetgenRequest like(TetgenRequest request) const {
    request.points = {points.data(), points.size()};
    request.triangles = surface.triangles;
    return request;
  }
  Surface surface;
  std::vector<Vec3> points;
};

/// TetGen's arrays on the stack want more.
TEST_F(WorkerTest, LittleStack) {
  const LargeRequest large(memory, 1000);
  EXPECT_TRUE(in_a_child([&] {
    constexpr rlim_t bytes = 160 << 10;
    const rlimit little{bytes, bytes};
    use(TETLOD_REMESH);
    if (::setrlimit(RLIMIT_STACK, &little) != 0) return false;
    tetrahedralize(*worker, large.like(tetrahedron_request()), 0, job, reply);
    return reply.code == 0 && !reply.tets.empty();
  }));
}

TEST_F(WorkerTest, MemoryLimit) {
  if (sanitized) GTEST_SKIP();
  const LargeRequest large(memory, 50000);
  const TetgenRequest request = large.like(tetrahedron_request());
  for (const std::uint64_t megabytes : {1, 8, 20, 40, 60, 80}) {
    use(TETLOD_REMESH, megabytes << 20);
    try {
      tetrahedralize(*worker, request, 0, job, reply);
      FAIL() << megabytes << " MB: code " << reply.code << ", " << reply.failure;
    } catch (const Error &error) {
      EXPECT_EQ(error.status(), Status::memory_limit) << megabytes << ": " << error.what();
    }
  }
  use(TETLOD_REMESH, std::uint64_t(1) << 30);
  tetrahedralize(*worker, request, 0, job, reply);
  EXPECT_EQ(reply.code, 0);
}

TEST_F(WorkerTest, ManyAtOnce) {
  std::vector<std::thread> threads;
  std::atomic<int> good{0};
  for (int i = 0; i < 4; i++)
    threads.emplace_back([&] {
      Memory own;
      Job own_job(own, parallel);
      for (int round = 0; round < 10; round++) {
        Worker mine(TETLOD_REMESH);
        TetgenReply answer(own);
        tetrahedralize(mine, tetrahedron_request(), 0, own_job, answer);
        good += answer.code == 0 && answer.tets.size() == 1;
      }
    });
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(good, 40);
}

}  // namespace
}  // namespace tetlod
