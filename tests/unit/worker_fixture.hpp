// A worker, real or fake, and what it may not leave behind.
#pragma once
#include <dirent.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "remesh.hpp"
#include "remesh_surfaces.hpp"
#include "status.hpp"
#include "worker.hpp"

namespace tetlod::test {

using Clock = std::chrono::steady_clock;

/// By the first process, alone.
inline void tetrahedralize(Worker &worker, const TetgenRequest &request, double seconds, Job &job, TetgenReply &reply) {
  worker.begin(0, request, seconds, job);
  worker.finish_any(job, reply);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // address space cannot be limited
#else
constexpr bool sanitized = false;
#endif

inline int open_descriptors() {
  int count = 0;
  DIR *folder = ::opendir("/proc/self/fd");
  while (const dirent *entry = ::readdir(folder)) count += entry->d_name[0] != '.';
  ::closedir(folder);
  return count;
}

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct ProcessState {
  pid_t parent = 0;
  char state = 'X';  // as in /proc: R, S, T, Z; X: there is none
};

inline ProcessState state_of(pid_t pid) {
  ProcessState result;
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return result;
  std::sscanf(line.c_str() + line.rfind(')') + 1, " %c %d", &result.state, &result.parent);
  return result;
}

/// Dead or alive. One that is released (X) is seen for a moment after nobody can wait for it any more.
inline std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  DIR *folder = ::opendir("/proc");
  while (const dirent *entry = ::readdir(folder)) {
    const pid_t pid = std::atoi(entry->d_name);
    if (pid <= 0) continue;
    const ProcessState is = state_of(pid);
    if (is.parent == parent && is.state != 'X') children.push_back(pid);
  }
  ::closedir(folder);
  return children;
}

/// Runs something in a process of its own that may do to itself what it likes; true when it returned true.
inline bool in_a_child(const std::function<bool()> &body) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    bool good = false;
    try {
      good = body();
    } catch (...) {
    }
    ::_exit(good ? 0 : 1);
  }
  int status = -1;
  ::waitpid(pid, &status, 0);
  return status == 0;
}

/// Every test ends with the descriptors it began with and without children, dead or alive.
class WorkerTest : public testing::Test {
 protected:
  WorkerTest() {
    ::unsetenv("FAKE_REMESH");
    ::unsetenv("TETLOD_REMESHER");
  }
  ~WorkerTest() override {
    ::unsetenv("FAKE_REMESH");
    worker.reset();
    EXPECT_EQ(open_descriptors(), descriptors);
    EXPECT_TRUE(children_of(::getpid()).empty());
    EXPECT_EQ(memory.in_use(), tetrahedron_bytes + reply_bytes());
  }

  void use(const char *path, std::uint64_t address_space = 0) {
    worker = std::make_unique<Worker>(path, address_space);
  }
  void fake(const char *mode) {
    ::setenv("FAKE_REMESH", mode, 1);
    use(TETLOD_FAKE_REMESH);
  }

  TetgenRequest tetrahedron_request() const {
    TetgenRequest request;
    request.switches = "pYQ";
    request.points = tetrahedron.points;
    request.triangles = tetrahedron.triangles;
    return request;
  }

  void call(double seconds = 0) { tetrahedralize(*worker, tetrahedron_request(), seconds, job, reply); }
  bool works() {
    call();
    return reply.code == 0 && reply.tets.size() == 1;
  }

  /// The status that the call throws, ok for none.
  Status thrown() {
    try {
      call();
      return Status::ok;
    } catch (const Error &error) {
      message = error.what();
      return error.status();
    }
  }

  static Surface make_tetrahedron(Memory &memory) {
    Surface surface(memory);
    surface.points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, &memory};
    for (const auto &face : tet_face) surface.triangles.push_back({face[0], face[1], face[2]});
    return surface;
  }
  std::size_t reply_bytes() const {
    return reply.points.capacity() * sizeof(Vec3) + reply.tets.capacity() * sizeof(Tet) +
           reply.regions.capacity() * sizeof(std::int32_t);
  }

  int descriptors = open_descriptors();
  Memory memory;
  Parallel parallel{1};
  Job job{memory, parallel};
  Surface tetrahedron = make_tetrahedron(memory);
  std::size_t tetrahedron_bytes = memory.in_use();
  TetgenReply reply{memory};
  std::unique_ptr<Worker> worker;
  std::string message;
};

}  // namespace tetlod::test
