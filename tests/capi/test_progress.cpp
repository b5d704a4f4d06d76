// How often the host is asked.
#include <chrono>
#include <thread>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

using Clock = std::chrono::steady_clock;

/// Draws, writes or communicates when it is called.
struct SlowHost {
  Clock::time_point last = Clock::now();
  std::int32_t stage = -1;
  int calls = 0, at_once = 0;
  static std::int32_t progress(void *user, std::int32_t stage, double) {
    auto &self = *static_cast<SlowHost *>(user);
    self.at_once += stage == self.stage && Clock::now() - self.last < std::chrono::milliseconds(5);
    self.stage = stage;
    self.calls++;
    std::this_thread::sleep_for(std::chrono::milliseconds(7));
    self.last = Clock::now();
    return 0;
  }
};

TEST(Progress, ASlowCallbackIsNotCalledAgainAtOnce) {
  const Cube cube(20);
  const Context context = make_context();
  submit(context.get(), cube);
  SlowHost host;
  tetlod_set_progress(context.get(), SlowHost::progress, &host);
  ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK);
  EXPECT_GT(host.calls, 10);
  EXPECT_LT(host.at_once, 4) << "of " << host.calls << ": only where the same stage begins anew";
}

}  // namespace
}  // namespace tetlod_test
