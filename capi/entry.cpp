#include "entry.hpp"

#include <pthread.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "context.hpp"

namespace tetlod::capi {

namespace {

// The numbers of the implementation are those of the ABI.
constexpr bool same(Status status, std::int32_t number) { return std::int32_t(status) == number; }
static_assert(same(Status::ok, TETLOD_OK) && same(Status::internal, TETLOD_ERR_INTERNAL), "");
static_assert(same(Status::argument, TETLOD_ERR_ARGUMENT) && same(Status::option, TETLOD_ERR_OPTION), "");
static_assert(same(Status::state, TETLOD_ERR_STATE) && same(Status::struct_size, TETLOD_ERR_STRUCT_SIZE), "");
static_assert(same(Status::buffer_size, TETLOD_ERR_BUFFER_SIZE) && same(Status::memory, TETLOD_ERR_MEMORY), "");
static_assert(same(Status::memory_limit, TETLOD_ERR_MEMORY_LIMIT), "");
static_assert(same(Status::cancelled, TETLOD_ERR_CANCELLED) && same(Status::time_limit, TETLOD_ERR_TIME_LIMIT), "");
static_assert(same(Status::mesh_empty, TETLOD_ERR_MESH_EMPTY) && same(Status::mesh_index, TETLOD_ERR_MESH_INDEX), "");
static_assert(same(Status::mesh_nonfinite, TETLOD_ERR_MESH_NONFINITE), "");
static_assert(same(Status::mesh_degenerate, TETLOD_ERR_MESH_DEGENERATE), "");
static_assert(same(Status::mesh_nonmanifold, TETLOD_ERR_MESH_NONMANIFOLD), "");
static_assert(same(Status::mesh_intersecting, TETLOD_ERR_MESH_INTERSECTING), "");
static_assert(same(Status::mesh_partition, TETLOD_ERR_MESH_PARTITION), "");
static_assert(same(Status::mesh_too_large, TETLOD_ERR_MESH_TOO_LARGE), "");
static_assert(same(Status::max_error, TETLOD_ERR_MAX_ERROR), "");
static_assert(same(Status::remesh, TETLOD_ERR_REMESH) && same(Status::backend_missing, TETLOD_ERR_BACKEND_MISSING), "");

void compute_in_default_state() noexcept {
  std::fesetenv(FE_DFL_ENV);
#if defined(__SSE__)
  _mm_setcsr(0x1f80);  // all masked, to nearest, no flush to zero: older C libraries leave the last one as it was
#endif
}

tetlod_status fail_with(Message &message, Status status, const char *sentence) noexcept {
  message.set(sentence);
  return tetlod_status(status);
}

}  // namespace

void Message::set(const char *sentence) noexcept {
  const std::size_t length = strnlen(sentence, sizeof text - 1);
  std::memmove(text, sentence, length);
  text[length] = 0;
}

std::size_t Message::copy(char *buffer, std::size_t capacity) const noexcept {
  const std::size_t length = std::strlen(text);
  if (!buffer || capacity == 0) return length;
  const std::size_t part = length < capacity ? length : capacity - 1;
  std::memcpy(buffer, text, part);
  buffer[part] = 0;
  return length;
}

Message &thread_message() noexcept {
  thread_local Message message;
  return message;
}

HostState::HostState() noexcept : errno_(errno) {
  pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancellation_);
  std::feholdexcept(&environment_);
  compute_in_default_state();
}

HostState::~HostState() {
  std::fesetenv(&environment_);
  pthread_setcancelstate(cancellation_, nullptr);
  errno = errno_;
}

InHost::InHost(HostState &host) noexcept : host_(host) {
  std::fegetenv(&ours_);
  std::fesetenv(&host_.environment_);
}

InHost::~InHost() {
  std::feholdexcept(&host_.environment_);
  std::fesetenv(&ours_);
}

Turn::Turn(tetlod_context &context, HostState &host) noexcept : context_(context) {
  const Message *nobody = nullptr;
  taken_ = context.caller.compare_exchange_strong(nobody, &thread_message());
  if (taken_) context.host = &host;
}

AfterWork::~AfterWork() {
  context_.parallel = Parallel();
  context_.memory.give_unused_back();
}

Turn::~Turn() {
  if (!taken_) return;
  context_.host = nullptr;
  context_.caller.store(nullptr);
}

tetlod_context *checked(const tetlod_context *handle) noexcept {
  if (!handle)
    thread_message().set("the context is NULL");
  else if (reinterpret_cast<std::uintptr_t>(handle) % alignof(tetlod_context) != 0)
    thread_message().set("the context is a misaligned pointer");
  else if (handle->magic != tetlod_context::living)
    thread_message().set("the context is not one, or was destroyed");
  else
    return const_cast<tetlod_context *>(handle);  // made by tetlod_create, which makes no constants
  return nullptr;
}

tetlod_status status_of_exception(Message &message) noexcept {
  try {
    throw;
  } catch (const Error &error) {
    return fail_with(message, error.status(), error.what());
  } catch (const std::bad_alloc &) {
    return fail_with(message, Status::memory, "operator new had no more memory");
  } catch (const std::exception &error) {
    return fail_with(message, Status::internal, error.what());
  } catch (...) {
    return fail_with(message, Status::internal, "an exception that is no std::exception");
  }
}

tetlod_status status_of_exception(tetlod_context &context) noexcept {
  const tetlod_status status = status_of_exception(context.message);
  if (status == TETLOD_ERR_CANCELLED && context.callback_failure.text[0])
    context.message.set(context.callback_failure.text);
  return status;
}

void note_exception(Message &message, const char *callback) noexcept {
  Message cause;
  cause.set("no std::exception");
  try {
    throw;
  } catch (const std::exception &error) {
    cause.set(error.what());
  } catch (...) {
  }
  const int room = int(sizeof message.text) / 2;
  std::snprintf(message.text, sizeof message.text, "the %s callback threw an exception: %.*s", callback, room,
                cause.text);
}

tetlod_status refused(tetlod_context &context) noexcept {
  if (context.caller.load() == &thread_message())
    return fail_with(context.message, Status::state, "called inside a callback of the same context");
  return fail_with(thread_message(), Status::state, "the context is in use by another thread");
}

}  // namespace tetlod::capi
