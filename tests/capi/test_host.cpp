// What belongs to the host stays as it is: floating-point state, errno, output, signals, files, processes; and its
// callbacks may do what a host's code does.
#include <dirent.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cfenv>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <stdexcept>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

/// A state of the floating-point unit that no library expects; the former comes back at the end.
class HostileFloatingPoint {
 public:
  HostileFloatingPoint() {
    std::fegetenv(&former_);
    std::feraiseexcept(FE_UNDERFLOW);
    std::fesetround(FE_UPWARD);
    feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, denormals are zero
#endif
  }
  ~HostileFloatingPoint() { std::fesetenv(&former_); }

 private:
  std::fenv_t former_;
};

struct FloatingPoint {
  int rounding = std::fegetround();
  int traps = fegetexcept();
  int flags = std::fetestexcept(FE_ALL_EXCEPT & ~FE_INEXACT);
#if defined(__SSE__)
  unsigned control = _mm_getcsr() & ~0x20u;  // but for the inexact flag, which the test's own code may set
#else
  unsigned control = 0;
#endif
  bool operator==(const FloatingPoint &other) const {
    return rounding == other.rounding && traps == other.traps && flags == other.flags && control == other.control;
  }
};

struct Witness {
  FloatingPoint wanted;
  int calls = 0, wrong = 0;
  static std::int32_t progress(void *user, std::int32_t, double) {
    auto &self = *static_cast<Witness *>(user);
    self.calls++;
    if (!(FloatingPoint() == self.wanted)) self.wrong++;
    return 0;
  }
  static void log(void *user, std::int32_t, const char *) { progress(user, 0, 0); }
};

void run_in_hostile_state(const Cube &cube, int threads, std::vector<unsigned char> &bytes) {
  const HostileFloatingPoint hostile;
  const FloatingPoint before;
  Witness witness{before};
  const Context context = make_context();
  EXPECT_TRUE(FloatingPoint() == before) << "create";
  submit(context.get(), cube);
  EXPECT_TRUE(FloatingPoint() == before) << "submit";
  tetlod_set_int(context.get(), TETLOD_OPT_THREADS, threads);
  tetlod_set_progress(context.get(), Witness::progress, &witness);
  tetlod_set_log(context.get(), Witness::log, &witness, 0);
  EXPECT_EQ(tetlod_set_real(context.get(), TETLOD_OPT_RHO, 7), TETLOD_ERR_OPTION);
  EXPECT_TRUE(FloatingPoint() == before) << "a failure";
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK);
  EXPECT_TRUE(FloatingPoint() == before) << "run";
  bytes = bytes_of(context.get());
  EXPECT_TRUE(FloatingPoint() == before) << "view";
  EXPECT_GE(witness.calls, 7);
  EXPECT_EQ(witness.wrong, 0) << "callbacks run in the host's state";
}

TEST(Host, FloatingPointStateIsKeptAndDoesNotMatter) {
  const Cube cube(5);
  const auto wanted = undisturbed(cube);
  for (int threads : {1, 2}) {
    std::vector<unsigned char> bytes;
    run_in_hostile_state(cube, threads, bytes);
    EXPECT_EQ(bytes, wanted) << threads << " threads";
  }
}

std::int32_t round_downward(void *, std::int32_t, double) {
  std::fesetround(FE_DOWNWARD);
  return 0;
}

TEST(Host, WhatACallbackSetsStays) {
  const Cube cube(4);
  const auto wanted = undisturbed(cube);
  const Context context = make_context();
  submit(context.get(), cube);
  tetlod_set_progress(context.get(), round_downward, nullptr);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK);
  EXPECT_EQ(std::fegetround(), FE_DOWNWARD);
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(bytes_of(context.get()), wanted);
}

TEST(Host, ErrnoIsKept) {
  const Cube cube(3);
  const Context context = make_context();
  submit(context.get(), cube);
  errno = 1234;
  tetlod_run(context.get());
  EXPECT_EQ(errno, 1234);
  tetlod_submit_points(context.get(), nullptr);
  tetlod_fetch_counts(nullptr, nullptr, nullptr, nullptr);
  tetlod_option_bounds(-1, nullptr);
  EXPECT_EQ(errno, 1234);
  tetlod_config config = default_config();
  config.remesher = "/nonexistent";
  const Context lost = make_context(config);
  submit(lost.get(), cube);
  errno = 1234;
  EXPECT_EQ(tetlod_run(lost.get()), TETLOD_ERR_BACKEND_MISSING);
  EXPECT_EQ(errno, 1234);
}

// ---- Callbacks that throw ------------------------------------------------------------------------------------------

std::int32_t throw_boom(void *, std::int32_t, double) { throw std::runtime_error("boom"); }
std::int32_t throw_number(void *, std::int32_t, double) { throw 42; }
void log_boom(void *, std::int32_t, const char *) { throw std::runtime_error("log boom"); }

