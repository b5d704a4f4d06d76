#include "memory.hpp"

#include <algorithm>
#include <new>

#include "status.hpp"

namespace tetlod {

namespace {

/// Sanitizers know the ends of what comes from operator new alone.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

bool takes_pages(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t least_page = 4096;
  return !sanitized && bytes >= PageHeap::worthwhile && alignment <= least_page;
}

}  // namespace

Memory::Memory(AllocatorHooks hooks, std::size_t limit) : hooks_(hooks), limit_(limit) {}

Memory::~Memory() = default;

void Memory::charge(std::size_t bytes) {
  std::size_t before = in_use_.load(std::memory_order_relaxed);
  do {  // what is refused is never counted: another thread's may fit
    if (limit_ && bytes > limit_ - std::min(limit_, before)) {
      short_ = true;
      fail(Status::memory_limit, "needs %zu bytes more with %zu in use, the limit is %zu", bytes, before, limit_);
    }
  } while (!in_use_.compare_exchange_weak(before, before + bytes, std::memory_order_relaxed));
  const std::size_t now = before + bytes;
  std::size_t peak = peak_.load(std::memory_order_relaxed);
  while (now > peak && !peak_.compare_exchange_weak(peak, now, std::memory_order_relaxed)) {
  }
}

void Memory::discharge(std::size_t bytes) noexcept { in_use_.fetch_sub(bytes, std::memory_order_relaxed); }

void *Memory::do_allocate(std::size_t bytes, std::size_t alignment) {
  charge(bytes);
  void *const pointer = take(bytes, alignment);
  if (!pointer) {
    discharge(bytes);
    short_ = true;
    fail(Status::memory, "no memory for %zu bytes with %zu in use", bytes, in_use());
  }
  return pointer;
}

void Memory::do_deallocate(void *pointer, std::size_t bytes, std::size_t alignment) {
  give(pointer, bytes, alignment);
  discharge(bytes);
}

void *Memory::take(std::size_t bytes, std::size_t alignment) {
  if (hooks_.allocate) return hooks_.allocate(hooks_.user, bytes, alignment);
  if (takes_pages(bytes, alignment)) return pages_.take(bytes);
  return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
}

void Memory::give(void *pointer, std::size_t bytes, std::size_t alignment) {
  if (hooks_.allocate) return hooks_.release(hooks_.user, pointer, bytes, alignment);
  if (takes_pages(bytes, alignment)) return pages_.give(pointer, bytes);
  ::operator delete(pointer, std::align_val_t(alignment));
}

bool Memory::do_is_equal(const std::pmr::memory_resource &other) const noexcept { return this == &other; }

}  // namespace tetlod
