// The threads of a context, and what those need of oneTBB that hand them tasks.
#pragma once
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "parallel.hpp"

namespace tetlod {

struct Arena {
  explicit Arena(int threads) : tasks(threads) {}
  tbb::task_arena tasks;
};

}  // namespace tetlod