TEST(Host, ProgressThatThrowsCancels) {
  const Cube cube(3);
  const Context context = make_context();
  submit(context.get(), cube);
  tetlod_set_progress(context.get(), throw_boom, nullptr);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_CANCELLED);
  EXPECT_EQ(message_of(context.get()), "the progress callback threw an exception: boom");
  tetlod_set_progress(context.get(), throw_number, nullptr);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_CANCELLED);
  EXPECT_EQ(message_of(context.get()), "the progress callback threw an exception: no std::exception");
  tetlod_set_progress(
      context.get(), [](void *, std::int32_t, double) -> std::int32_t { return 1; }, nullptr);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_CANCELLED);
  EXPECT_EQ(message_of(context.get()), "cancelled by the progress callback") << "an exception is of its own run";
  tetlod_set_progress(context.get(), nullptr, nullptr);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK);
}

/// A program that talks, waits and is no tetlod-remesh: what it says goes to the log.
class TalkingWorker {
 public:
  explicit TalkingWorker(const char *seconds) {
    const int file = mkstemp(path_.data());
    const std::string script = std::string("#!/bin/sh\necho hello from the worker\nsleep ") + seconds + "\n";
    EXPECT_EQ(write(file, script.data(), script.size()), ssize_t(script.size()));
    EXPECT_EQ(fchmod(file, 0700), 0);
    close(file);
  }
  ~TalkingWorker() { unlink(path_.c_str()); }
  tetlod_config config() const {
    tetlod_config config = default_config();
    config.remesher = path_.c_str();
    return config;
  }

 private:
  std::string path_ = testing::TempDir() + "tetlod-talking-XXXXXX";
};

struct Heard {
  std::vector<std::pair<int, std::string>> lines;
  static void log(void *user, std::int32_t level, const char *message) {
    static_cast<Heard *>(user)->lines.emplace_back(level, message);
  }
};

TEST(Host, LogPassesLevelsFromTheLeastUp) {
  const Cube cube(3);
  const TalkingWorker worker("0");
  const Context context = make_context(worker.config());
  submit(context.get(), cube);
  Heard everything, warnings;
  tetlod_set_log(context.get(), Heard::log, &everything, 0);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_BACKEND_MISSING) << message_of(context.get());
  ASSERT_FALSE(everything.lines.empty());
  EXPECT_EQ(everything.lines[0].first, 0);
  EXPECT_NE(everything.lines[0].second.find("hello from the worker"), std::string::npos);
  tetlod_set_log(context.get(), Heard::log, &warnings, 2);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_BACKEND_MISSING);
  EXPECT_TRUE(warnings.lines.empty()) << warnings.lines[0].second;
}

TEST(Host, LogThatThrowsCancels) {
  const Cube cube(3);
  const TalkingWorker worker("20");
  const Context context = make_context(worker.config());
  submit(context.get(), cube);
  tetlod_set_log(context.get(), log_boom, nullptr, 0);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_CANCELLED);
  EXPECT_EQ(message_of(context.get()), "the log callback threw an exception: log boom");
}

// ---- Callbacks that call the library -------------------------------------------------------------------------------

void expect_refused(tetlod_context *context) {
  tetlod_array array = array_of(TETLOD_FLOAT64, 0, 3, nullptr);
  EXPECT_EQ(tetlod_run(context), TETLOD_ERR_STATE);
  EXPECT_NE(message_of(context).find("callback"), std::string::npos) << message_of(context);
  EXPECT_EQ(tetlod_set_rho(context, 0.5), TETLOD_ERR_STATE);
  EXPECT_EQ(tetlod_submit_points(context, &array), TETLOD_ERR_STATE);
  EXPECT_EQ(tetlod_clear(context), TETLOD_ERR_STATE);
  EXPECT_EQ(tetlod_fetch_counts(context, nullptr, nullptr, nullptr), TETLOD_ERR_STATE);
  EXPECT_EQ(tetlod_view_points(context, &array), TETLOD_ERR_STATE);
  EXPECT_EQ(tetlod_set_progress(context, nullptr, nullptr), TETLOD_ERR_STATE);
  tetlod_destroy(context);  // ignored: it would pull the rug from under the run
}

struct Nested {
  tetlod_context *outer;
  const Cube *cube;
  const std::vector<unsigned char> *wanted;
  int runs = 0;
  static std::int32_t progress(void *user, std::int32_t, double) {
    auto &self = *static_cast<Nested *>(user);
    expect_refused(self.outer);
    if (self.runs++ > 0) return 0;
    EXPECT_EQ(undisturbed(*self.cube), *self.wanted) << "another context, inside a callback";
    return 0;
  }
};

TEST(Host, CallbacksMayUseOtherContextsOnly) {
  const Cube cube(4);
  const auto wanted = undisturbed(cube);
  const Context context = make_context();
  submit(context.get(), cube);
  Nested nested{context.get(), &cube, &wanted};
  tetlod_set_progress(context.get(), Nested::progress, &nested);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_GE(nested.runs, 7);
  EXPECT_EQ(bytes_of(context.get()), wanted);
}

// ---- The process around us -----------------------------------------------------------------------------------------

