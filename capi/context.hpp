// What a tetlod_context holds.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "entry.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "pipeline.hpp"
#include "prepared.hpp"
#include "tetlod.h"
#include "worker.hpp"

namespace tetlod::capi {

/// The host's allocator as it was given.
struct HostAllocator {
  void *(*allocate)(void *user, std::size_t bytes, std::size_t alignment) = nullptr;
  void (*release)(void *user, void *pointer, std::size_t bytes, std::size_t alignment) = nullptr;
  void *user = nullptr;

  AllocatorHooks hooks() noexcept;  ///< none when there is none; they keep a pointer to this
};

struct Log {
  tetlod_log_fn call = nullptr;
  void *user = nullptr;
  std::int32_t least = 0;
};

struct Progress {
  tetlod_progress_fn call = nullptr;
  void *user = nullptr;
};

/// A result, and what belongs to the run that made it.
struct Outcome {
  explicit Outcome(Memory &memory) : result(memory) {}
  Result result;
  Input input;      ///< as it was submitted then
  Options options;  ///< of the run
  int threads = 1;
};

}  // namespace tetlod::capi

struct tetlod_context {
  static constexpr std::uint32_t living = 0x7e71d0c7;

  explicit tetlod_context(const tetlod_config &config);
  ~tetlod_context() { magic = 0; }
  tetlod_context(const tetlod_context &) = delete;
  tetlod_context &operator=(const tetlod_context &) = delete;

  volatile std::uint32_t magic = living;  ///< volatile: the last store, before the memory goes, has to happen

  // The call that is under way.
  std::atomic<const tetlod::capi::Message *> caller{nullptr};  ///< names the thread; null: nobody
  tetlod::capi::HostState *host = nullptr;
  tetlod::capi::Message message{};
  tetlod::capi::Message callback_failure{};  ///< empty unless a callback of this run threw
  std::atomic<bool> cancel{false};           ///< a run clears it when it begins: setting it between runs does nothing

  tetlod::capi::HostAllocator allocator;
  tetlod::Memory memory;  ///< ends after everything below
  tetlod::capi::Log log;
  tetlod::capi::Progress progress;
  tetlod::Options options;
  tetlod::Input input;
  tetlod::Worker worker;
  tetlod::Parallel parallel;
  tetlod::Prepared prepared{memory};               ///< of earlier runs, for the next
  std::unique_ptr<tetlod::capi::Outcome> outcome;  ///< null before the first successful run
};

namespace tetlod::capi {

/// The last result. Throws Status::state when there is none.
const Outcome &last_outcome(const tetlod_context &context);
Outcome &last_outcome(tetlod_context &context);

}  // namespace tetlod::capi
