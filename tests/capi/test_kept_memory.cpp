// What is kept for later runs is the first to go where memory is short: no call fails for its sake.
#include "reuse_fixture.hpp"

namespace tetlod_test {
namespace {

/// A run that finds no memory gives back what is kept, and tries again.
TEST_F(Reuse, MemoryThatIsShort) {
  CountingAllocator allocator;
  context = make_context(allocator.config());
  set_up(context.get());
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK);
  const std::vector<unsigned char> wanted = bytes_of(context.get());
  int failures = 0;
  for (long allocation = 0; allocation < 200; allocation += 17) {
    allocator.fail_after(allocation);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << "after " << allocation << ": " << message_of(context.get());
    EXPECT_EQ(bytes_of(context.get()), wanted);
    EXPECT_EQ(report_of(context.get()).reused_tets, allocator.failed() ? 0 : tets());
    failures += allocator.failed();
    allocator.forget_failure();
  }
  EXPECT_GT(failures, 0);
  expect_fresh_bytes();
  context.reset();  // before its allocator goes
}

/// The same of a limit: what is kept of another size is no reason to fail.
TEST_F(Reuse, MemoryThatIsLimited) {
  cube = Cube(12);
  const auto run = [&](tetlod_context *of, double ratio) {
    tetlod_set_int(of, TETLOD_OPT_EFFORT, TETLOD_EFFORT_FAST);
    tetlod_set_real(of, TETLOD_OPT_TARGET_RATIO, ratio);
    submit(of, cube);
    EXPECT_EQ(tetlod_run(of), TETLOD_OK) << message_of(of);
    return report_of(of);
  };
  for (double ratio : {0.9, 0.1, 0.05}) {
    const tetlod_run_report fresh = run(make_context().get(), ratio);
    tetlod_config config = default_config();
    config.memory_limit = fresh.peak_bytes / 100 * 101;
    const Context limited = make_context(config);
    run(limited.get(), 0.02);
    EXPECT_EQ(run(limited.get(), ratio).hash, fresh.hash) << ratio;
  }
}

/// What is kept is no reason to fail, whatever of it was in use as the limit was met.
TEST_F(Reuse, ARunFitsWhereItDoesWithNothingKept) {
  cube = Cube(6);
  tetlod_config config = default_config();
  const auto run = [&](tetlod_context *of) {
    submit(of, cube);
    return tetlod_run(of);
  };
  const auto run_twice = [&](bool keeps) -> tetlod_status {
    const Context limited = make_context(config);
    tetlod_set_real(limited.get(), TETLOD_OPT_TARGET_RATIO, 0.5);
    new_values(0);
    if (run(limited.get()) != TETLOD_OK) return TETLOD_ERR_MEMORY_LIMIT;
    if (!keeps) tetlod_clear(limited.get());
    new_values(1);
    return run(limited.get());
  };
  const Context free = make_context();
  tetlod_set_real(free.get(), TETLOD_OPT_TARGET_RATIO, 0.5);
  ASSERT_EQ(run(free.get()), TETLOD_OK);
  const double peak = double(report_of(free.get()).peak_bytes);
  for (int hundredths = 84; hundredths < 110; hundredths += 4) {
    config.memory_limit = std::uint64_t(peak * hundredths / 100);
    if (run_twice(false) == TETLOD_OK) {
      EXPECT_EQ(run_twice(true), TETLOD_OK) << hundredths;
    }
  }
}

/// A call that is no run, but takes memory as one does.
struct Asked {
  const char *name;
  std::function<tetlod_status(tetlod_context *)> ask;
};

void PrintTo(const Asked &asked, std::ostream *out) { *out << asked.name; }

Asked check() {
  return {"check", [](tetlod_context *of) {
            tetlod_mesh_report report{};
            report.struct_size = sizeof report;
            return tetlod_check(of, &report);
          }};
}

Asked measure_error() {
  return {"measure_error", [](tetlod_context *of) {
            tetlod_error_report report{};
            report.struct_size = sizeof report;
            return tetlod_measure_error(of, 1, &report);
          }};
}

Asked first_stencil() {
  return {"first_stencil", [](tetlod_context *of) {
            std::vector<std::int32_t> ids(4 * std::size_t(report_of(of).points_out));
            std::vector<double> weights(ids.size());
            tetlod_array to_ids = array_of(TETLOD_INT32, ids.size() / 4, 4, ids.data());
            tetlod_array to_weights = array_of(TETLOD_FLOAT64, ids.size() / 4, 4, weights.data());
            return tetlod_fetch_stencil(of, 0, &to_ids, &to_weights);
          }};
}

class KeptMemory : public Reuse, public testing::WithParamInterface<Asked> {
 protected:
  void run() {
    set_up(context.get());
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  }
};

TEST_P(KeptMemory, GoesBeforeTheCallFails) {
  CountingAllocator allocator;
  context = make_context(allocator.config());
  run();
  allocator.fail_after(0);
  EXPECT_EQ(GetParam().ask(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_TRUE(allocator.failed());
  allocator.forget_failure();
  EXPECT_EQ(expect_fresh_bytes().reused_tets, 0) << "it has gone";
  context.reset();  // before its allocator goes
}

TEST_P(KeptMemory, StaysWhereThereIsEnough) {
  run();
  EXPECT_EQ(GetParam().ask(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_EQ(expect_fresh_bytes().reused_tets, tets());
}

INSTANTIATE_TEST_SUITE_P(Capi, KeptMemory, testing::Values(check(), measure_error(), first_stencil()),
                         [](const auto &param) { return param.param.name; });

}  // namespace
}  // namespace tetlod_test
