// The threads of a context, and what those need of oneTBB that hand them tasks.
#pragma once
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "parallel.hpp"

namespace tetlod {

struct Arena {
  /// Throws where the system has no memory, or not so many threads.
  explicit Arena(int threads);
  tbb::task_arena tasks;
};

}  // namespace tetlod