/// Standard output and error go to a file for a while.
class Captured {
 public:
  Captured() {
    std::fflush(nullptr);
    for (int fd : {1, 2}) {
      saved_[std::size_t(fd - 1)] = dup(fd);
      dup2(fileno(file_), fd);
    }
  }
  ~Captured() {
    release();
    std::fclose(file_);
  }
  long bytes_written() {
    release();
    return long(lseek(fileno(file_), 0, SEEK_END));
  }

 private:
  void release() {
    if (saved_[0] < 0) return;
    std::fflush(nullptr);
    for (int fd : {1, 2}) {
      dup2(saved_[std::size_t(fd - 1)], fd);
      close(saved_[std::size_t(fd - 1)]);
    }
    saved_ = {-1, -1};
  }
  std::FILE *file_ = std::tmpfile();
  std::array<int, 2> saved_{-1, -1};
};

/// With more threads than there are cores: nobody may complain about that.
tetlod_status run_once(const Cube &cube, const tetlod_config &config = default_config()) {
  const Context context = make_context(config);
  submit(context.get(), cube);
  tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 100);
  return tetlod_run(context.get());
}

std::vector<tetlod_status> run_good_and_bad() {
  Cube good(4), bad_index = good, bad_value = good, flat = good;
  bad_index.corners[5] = 1 << 20;
  bad_value.values[3] = HUGE_VAL;
  for (std::size_t i = 0; i < flat.xyz.size(); i += 3) {
    flat.xyz[i] += 0.125 * flat.xyz[i + 2];
    flat.xyz[i + 1] += 0.0625 * flat.xyz[i + 2];
    flat.xyz[i + 2] = 1;
  }
  tetlod_config lost = default_config(), poor = lost;
  lost.remesher = "/dev/null";
  poor.memory_limit = 1 << 12;
  return {run_once(good), run_once(bad_index),  run_once(bad_value),
          run_once(flat), run_once(good, lost), run_once(good, poor)};
}

TEST(Host, NothingIsPrinted) {
  Captured captured;
  const auto statuses = run_good_and_bad();
  EXPECT_EQ(captured.bytes_written(), 0);
  EXPECT_EQ(statuses[0], TETLOD_OK);
  EXPECT_EQ(statuses[1], TETLOD_ERR_MESH_INDEX);
  EXPECT_EQ(statuses[2], TETLOD_ERR_MESH_NONFINITE);
  EXPECT_EQ(statuses[3], TETLOD_ERR_MESH_DEGENERATE);
  EXPECT_EQ(statuses[4], TETLOD_ERR_BACKEND_MISSING);
  EXPECT_EQ(statuses[5], TETLOD_ERR_MEMORY_LIMIT);
}

int open_files() {
  int count = 0;
  DIR *const directory = opendir("/proc/self/fd");
  while (directory && readdir(directory)) count++;
  if (directory) closedir(directory);
  return count;
}

TEST(Host, NoFilesAndProcessesAreLeft) {
  run_good_and_bad();
  const int before = open_files();
  run_good_and_bad();
  EXPECT_EQ(open_files(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

bool same_handler(int number, const struct sigaction &before) {
  struct sigaction now;
  sigaction(number, nullptr, &now);
  return now.sa_handler == before.sa_handler && now.sa_flags == before.sa_flags;
}

TEST(Host, SignalsAreLeftAlone) {
  std::vector<std::pair<int, struct sigaction>> before;
  for (int number = 1; number < NSIG; number++) {
    struct sigaction action;
    if (sigaction(number, nullptr, &action) == 0) before.emplace_back(number, action);
  }
  sigset_t mask_before, mask_after;
  pthread_sigmask(SIG_BLOCK, nullptr, &mask_before);
  run_good_and_bad();
  pthread_sigmask(SIG_BLOCK, nullptr, &mask_after);
  for (const auto &[number, action] : before) EXPECT_TRUE(same_handler(number, action)) << number;
  for (int number = 1; number < NSIG; number++)
    EXPECT_EQ(sigismember(&mask_before, number), sigismember(&mask_after, number)) << number;
}

TEST(Host, MayIgnoreItsChildren) {
  const Cube cube(3);
  const auto former = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_once(cube), TETLOD_OK);
  std::signal(SIGCHLD, former);
}

TEST(Host, ItsThreadMayBeCancelledAfterwardsAsBefore) {
  int former = 0, after = -1;
  ASSERT_EQ(pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &former), 0);
  EXPECT_EQ(run_once(Cube(2)), TETLOD_OK);
  ASSERT_EQ(pthread_setcancelstate(former, &after), 0);
  EXPECT_EQ(after, PTHREAD_CANCEL_ENABLE);
}

TEST(Host, RandomNumbersAndLocaleAreLeftAlone) {
  const Cube cube(3);
  std::srand(7);
  const int wanted = std::rand();
  std::srand(7);
  const std::string locale = std::setlocale(LC_ALL, nullptr);
  EXPECT_EQ(run_once(cube), TETLOD_OK);
  EXPECT_EQ(std::rand(), wanted);
  EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale);
}

}  // namespace
}  // namespace tetlod_test
