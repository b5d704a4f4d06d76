#include "memory.hpp"

#include <new>

#include "status.hpp"

namespace tetlod {

namespace {

void *allocate_default(void *, std::size_t bytes, std::size_t alignment) {
  return ::operator new(bytes, std::align_val_t(alignment), std::nothrow);
}

void release_default(void *, void *pointer, std::size_t, std::size_t alignment) {
  ::operator delete(pointer, std::align_val_t(alignment));
}

}  // namespace

Memory::Memory(AllocatorHooks hooks, std::size_t limit) : hooks_(hooks), limit_(limit) {
  if (!hooks_.allocate) hooks_ = {allocate_default, release_default, nullptr};
}

Memory::~Memory() = default;

void Memory::charge(std::size_t bytes) {
  const std::size_t now = in_use_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  if (limit_ && now > limit_) {
    discharge(bytes);
    short_ = true;
    fail(Status::memory_limit, "needs %zu bytes more with %zu in use, the limit is %zu", bytes, now - bytes, limit_);
  }
  std::size_t peak = peak_.load(std::memory_order_relaxed);
  while (now > peak && !peak_.compare_exchange_weak(peak, now, std::memory_order_relaxed)) {
  }
}

void Memory::discharge(std::size_t bytes) noexcept { in_use_.fetch_sub(bytes, std::memory_order_relaxed); }

void *Memory::do_allocate(std::size_t bytes, std::size_t alignment) {
  charge(bytes);
  void *pointer = hooks_.allocate(hooks_.user, bytes, alignment);
  if (!pointer) {
    discharge(bytes);
    short_ = true;
    fail(Status::memory, "no memory for %zu bytes with %zu in use", bytes, in_use());
  }
  return pointer;
}

void Memory::do_deallocate(void *pointer, std::size_t bytes, std::size_t alignment) {
  hooks_.release(hooks_.user, pointer, bytes, alignment);
  discharge(bytes);
}

bool Memory::do_is_equal(const std::pmr::memory_resource &other) const noexcept { return this == &other; }

}  // namespace tetlod
