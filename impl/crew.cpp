#include "crew.hpp"

#include <link.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "status.hpp"

namespace tetlod {

namespace {

thread_local const Loop *current = nullptr;

/// Pages that are never used take none of the memory.
constexpr std::size_t stack_bytes = std::size_t(1) << 20;

/// The system puts the thread-local variables of the host and of its libraries on each thread's stack, large ones, too.
std::size_t bytes_of_thread_locals() {
  std::size_t bytes = 0;
  const auto add = [](dl_phdr_info *module, std::size_t, void *sum) {
    for (int i = 0; i < module->dlpi_phnum; i++)
      if (const auto &part = module->dlpi_phdr[i]; part.p_type == PT_TLS)
        *static_cast<std::size_t *>(sum) += part.p_memsz + part.p_align;
    return 0;
  };
  ::dl_iterate_phdr(add, &bytes);
  return bytes;
}

/// What waits looks so many times before it sleeps: to be woken takes longer than most of what happens between loops.
constexpr int looks = 2000;
constexpr int looks_between_turns = 16;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

/// A thread that gets none of the host's signals, but for its own faults.
bool start(void *(*body)(void *), void *argument, pthread_t &thread) {
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return false;
  ::pthread_attr_setstacksize(&attributes, stack_bytes + bytes_of_thread_locals());
  sigset_t others, before;
  ::sigfillset(&others);
  for (int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS}) ::sigdelset(&others, fault);
  ::pthread_sigmask(SIG_SETMASK, &others, &before);
  const bool started = ::pthread_create(&thread, &attributes, body, argument) == 0;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ::pthread_attr_destroy(&attributes);
  return started;
}

}  // namespace

// ---- A loop

Loop::Loop(std::size_t blocks, OfBlock run) : blocks_(blocks), run_(run), whole_(current) {}

void Loop::take_part() {
  const Loop *const before = std::exchange(current, this);
  while (!is_cancelled()) {
    const std::size_t block = next_.fetch_add(1, std::memory_order_relaxed);
    if (block >= blocks_) break;
    try {
      run_.call(run_.body, block);
    } catch (...) {
      if (!failed_.exchange(true)) failure_ = std::current_exception();
      cancel();  // what others throw for that comes later
    }
  }
  current = before;
}

void Loop::require_done() const {
  if (failure_) std::rethrow_exception(failure_);
  if (is_cancelled()) fail(Status::cancelled, "cancelled with the work that this is part of");
}

bool Loop::has_more() const { return next_.load(std::memory_order_relaxed) < blocks_ && !is_cancelled(); }

bool Loop::is_cancelled() const {
  for (const Loop *loop = this; loop; loop = loop->whole_)
    if (loop->cancelled_.load(std::memory_order_acquire)) return true;
  return false;
}

bool Loop::current_is_cancelled() { return current && current->is_cancelled(); }

Loop::Apart::Apart() noexcept : before_(std::exchange(current, nullptr)) {}
Loop::Apart::~Apart() { current = before_; }

bool Loop::is_part_of(const Loop &other) const {
  for (const Loop *loop = this; loop; loop = loop->whole_)
    if (loop == &other) return true;
  return false;
}

// ---- A crew

Crew::Crew(int most) : process_(::getpid()), most_(std::size_t(most)) { threads_.reserve(most_); }

Crew::~Crew() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
    tell_change(most_);
  }
  for (pthread_t thread : threads_) ::pthread_join(thread, nullptr);
}

bool Crew::is_elsewhere() const { return ::getpid() != process_; }

void Crew::require_here() const {
  if (is_elsewhere()) fail(Status::state, "the host has forked in a callback, and goes on in the new process");
}

void Crew::open(Loop &loop, std::size_t helpers) {
  require_here();
  const std::lock_guard<std::mutex> lock(mutex_);
  loop.opened_before_ = std::exchange(opened_last_, &loop);
  while (threads_.size() < std::min(helpers, most_))
    if (!start_helper()) most_ = threads_.size();
  tell_change(helpers);
}

void Crew::close(Loop &loop) {
  require_here();
  std::unique_lock<std::mutex> lock(mutex_);
  unlink(loop);
  loop.closed_ = true;
  while (loop.helpers_ > 0) {
    if (Loop *const part = find_work(&loop))
      help(*part, lock);
    else
      wait_for_change(closing_, lock);
  }
}

void Crew::unlink(Loop &loop) {
  Loop **at = &opened_last_;
  while (*at != &loop) at = &(*at)->opened_before_;
  *at = loop.opened_before_;
}

bool Crew::start_helper() {
  pthread_t thread;
  if (!start(&live, this, thread)) return false;
  threads_.push_back(thread);
  return true;
}

void *Crew::live(void *crew) {
  static_cast<Crew *>(crew)->serve();
  return nullptr;
}

void Crew::serve() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!over_) {
    if (Loop *const loop = find_work(nullptr))
      help(*loop, lock);
    else
      wait_for_change(idle_, lock);
  }
}

/// The last one opened, of all or of those that are parts of one: what others wait for.
Loop *Crew::find_work(const Loop *whole) const {
  Loop *loop = opened_last_;
  while (loop && !(loop->has_more() && (!whole || loop->is_part_of(*whole)))) loop = loop->opened_before_;
  return loop;
}

void Crew::help(Loop &loop, std::unique_lock<std::mutex> &lock) {
  loop.helpers_++;
  lock.unlock();
  loop.take_part();
  lock.lock();
  if (--loop.helpers_ == 0 && loop.closed_) tell_change(0);
}

void Crew::wait_for_change(Sleepers &sleepers, std::unique_lock<std::mutex> &lock) {
  const std::uint64_t known = changes_.load(std::memory_order_relaxed);
  const auto is_known = [&] { return changes_.load(std::memory_order_relaxed) == known; };
  lock.unlock();
  for (int look = 1; look < looks && is_known(); look++) {
    if (look % looks_between_turns == 0)
      std::this_thread::yield();
    else
      relax();
  }
  lock.lock();
  sleepers.count++;
  while (is_known()) sleepers.wake.wait(lock);
  sleepers.count--;
}

/// To those that wait for the end of a loop, and to so many that have nothing to do.
void Crew::tell_change(std::size_t helpers) {
  changes_.fetch_add(1, std::memory_order_relaxed);
  if (closing_.count > 0) closing_.wake.notify_all();
  for (std::size_t i = std::min(helpers, idle_.count); i > 0; i--) idle_.wake.notify_one();
}

}  // namespace tetlod
