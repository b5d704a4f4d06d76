// Apart from its users: a compiler that sees both through inlining takes free() for a mistake.
#include "failing_new.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local long left = -1;
thread_local bool failed = false;
}  // namespace

namespace tetlod_test {

void fail_new_after(long count) {
  left = count;
  if (count >= 0) failed = false;
}

bool new_failed() { return failed; }

}  // namespace tetlod_test

void *operator new(std::size_t bytes) {
  if (left >= 0 && left-- == 0) {
    failed = true;
    throw std::bad_alloc();
  }
  if (void *const pointer = std::malloc(bytes ? bytes : 1)) return pointer;
  throw std::bad_alloc();
}

void operator delete(void *pointer) noexcept { std::free(pointer); }
void operator delete(void *pointer, std::size_t) noexcept { std::free(pointer); }
