// Whatever fails during a run: a status, no memory lost, the previous result still there.
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "failing_new.hpp"
#include "fixtures.hpp"

namespace tetlod_test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// A context with a result of one mesh, and nothing kept beside, about to run another.
struct Rerun {
  explicit Rerun(tetlod_config config, int cells = 2) : second(cells), context(make_context(config)) {
    submit(context.get(), first);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    kept = bytes_of(context.get());
    EXPECT_EQ(tetlod_clear(context.get()), TETLOD_OK);
    submit(context.get(), second);
  }
  Cube first{3}, second;
  Context context;
  std::vector<unsigned char> kept;
};

TEST(Faults, EveryHookedAllocation) {
  CountingAllocator allocator;
  {
    Rerun rerun(allocator.config());
    const long failures = allocator.fail_each(
        rerun.context.get(), [&] { return tetlod_run(rerun.context.get()); },
        [&](bool failed) { EXPECT_EQ(bytes_of(rerun.context.get()) == rerun.kept, failed); });
    EXPECT_GT(failures, 10);
    EXPECT_EQ(bytes_of(rerun.context.get()), undisturbed(rerun.second));
  }
  EXPECT_EQ(allocator.in_use(), 0u);
  EXPECT_EQ(allocator.mismatches(), 0);
}

struct Asked {
  std::int32_t preset;
  std::int32_t option;
  double value;

  void set(tetlod_context *context) const {
    tetlod_set_preset(context, preset);
    tetlod_set_real(context, option, value);
  }
};

/// Sizes and bounds, which collapse edges, refine, and run again where they do not hold.
TEST(Faults, EveryHookedAllocationOfSizesAndBounds) {
  for (const Asked &asked : {Asked{TETLOD_PRESET_FAST, TETLOD_OPT_TARGET_RATIO, 0.3},
                             Asked{TETLOD_PRESET_ACCURATE, TETLOD_OPT_TARGET_RATIO, 0.3},
                             Asked{TETLOD_PRESET_FAST, TETLOD_OPT_MAX_ERROR, 0.05},
                             Asked{TETLOD_PRESET_ACCURATE, TETLOD_OPT_MAX_DEVIATION, 0.01}}) {
    CountingAllocator allocator;
    {
      Rerun rerun(allocator.config(), 3);
      asked.set(rerun.context.get());
      const Context other = make_context();
      submit(other.get(), rerun.second);
      asked.set(other.get());
      ASSERT_EQ(tetlod_run(other.get()), TETLOD_OK) << message_of(other.get());
      const long failures = allocator.fail_each(
          rerun.context.get(), [&] { return tetlod_run(rerun.context.get()); },
          [&](bool failed) { EXPECT_EQ(bytes_of(rerun.context.get()) == rerun.kept, failed); }, 200);
      EXPECT_GT(failures, 10);
      EXPECT_EQ(bytes_of(rerun.context.get()), bytes_of(other.get()));
    }
    EXPECT_EQ(allocator.in_use(), 0u);
    EXPECT_EQ(allocator.mismatches(), 0);
  }
}

TEST(Faults, EveryHookedAllocationOfMeasureError) {
  CountingAllocator allocator;
  Rerun rerun(allocator.config());
  ASSERT_EQ(tetlod_run(rerun.context.get()), TETLOD_OK);
  ASSERT_EQ(tetlod_clear(rerun.context.get()), TETLOD_OK);  // of the mesh nothing is kept then
  submit(rerun.context.get(), rerun.second);
  const std::size_t before = allocator.in_use();
  tetlod_error_report report{};
  report.struct_size = sizeof report;
  report.samples_per_tet = -7;
  allocator.fail_each(
      rerun.context.get(), [&] { return tetlod_measure_error(rerun.context.get(), 2, &report); },
      [&](bool failed) {
        EXPECT_EQ(report.samples_per_tet, failed ? -7 : 2);
        EXPECT_EQ(allocator.in_use(), before);
      });
}

/// Fails the n-th operator new of this thread, for every n, until the call gets through without.
void fail_every_new(const std::function<tetlod_status()> &call, const std::function<void(long)> &after) {
  for (long n = 0; n < 100000; n++) {
    fail_new_after(n);
    const tetlod_status status = call();
    fail_new_after(-1);
    if (!new_failed()) {
      EXPECT_EQ(status, TETLOD_OK);
      return;
    }
    ASSERT_EQ(status, TETLOD_ERR_MEMORY) << "operator new " << n;
    after(n);
  }
}

