// Contexts side by side, threads inside one, and one context in the hands of two threads.
#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "fixtures.hpp"

namespace tetlod_test {
namespace {

TEST(Threads, EachWithAContextOfItsOwn) {
  const Cube small(4), large(7);
  const auto wanted_small = undisturbed(small), wanted_large = undisturbed(large);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; t++)
    threads.emplace_back([&, t] {
      const Context context = make_context();
      tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 1 + t % 3);
      for (int i = 0; i < 3; i++) {
        const bool odd = (t + i) % 2 != 0;
        submit(context.get(), odd ? small : large);
        if (tetlod_run(context.get()) != TETLOD_OK || bytes_of(context.get()) != (odd ? wanted_small : wanted_large))
          wrong++;
      }
    });
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

/// The host cancels a run in its callback, and goes on with another mesh there: that is no part of the run, whose other
/// thread has ended by then.
struct Meanwhile {
  tetlod_context *cancelled;
  const Cube &other;
  int left;  // calls until then
  std::vector<unsigned char> bytes;

  static std::int32_t progress(void *user, std::int32_t, double) {
    auto &self = *static_cast<Meanwhile *>(user);
    if (self.left-- != 0) return 0;
    tetlod_cancel(self.cancelled);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const Context context = make_context();
    tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 2);
    submit(context.get(), self.other);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    self.bytes = bytes_of(context.get());
    return 0;
  }
};

TEST(Threads, AnotherMeshInTheCallbackOfARunThatIsCancelled) {
  const Cube large(24), other(8);
  const auto wanted = undisturbed(other);
  for (int calls = 0; calls < 12 && !HasFailure(); calls++) {
    const Context context = make_context();
    tetlod_set_int(context.get(), TETLOD_OPT_THREADS, 2);
    tetlod_set_preset(context.get(), TETLOD_PRESET_FAST);
    submit(context.get(), large);
    Meanwhile meanwhile{context.get(), other, calls, {}};
    tetlod_set_progress(context.get(), Meanwhile::progress, &meanwhile);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_ERR_CANCELLED) << calls;
    EXPECT_EQ(meanwhile.bytes, wanted) << calls;
  }
}

/// A solver that simplifies each of its meshes at every step.
TEST(Threads, FourMeshesFiftyTimesEach) {
  std::vector<Cube> meshes;
  std::vector<std::vector<unsigned char>> wanted;
  for (int n : {3, 4, 5, 6}) {
    meshes.emplace_back(n);
    wanted.push_back(undisturbed(meshes.back()));
  }
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < meshes.size(); t++)
    threads.emplace_back([&, t] {
      const Context context = make_context();
      for (int step = 0; step < 50; step++) {
        submit(context.get(), meshes[t]);
        if (tetlod_run(context.get()) != TETLOD_OK || bytes_of(context.get()) != wanted[t]) wrong++;
      }
    });
  for (std::thread &thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

/// So large that every stage has several blocks.
TEST(Threads, TheirNumberDoesNotMatter) {
  const Cube cube(25);
  const auto wanted = undisturbed(cube);
  for (std::int64_t threads : {2, 3, 8, 0}) {
    const Context context = make_context();
    submit(context.get(), cube);
    ASSERT_EQ(tetlod_set_int(context.get(), TETLOD_OPT_THREADS, threads), TETLOD_OK);
    ASSERT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    EXPECT_EQ(bytes_of(context.get()), wanted) << threads << " threads";
    tetlod_run_report report{};
    report.struct_size = sizeof report;
    tetlod_fetch_report(context.get(), &report);
    const std::int64_t cores = std::max(1u, std::thread::hardware_concurrency());
    EXPECT_EQ(report.threads, threads ? std::min(threads, cores) : cores);
  }
}

/// Samples are taken beside the boundary's decimation; a small mesh is remeshed only where edges are to be cleaned.
TEST(Threads, TheirNumberDoesNotMatterWhereSamplesAreRemeshed) {
  const Cube cube(12);
  const auto bytes_with = [&](std::int64_t threads) {
    const Context context = make_context();
    submit(context.get(), cube);
    tetlod_set_preset(context.get(), TETLOD_PRESET_FAST);
    tetlod_set_real(context.get(), TETLOD_OPT_TARGET_RATIO, 0.2);
    tetlod_set_real(context.get(), TETLOD_OPT_CLEAN_EDGES, 1e-15);
    tetlod_set_int(context.get(), TETLOD_OPT_THREADS, threads);
    EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    return bytes_of(context.get());
  };
  const auto wanted = bytes_with(1);
  for (std::int64_t threads : {2, 2, 3, 0}) EXPECT_EQ(bytes_with(threads), wanted) << threads << " threads";
}

TEST(Threads, AContextMayMoveBetweenThem) {
  const Cube cube(4);
  Context context;
  std::thread([&] { context = make_context(); }).join();
  std::thread([&] { submit(context.get(), cube); }).join();
  std::thread([&] { EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK); }).join();
  EXPECT_EQ(bytes_of(context.get()), undisturbed(cube));
  std::thread([&] { context.reset(); }).join();
}

struct Intruder {
  tetlod_context *context;
  bool done = false;
  static std::int32_t progress(void *user, std::int32_t, double) {
    auto &self = *static_cast<Intruder *>(user);
    if (!self.done) std::thread([&] { self.intrude(); }).join();
    self.done = true;
    return 0;
  }
  void intrude() const {
    EXPECT_EQ(tetlod_run(context), TETLOD_ERR_STATE);
    EXPECT_EQ(message_of(context), "the context is in use by another thread");
    tetlod_destroy(context);
  }
};

TEST(Threads, ASecondOneInTheSameContextIsRefused) {
  const Cube cube(4);
  const Context context = make_context();
  submit(context.get(), cube);
  Intruder intruder{context.get()};
  tetlod_set_progress(context.get(), Intruder::progress, &intruder);
  EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
  EXPECT_TRUE(intruder.done);
  EXPECT_EQ(message_of(context.get()), "") << "the intruder's message went to the intruder";
}

TEST(Threads, MessagesWithoutAContextAreTheThreads) {
  EXPECT_EQ(tetlod_create(nullptr, nullptr), TETLOD_ERR_ARGUMENT);
  const std::string own = message_of(nullptr);
  EXPECT_NE(own, "");
  std::thread([] { EXPECT_EQ(message_of(nullptr), ""); }).join();
  EXPECT_EQ(message_of(nullptr), own);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose stacks are larger

/// All that a run does, on a thread of its own.
void *simplify_in_every_way(void *) {
  const Cube cube(8);
  const Context context = make_context();
  submit(context.get(), cube);
  for (int preset : {TETLOD_PRESET_PAPER, TETLOD_PRESET_FAST, TETLOD_PRESET_ACCURATE})
    for (double bound : {0.0, 0.02}) {
      tetlod_set_preset(context.get(), preset);
      tetlod_set_real(context.get(), TETLOD_OPT_MAX_ERROR, bound);
      EXPECT_EQ(tetlod_run(context.get()), TETLOD_OK) << message_of(context.get());
    }
  return nullptr;
}

/// As much as the smallest that C libraries give their threads.
TEST(Threads, OneOfLittleStackIsEnough) {
  pthread_attr_t attributes;
  pthread_t thread;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 128 << 10), 0);
  ASSERT_EQ(pthread_create(&thread, &attributes, simplify_in_every_way, nullptr), 0);
  EXPECT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

#endif

}  // namespace
}  // namespace tetlod_test
