// Loops of several threads: every block once, whatever the threads are, also inside blocks and where some fail.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "parallel.hpp"
#include "status.hpp"

namespace tetlod {
namespace {

constexpr std::chrono::milliseconds a_while{20};

/// As Fortran's threadprivate arrays are: the system takes them of each thread's stack.
thread_local volatile char of_the_host[1100 * 1024];

class OfACrew : public testing::TestWithParam<int> {
 protected:
  Parallel parallel{GetParam()};

  /// How often each of so many blocks is done.
  std::vector<int> counts_of(std::size_t blocks) const {
    std::vector<std::atomic<int>> counts(blocks);
    for (auto &count : counts) count = 0;
    parallel.for_blocks(blocks, 1, [&](std::size_t b, std::size_t) { counts[b]++; });
    return {counts.begin(), counts.end()};
  }
};

TEST_P(OfACrew, EveryBlockIsDoneOnce) {
  for (std::size_t blocks : {0U, 1U, 2U, 3U, 7U, 1000U})
    for (int turn = 0; turn < 100; turn++) ASSERT_EQ(counts_of(blocks), std::vector<int>(blocks, 1));
}

TEST_P(OfACrew, LoopsInsideOfBlocks) {
  std::vector<std::vector<int>> inner(20);
  parallel.for_blocks(inner.size(), 1, [&](std::size_t b, std::size_t) { inner[b] = counts_of(50 + b); });
  for (std::size_t b = 0; b < inner.size(); b++) EXPECT_EQ(inner[b], std::vector<int>(50 + b, 1));
}

TEST_P(OfACrew, AThreadHasItsStackBesideTheHostsThreadLocals) {
  std::atomic<int> begun{0};
  parallel.for_blocks(std::size_t(GetParam()), 1, [&](std::size_t, std::size_t) {
    volatile char own[256 * 1024];
    for (std::size_t i = 0; i < sizeof own; i += 1024) own[i] = of_the_host[i] = char(i);
    begun++;
    for (int i = 0; i < 500 && begun < GetParam(); i++) std::this_thread::sleep_for(a_while);  // for ever without room
    for (std::size_t i = 0; i < sizeof own; i += 1024) EXPECT_EQ(own[i], of_the_host[i]);
  });
  EXPECT_EQ(begun, GetParam());
}

/// Each of the blocks waits for all others: there are as many threads, also after they slept.
TEST_P(OfACrew, BlocksAreDoneAtTheSameTime) {
  for (int turn = 0; turn < 3; turn++) {
    std::atomic<int> begun{0};
    parallel.for_blocks(std::size_t(GetParam()), 1, [&](std::size_t, std::size_t) {
      for (begun++; begun < GetParam();) std::this_thread::yield();
    });
    EXPECT_EQ(begun, GetParam());
    std::this_thread::sleep_for(a_while);
  }
}

/// Who has nothing left of a loop takes part in what is inside of its blocks.
TEST_P(OfACrew, WhoWaitsHelps) {
  std::set<std::thread::id> threads;
  std::mutex mutex;
  std::atomic<int> begun{0};
  const int all = std::min(GetParam(), 2);
  parallel.at_once([] {},
                   [&] {
                     parallel.for_blocks(std::size_t(all), 1, [&](std::size_t, std::size_t) {
                       for (begun++; begun < all;) std::this_thread::yield();
                       const std::lock_guard<std::mutex> lock(mutex);
                       threads.insert(std::this_thread::get_id());
                     });
                   });
  EXPECT_EQ(threads.size(), std::size_t(all));
}

/// Where there are other threads, the first block waits for what it is to end.
TEST_P(OfACrew, WhatABlockThrowsEndsTheLoopsInsideOfOthers) {
  std::atomic<int> ended{0};
  const auto fails = [&] {
    std::atomic<int> begun{0};
    parallel.for_blocks(std::size_t(GetParam()), 1, [&](std::size_t b, std::size_t) {
      begun++;
      while (b == 0 && begun < GetParam()) std::this_thread::yield();
      if (b == 0) throw std::runtime_error("the first");
      const auto goes_on = [&] {
        for (;;) counts_of(3);
      };
      EXPECT_THROW(goes_on(), Error);
      ended++;
    });
  };
  for (int turn = 0; turn < 20; turn++) EXPECT_THROW(fails(), std::runtime_error);
  EXPECT_EQ(ended, 20 * (GetParam() - 1));
  EXPECT_FALSE(parallel.is_cancelled());
  EXPECT_EQ(counts_of(9), std::vector<int>(9, 1)) << "the next loop knows nothing of it";
}

TEST_P(OfACrew, WhatIsApartIsDoneWhereTheLoopAroundItIsCancelled) {
  const bool has_others = GetParam() > 1;
  std::atomic<int> done{0};
  const auto fails = [&] {
    std::atomic<bool> begun{!has_others};
    parallel.for_blocks(2, 1, [&](std::size_t b, std::size_t) {
      while (b == 0 && !begun) std::this_thread::yield();
      if (b == 0) throw std::runtime_error("the first");
      begun = true;
      while (!parallel.is_cancelled()) std::this_thread::yield();
      EXPECT_THROW(counts_of(9), Error);
      const Loop::Apart apart;
      const Parallel other(2);
      std::atomic<int> blocks{0};
      other.for_blocks(9, 1, [&](std::size_t, std::size_t) { blocks++; });
      EXPECT_EQ(blocks, 9);
      done++;
    });
  };
  for (int turn = 0; turn < 20; turn++) EXPECT_THROW(fails(), std::runtime_error);
  EXPECT_EQ(done, has_others ? 20 : 0);
}

/// Signals are for the host's threads, but for faults.
TEST_P(OfACrew, HelpersTakeNoSignals) {
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<int> begun{0}, open{0};
  parallel.for_blocks(std::size_t(GetParam()), 1, [&](std::size_t, std::size_t) {
    for (begun++; begun < GetParam();) std::this_thread::yield();
    sigset_t blocked;
    ::pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    if (std::this_thread::get_id() != here)
      open += !::sigismember(&blocked, SIGALRM) + !::sigismember(&blocked, SIGTERM);
  });
  EXPECT_EQ(open, 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, OfACrew, testing::Values(1, 2, 3, 8));

/// The status that a process of its own ends with.
template <class Body>
int in_a_fork(const Body &body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = -1;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take all of the address space
/// Of those that are asked for there is room for some, or for none.
TEST(Crew, GoesOnWithTheThreadsThatThereAre) {
  for (rlim_t megabytes : {0U, 4U}) {
    const int status = in_a_fork([&] {
      rlimit room{};
      std::size_t pages = 0;
      FILE *const of = std::fopen("/proc/self/statm", "r");
      if (!of || std::fscanf(of, "%zu", &pages) != 1) return 2;
      std::fclose(of);
      room.rlim_cur = room.rlim_max = rlim_t(pages) * rlim_t(::sysconf(_SC_PAGESIZE)) + (megabytes << 20);
      if (::setrlimit(RLIMIT_AS, &room) != 0) return 3;
      std::atomic<std::size_t> sum{0};
      {
        const Parallel parallel(64);
        for (int turn = 0; turn < 100; turn++)
          parallel.for_blocks(1000, 1, [&](std::size_t b, std::size_t) { sum += b; });
      }
      return sum == 100 * 999 * 500 ? 0 : 4;
    });
    EXPECT_EQ(status, 0) << megabytes;
  }
}
#endif

/// Where its helpers are not: what they are at never ends, and nothing of it waits for them.
TEST(Crew, EndsInAProcessThatWasForkedInALoop) {
  const int status = in_a_fork([] {
    std::atomic<int> begun{0};
    pid_t child = -1;
    int answer = 0;
    try {
      const Parallel parallel(2);
      const std::thread::id here = std::this_thread::get_id();
      parallel.for_blocks(2, 1, [&](std::size_t, std::size_t) {
        for (begun++; begun < 2;) std::this_thread::yield();
        if (std::this_thread::get_id() == here) child = ::fork();
        if (std::this_thread::get_id() != here) std::this_thread::sleep_for(5 * a_while);
      });
    } catch (const Error &error) {
      answer = error.status() == Status::state ? 7 : 8;
    }
    if (child == 0) return answer;
    int end = -1;
    if (answer != 0 || ::waitpid(child, &end, 0) != child) return 1;
    return WIFEXITED(end) && WEXITSTATUS(end) == 7 ? 0 : 2;
  });
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace tetlod