TEST(Faults, EveryOperatorNewOfCreate) {
  tetlod_config config = default_config();
  config.remesher = "/a/path/that/is/too/long/for/the/buffer/inside/a/std/string/tetlod-remesh";
  tetlod_context *context = nullptr;
  fail_every_new([&] { return tetlod_create(&config, &context); },
                 [&](long n) {
                   ASSERT_EQ(context, nullptr) << n;
                   ASSERT_NE(message_of(nullptr), "") << n;
                 });
  ASSERT_NE(context, nullptr);
  tetlod_destroy(context);
}

TEST(Faults, EveryOperatorNewOfSubmit) {
  const Context context = make_context();
  const double value = 1;
  const tetlod_array array = array_of(TETLOD_FLOAT64, 1, 1, &value);
  const char *const name = "a name that is too long for the buffer inside a std::string";
  fail_every_new([&] { return tetlod_submit_scalars(context.get(), name, &array); }, [](long) {});
}

TEST(Faults, EveryOperatorNewOfRun) {
  CountingAllocator allocator;
  {
    Rerun rerun(allocator.config());
    const std::size_t before = allocator.in_use();
    fail_every_new([&] { return tetlod_run(rerun.context.get()); },
                   [&](long n) {
                     ASSERT_EQ(allocator.in_use(), before) << "operator new " << n;
                     ASSERT_EQ(bytes_of(rerun.context.get()), rerun.kept) << "operator new " << n;
                   });
    EXPECT_EQ(bytes_of(rerun.context.get()), undisturbed(rerun.second));
  }
  EXPECT_EQ(allocator.in_use(), 0u);
}

TEST(Faults, AllocatorThatThrows) {
  tetlod_config config = default_config();
  config.allocate = [](void *, std::size_t, std::size_t) -> void * { throw 42; };
  config.release = [](void *, void *, std::size_t, std::size_t) {};
  const Context context = make_context(config);
  const Cube cube(2);
  submit(context.get(), cube);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_MEMORY) << message_of(context.get());
}

TEST(Faults, MemoryLimits) {
  const Cube cube(3);
  const auto wanted = undisturbed(cube);
  double limit = 1;
  tetlod_status status = TETLOD_ERR_MEMORY_LIMIT;
  for (; status != TETLOD_OK && limit < 4e9; limit *= 1.5) {
    CountingAllocator allocator;
    tetlod_config config = allocator.config();
    config.memory_limit = std::uint64_t(limit);
    const Context context = make_context(config);
    submit(context.get(), cube);
    status = tetlod_run(context.get());
    ASSERT_LE(allocator.most(), config.memory_limit);
    if (status == TETLOD_OK) {
      EXPECT_EQ(bytes_of(context.get()), wanted);
      tetlod_run_report report{};
      report.struct_size = sizeof report;
      EXPECT_EQ(tetlod_fetch_report(context.get(), &report), TETLOD_OK);
      EXPECT_LE(report.peak_bytes, config.memory_limit);
    } else {
      ASSERT_EQ(status, TETLOD_ERR_MEMORY_LIMIT) << config.memory_limit << ": " << message_of(context.get());
      ASSERT_EQ(allocator.in_use(), 0u) << config.memory_limit;
    }
  }
  EXPECT_EQ(status, TETLOD_OK) << "not even with " << limit;
}

