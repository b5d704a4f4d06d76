// Large arrays' pages: blocks keep what is written to them, lie apart, are used again, and go back to the system.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

#include "../capi/failing_new.hpp"
#include "memory.hpp"
#include "page_heap.hpp"
#include "status.hpp"

namespace tetlod {
namespace {

struct Block {
  unsigned char *data;
  std::size_t bytes;
  unsigned char mark;

  bool keeps_mark() const { return data[0] == mark && std::memcmp(data, data + 1, bytes - 1) == 0; }
};

Block take(PageHeap &heap, std::size_t bytes, unsigned char mark) {
  auto *const data = static_cast<unsigned char *>(heap.take(bytes));
  if (data) std::memset(data, mark, bytes);
  return {data, bytes, mark};
}

/// Whether the system knows the page.
bool is_mapped(void *page) {
  unsigned char state;
  return ::mincore(page, 1, &state) == 0;
}

/// A thousand blocks come and go in any order.
void come_and_go(PageHeap &heap, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Block> blocks;
  for (int i = 0; i < 1000; i++) {
    if (blocks.size() < 12 && random() % 2) {
      const std::size_t bytes = PageHeap::worthwhile + random() % (random() % 10 ? 200000 : 5000000);
      blocks.push_back(take(heap, bytes, (unsigned char)(random())));
      ASSERT_NE(blocks.back().data, nullptr);
    } else if (!blocks.empty()) {
      std::swap(blocks[random() % blocks.size()], blocks.back());
      ASSERT_TRUE(blocks.back().keeps_mark());
      heap.give(blocks.back().data, blocks.back().bytes);
      blocks.pop_back();
    }
    if (i % 300 == 299) heap.give_unused_back();
  }
  for (const Block &block : blocks) {
    ASSERT_TRUE(block.keeps_mark());
    heap.give(block.data, block.bytes);
  }
}

TEST(PageHeap, BlocksKeepWhatIsWritten) {
  PageHeap heap;
  come_and_go(heap, 1);
}

TEST(PageHeap, SoTheyDoForSeveralThreads) {
  PageHeap heap;
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 4; seed++) threads.emplace_back([&heap, seed] { come_and_go(heap, seed); });
  for (std::thread &thread : threads) thread.join();
}

TEST(PageHeap, IsUsedAgain) {
  PageHeap heap;
  const Block a = take(heap, 300000, 1), b = take(heap, 500000, 2), c = take(heap, 100000, 3);
  heap.give(a.data, a.bytes);
  heap.give(b.data, b.bytes);  // with the one before it
  const Block large = take(heap, 790000, 4);
  EXPECT_EQ(large.data, a.data);
  EXPECT_TRUE(c.keeps_mark());
  heap.give(large.data, large.bytes);
  heap.give(c.data, c.bytes);
  const Block all = take(heap, 900000, 5);
  EXPECT_EQ(all.data, a.data);
  heap.give(all.data, all.bytes);
}

/// Rather than that the system clears others, while these lie idle: what was written to them is still there.
TEST(PageHeap, PagesMoveTogetherWhereNoPieceIsLargeEnough) {
  PageHeap heap;
  constexpr std::size_t mb = std::size_t(1) << 20;
  std::vector<Block> blocks;
  for (unsigned char i = 0; i < 9; i++) blocks.push_back(take(heap, 6 * mb, (unsigned char)(i + 1)));
  for (std::size_t i = 0; i < 9; i += 2) heap.give(blocks[i].data, blocks[i].bytes);
  auto *const large = static_cast<unsigned char *>(heap.take(20 * mb));
  ASSERT_NE(large, nullptr);
  std::size_t used = 0;
  for (std::size_t at = mb; at < 20 * mb; at += 2 * mb) used += large[at] % 2;  // the marks of those that were given
  EXPECT_EQ(used, 10U);
  for (std::size_t i = 1; i < 9; i += 2) {
    EXPECT_TRUE(blocks[i].keeps_mark());
    heap.give(blocks[i].data, blocks[i].bytes);
  }
  heap.give(large, 20 * mb);
}

TEST(PageHeap, GoesBackToTheSystem) {
  PageHeap heap;
  const Block a = take(heap, 3 << 20, 1), b = take(heap, 3 << 20, 2);
  heap.give(a.data, a.bytes);
  EXPECT_TRUE(is_mapped(a.data));
  heap.give_unused_back();
  EXPECT_FALSE(is_mapped(a.data));
  EXPECT_TRUE(b.keeps_mark());
  heap.give(b.data, b.bytes);
  heap.give_unused_back();
  EXPECT_FALSE(is_mapped(b.data));
  const Block c = take(heap, 1 << 20, 3);
  EXPECT_TRUE(c.keeps_mark());
  heap.give(c.data, c.bytes);
}

TEST(PageHeap, WithoutMemoryThereIsNoBlock) {
  PageHeap heap;
  EXPECT_EQ(heap.take(std::size_t(1) << 60), nullptr);
  const Block a = take(heap, 1 << 20, 1);
  ASSERT_NE(a.data, nullptr);
  heap.give(a.data, a.bytes);
}

/// What it has no memory to list.
TEST(PageHeap, GivesToTheSystem) {
  PageHeap heap;
  constexpr std::size_t huge_page = PageHeap::huge_page;
  std::vector<Block> blocks;
  for (unsigned char i = 0; i < 9; i++) blocks.push_back(take(heap, huge_page, i));
  int dropped = 0;
  for (std::size_t i = 0; i < 9; i += 2) {
    tetlod_test::fail_new_after(0);
    heap.give(blocks[i].data, huge_page);
    tetlod_test::fail_new_after(-1);
    if (!tetlod_test::new_failed()) continue;
    dropped++;
    EXPECT_FALSE(is_mapped(blocks[i].data));
  }
  EXPECT_GT(dropped, 0);
  for (std::size_t i = 1; i < 9; i += 2) {
    EXPECT_TRUE(blocks[i].keeps_mark());
    heap.give(blocks[i].data, huge_page);
  }
}

/// Takes and gives, and ends with 0; where that waits for ever, by a signal.
[[noreturn]] void use_after_fork(PageHeap &heap, const Block &before) {
  ::alarm(20);
  const bool kept = before.keeps_mark();
  const Block more = take(heap, 3 << 20, 2);
  heap.give(before.data, before.bytes);
  const bool keeps = more.data && more.keeps_mark();
  heap.give(more.data, more.bytes);
  heap.give_unused_back();
  ::_exit(kept && keeps && !is_mapped(before.data) && !is_mapped(more.data) ? 0 : 1);
}

int end_of(pid_t child) {
  int status = -1;
  return ::waitpid(child, &status, 0) == child ? status : -1;
}

/// Whose other threads were here at that time: in some of so many forks they were.
TEST(PageHeap, ServesAProcessThatWasForked) {
  PageHeap heap;
  const Block before = take(heap, 1 << 20, 1);
  std::atomic<bool> enough{false};
  std::thread other([&] {
    while (!enough) {
      const Block block = take(heap, 2 << 20, 3);
      heap.give(block.data, block.bytes);
      heap.give_unused_back();
    }
  });
  for (int i = 0; i < 100; i++) {
    const pid_t child = ::fork();
    if (child == 0) use_after_fork(heap, before);
    EXPECT_EQ(end_of(child), 0);
  }
  enough = true;
  other.join();
  heap.give(before.data, before.bytes);
}

/// Without others it is used as before: what was given is taken again.
TEST(PageHeap, IsUsedOnInAProcessThatWasForked) {
  PageHeap heap;
  const Block before = take(heap, 1 << 20, 1);
  heap.give(before.data, before.bytes);
  const pid_t child = ::fork();
  if (child == 0) ::_exit(take(heap, 1 << 20, 2).data == before.data ? 0 : 1);
  EXPECT_EQ(end_of(child), 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Of this process, in bytes.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

/// Where there is not as much as it likes to take at once.
TEST(PageHeap, IsContentWithWhatItNeeds) {
  const auto run = [] {
    constexpr std::size_t mb = std::size_t(1) << 20;
    PageHeap heap;
    if (!heap.take(512 * mb)) return 1;
    const rlimit limit{address_space() + 45 * mb, RLIM_INFINITY};
    if (::setrlimit(RLIMIT_AS, &limit) != 0) return 2;
    int blocks = 0;
    while (heap.take(10 * mb)) blocks++;
    return blocks >= 4 ? 0 : 3;
  };
  EXPECT_EXIT(::_exit(run()), testing::ExitedWithCode(0), "");
}

TEST(PageHeap, ServesTheLibrarysArrays) {
  Memory memory;
  void *begin = nullptr;
  {
    Array<double> large(1 << 20, 1.5, &memory);
    begin = large.data();
    EXPECT_EQ(memory.in_use(), sizeof(double) << 20);
  }
  EXPECT_EQ(memory.in_use(), 0u);
  EXPECT_TRUE(is_mapped(begin));
  memory.give_unused_back();
  EXPECT_FALSE(is_mapped(begin));
}
#endif

/// What another thread asks for in vain does not count, not even for a moment.
TEST(Memory, WhatIsRefusedTakesNothingFromOthers) {
  constexpr std::size_t limit = 1000;
  Memory memory({}, limit);
  std::atomic<bool> enough{false};
  std::thread other([&] {
    while (!enough) EXPECT_THROW(Array<char>(2 * limit, &memory), Error);
  });
  for (int i = 0; i < 20000; i++) EXPECT_NO_THROW(Array<char>(limit / 2, &memory));
  enough = true;
  other.join();
  EXPECT_EQ(memory.in_use(), 0u);
}

}  // namespace
}  // namespace tetlod
