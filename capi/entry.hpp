// What stands around every function of the C ABI: the handle is checked, the host's floating-point state is put aside,
// and every exception ends as a status and a message.
#pragma once
#include <cfenv>
#include <cstddef>
#include <utility>

#include "crew.hpp"
#include "status.hpp"
#include "tetlod.h"

namespace tetlod::capi {

/// A sentence that can be kept when there is no memory to allocate.
struct Message {
  char text[1024];

  void set(const char *sentence) noexcept;  ///< cut to the room
  std::size_t copy(char *buffer, std::size_t capacity) const noexcept;
};

/// The message of the calling thread: for calls without a context, or with one that is not theirs to write to. Its
/// address also names the thread.
Message &thread_message() noexcept;

/// Puts aside what belongs to the host's thread, for the duration of a call: errno, the floating-point state (rounding,
/// traps, flags, flush to zero), and pthread cancellation, which would unwind through us. The library computes in the
/// default state; a result must not depend on what a host has set, nor on the run whose callback it calls us in.
class HostState {
 public:
  HostState() noexcept;
  ~HostState();
  HostState(const HostState &) = delete;
  HostState &operator=(const HostState &) = delete;

 private:
  friend class InHost;
  std::fenv_t environment_;
  int errno_;
  int cancellation_ = 0;
  Loop::Apart apart_;
};

/// The scope of a callback: the host's own code runs in the host's floating-point state, and keeps what it sets there.
class InHost {
 public:
  explicit InHost(HostState &host) noexcept;
  ~InHost();
  InHost(const InHost &) = delete;
  InHost &operator=(const InHost &) = delete;

 private:
  HostState &host_;
  std::fenv_t ours_;
};

/// The calling thread's turn with a context; false inside a callback, or while another thread is at it.
class Turn {
 public:
  Turn(tetlod_context &context, HostState &host) noexcept;
  ~Turn();
  Turn(const Turn &) = delete;
  Turn &operator=(const Turn &) = delete;
  explicit operator bool() const noexcept { return taken_; }

 private:
  tetlod_context &context_;
  bool taken_;
};

/// The context, or null with a message: a null or misaligned pointer, something else, or one that was destroyed (as far
/// as freed memory shows that).
tetlod_context *checked(const tetlod_context *handle) noexcept;

/// Status and message of the exception that is being handled.
tetlod_status status_of_exception(Message &message) noexcept;
/// The same on a context, where a callback that threw is the better explanation of a cancelled run.
tetlod_status status_of_exception(tetlod_context &context) noexcept;
/// "the progress callback threw an exception: ..." for the exception that is being handled.
void note_exception(Message &message, const char *callback) noexcept;
/// The turn is not there: says so, where the calling thread may write.
tetlod_status refused(tetlod_context &context) noexcept;

/// When a call is over its threads end, and memory that it has used goes back to the system.
class AfterWork {
 public:
  explicit AfterWork(tetlod_context &context) noexcept : context_(context) {}
  ~AfterWork();
  AfterWork(const AfterWork &) = delete;
  AfterWork &operator=(const AfterWork &) = delete;

 private:
  tetlod_context &context_;
};

/// The entry of a function with a context; body(context) throws what goes wrong.
template <class Body>
tetlod_status entry(const tetlod_context *handle, Body &&body) noexcept {
  HostState host;
  tetlod_context *const context = checked(handle);
  if (!context) return TETLOD_ERR_ARGUMENT;
  const Turn turn(*context, host);
  if (!turn) return refused(*context);
  const AfterWork after(*context);
  try {
    std::forward<Body>(body)(*context);
    return TETLOD_OK;
  } catch (...) {
    return status_of_exception(*context);
  }
}

/// The entry of a function without a context; its message goes to the thread.
template <class Body>
tetlod_status entry(Body &&body) noexcept {
  const HostState host;
  try {
    std::forward<Body>(body)();
    return TETLOD_OK;
  } catch (...) {
    return status_of_exception(thread_message());
  }
}

/// Calls the host. False, with a note, when a C++ host's exception came out.
template <class Callback>
bool call_host(HostState &host, Message &note, const char *name, Callback &&callback) noexcept {
  const InHost scope(host);
  try {
    std::forward<Callback>(callback)();
    return true;
  } catch (...) {
    note_exception(note, name);
    return false;
  }
}

/// Calls the host's allocator, from any thread. Null when it threw: then there is no memory.
template <class Callback>
void *call_allocator(Callback &&callback) noexcept {
  try {
    return std::forward<Callback>(callback)();
  } catch (...) {
    return nullptr;
  }
}

}  // namespace tetlod::capi