/// With threads.
TEST(Faults, MemoryLimitsWhereEdgesCollapse) {
  const Cube cube(8);
  for (std::int32_t preset : {TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    const auto set = [&](tetlod_context *context) {
      tetlod_set_preset(context, preset);
      tetlod_set_real(context, TETLOD_OPT_TARGET_RATIO, 0.3);
      submit(context, cube);
    };
    const Context unlimited = make_context();
    set(unlimited.get());
    ASSERT_EQ(tetlod_run(unlimited.get()), TETLOD_OK) << message_of(unlimited.get());
    for (double part : {0.5, 0.8, 1.2}) {
      CountingAllocator allocator;
      tetlod_config config = allocator.config();
      config.memory_limit = std::uint64_t(part * double(report_of(unlimited.get()).peak_bytes));
      const Context context = make_context(config);
      set(context.get());
      const tetlod_status status = tetlod_run(context.get());
      EXPECT_TRUE(status == TETLOD_OK || (part < 1 && status == TETLOD_ERR_MEMORY_LIMIT))
          << preset << ' ' << part << ": " << message_of(context.get());
      if (status == TETLOD_OK) {
        tetlod_error_report error{};
        error.struct_size = sizeof error;
        EXPECT_EQ(tetlod_measure_error(context.get(), 1, &error), TETLOD_OK) << preset << ' ' << part;
      }
      EXPECT_LE(allocator.most(), config.memory_limit) << preset << ' ' << part;
    }
  }
}

/// Cancels at the n-th call.
struct Countdown {
  long left;
  std::int32_t last_stage = -1;
  double reached = 0;
  static std::int32_t call(void *user, std::int32_t stage, double fraction) {
    Countdown &self = *static_cast<Countdown *>(user);
    EXPECT_STRNE(tetlod_stage_name(stage), "unknown");
    EXPECT_TRUE(fraction <= 1 && fraction >= (stage == self.last_stage ? self.reached : 0))
        << tetlod_stage_name(stage) << ' ' << fraction;
    self.last_stage = stage;
    self.reached = fraction;
    return self.left-- == 0;
  }
};

TEST(Faults, CancelAtEveryProgressCall) {
  CountingAllocator allocator;
  {
    Rerun rerun(allocator.config(), 6);
    const std::size_t before = allocator.in_use();
    tetlod_status status = TETLOD_ERR_CANCELLED;
    long n = 0;
    for (; status != TETLOD_OK && n < 1000; n++) {
      Countdown countdown{n};
      tetlod_set_progress(rerun.context.get(), Countdown::call, &countdown);
      status = tetlod_run(rerun.context.get());
      if (status == TETLOD_OK) break;
      ASSERT_EQ(status, TETLOD_ERR_CANCELLED) << message_of(rerun.context.get());
      ASSERT_EQ(message_of(rerun.context.get()), "cancelled by the progress callback");
      ASSERT_EQ(allocator.in_use(), before);
      ASSERT_EQ(bytes_of(rerun.context.get()), rerun.kept);
    }
    EXPECT_GE(n, 7) << "a call a stage";
    EXPECT_EQ(bytes_of(rerun.context.get()), undisturbed(rerun.second));
  }
  EXPECT_EQ(allocator.in_use(), 0u);
}

TEST(Faults, ProgressDoesNotGoBack) {
  const Cube cube{20};
  for (const std::int32_t preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE}) {
    const Context context = make_context();
    tetlod_set_preset(context.get(), preset);
    submit(context.get(), cube);
    Countdown countdown{-1};
    tetlod_set_progress(context.get(), Countdown::call, &countdown);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_LT(countdown.left, -5);
  }
}

/// A second thread that cancels when a stage is reached, while the run waits for it to have done so.
class Canceller {
 public:
  Canceller(tetlod_context *context, std::int32_t stage) : context_(context), stage_(stage) {}
  ~Canceller() {
    if (thread_.joinable()) thread_.join();
  }
  static std::int32_t progress(void *user, std::int32_t stage, double) {
    static_cast<Canceller *>(user)->reached(stage);
    return 0;
  }
  Clock::time_point when() const { return when_; }

 private:
  void reached(std::int32_t stage) {
    if (stage != stage_ || thread_.joinable()) return;
    thread_ = std::thread([this] {
      tetlod_cancel(context_);
      when_ = Clock::now();
    });
    thread_.join();
    thread_ = std::thread([] {});
  }
  tetlod_context *context_;
  std::int32_t stage_;
  std::thread thread_;
  Clock::time_point when_;
};

TEST(Faults, CancelFromAnotherThreadInEveryStage) {
  Rerun rerun(default_config(), 12);
  for (std::int32_t stage = 0; stage < 7; stage++) {
    Canceller canceller(rerun.context.get(), stage);
    tetlod_set_progress(rerun.context.get(), Canceller::progress, &canceller);
    ASSERT_EQ(tetlod_run(rerun.context.get()), TETLOD_ERR_CANCELLED) << tetlod_stage_name(stage);
    EXPECT_LT(seconds_since(canceller.when()), 0.5) << tetlod_stage_name(stage);
    ASSERT_EQ(message_of(rerun.context.get()), "cancelled by tetlod_cancel");
    ASSERT_EQ(bytes_of(rerun.context.get()), rerun.kept);
  }
  tetlod_set_progress(rerun.context.get(), nullptr, nullptr);
  tetlod_cancel(rerun.context.get());
  EXPECT_EQ(tetlod_run(rerun.context.get()), TETLOD_OK) << "cancelling between runs does nothing";
}

TEST(Faults, CancelAnyTime) {
  Rerun rerun(default_config(), 10);
  const auto wanted = undisturbed(rerun.second);
  for (int i = 0; i < 20; i++) {
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::microseconds(700 * i));
      tetlod_cancel(rerun.context.get());
    });
    const tetlod_status status = tetlod_run(rerun.context.get());
    other.join();
    if (status == TETLOD_OK)
      ASSERT_EQ(bytes_of(rerun.context.get()), wanted);
    else
      ASSERT_EQ(status, TETLOD_ERR_CANCELLED) << message_of(rerun.context.get());
  }
  ASSERT_EQ(tetlod_run(rerun.context.get()), TETLOD_OK) << message_of(rerun.context.get());
  EXPECT_EQ(bytes_of(rerun.context.get()), wanted);
}

TEST(Faults, TimeLimits) {
  Rerun rerun(default_config(), 12);
  const auto wanted = undisturbed(rerun.second);
  tetlod_status status = TETLOD_ERR_TIME_LIMIT;
  for (double limit = 1e-6; status != TETLOD_OK && limit < 100; limit *= 2) {
    ASSERT_EQ(tetlod_set_real(rerun.context.get(), TETLOD_OPT_TIME_LIMIT, limit), TETLOD_OK);
    const auto begin = Clock::now();
    status = tetlod_run(rerun.context.get());
    if (status == TETLOD_OK) break;
    EXPECT_LT(seconds_since(begin), limit + 0.5);
    ASSERT_EQ(status, TETLOD_ERR_TIME_LIMIT) << message_of(rerun.context.get());
    ASSERT_EQ(bytes_of(rerun.context.get()), rerun.kept);
  }
  EXPECT_EQ(status, TETLOD_OK);
  EXPECT_EQ(bytes_of(rerun.context.get()), wanted);
}

/// A mesh, its result, and what is heard while the error is measured.
struct Measured {
  Measured() {
    submit(context.get(), cube);
    tetlod_set_preset(context.get(), TETLOD_PRESET_FAST);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    tetlod_set_progress(context.get(), progress, this);
  }
  tetlod_status measure() {
    calls = stage = 0;
    fraction = 0;
    return tetlod_measure_error(context.get(), 30, &report);
  }
  static std::int32_t progress(void *user, std::int32_t stage, double fraction) {
    auto &self = *static_cast<Measured *>(user);
    EXPECT_TRUE(stage > self.stage || (stage == self.stage && fraction >= self.fraction)) << stage << " " << fraction;
    self.stage = stage;
    self.fraction = fraction;
    return ++self.calls == self.last;
  }
  Cube cube{12};
  Context context = make_context();
  tetlod_error_report report{sizeof report, 0, 0, 0, 0, 0, 0, 0};
  int calls = 0, last = -1;
  std::int32_t stage = 0;
  double fraction = 0;
};

TEST(Faults, MeasuringTheErrorSaysHowFarItIsAndEndsWhenAsked) {
  Measured measured;
  ASSERT_EQ(measured.measure(), TETLOD_OK) << message_of(measured.context.get());
  EXPECT_GT(measured.calls, 2);
  EXPECT_STREQ(tetlod_stage_name(measured.stage), "values");
  EXPECT_GT(measured.fraction, 0.5);
  measured.last = measured.calls / 2;
  EXPECT_EQ(measured.measure(), TETLOD_ERR_CANCELLED);
  measured.last = -1;
  ASSERT_EQ(tetlod_set_real(measured.context.get(), TETLOD_OPT_TIME_LIMIT, 1e-4), TETLOD_OK);
  EXPECT_EQ(measured.measure(), TETLOD_ERR_TIME_LIMIT);
}

}  // namespace
}  // namespace tetlod_test
