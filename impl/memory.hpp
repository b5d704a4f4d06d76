// Where every array of the library lives: the caller's allocator behind a std::pmr resource that counts.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory_resource>
#include <vector>

#include "page_heap.hpp"

namespace tetlod {

/// The caller's allocator (tetlod_config). Both functions may be called from several threads at once.
struct AllocatorHooks {
  void *(*allocate)(void *user, std::size_t bytes, std::size_t alignment) = nullptr;
  void (*release)(void *user, void *pointer, std::size_t bytes, std::size_t alignment) = nullptr;
  void *user = nullptr;
};

/// Counts the bytes in use and their peak, and refuses to pass `limit` (0: none) with Status::memory_limit.
/// A hook that returns null becomes Status::memory. Thread-safe.
class Memory final : public std::pmr::memory_resource {
 public:
  explicit Memory(AllocatorHooks hooks = {}, std::size_t limit = 0);
  ~Memory() override;
  Memory(const Memory &) = delete;
  Memory &operator=(const Memory &) = delete;

  std::size_t in_use() const noexcept { return in_use_.load(std::memory_order_relaxed); }
  std::size_t peak() const noexcept { return peak_.load(std::memory_order_relaxed); }
  void reset_peak() noexcept {
    peak_.store(in_use(), std::memory_order_relaxed);
    peak_before_ = 0;
  }
  /// The same for a new try of what found no memory: what goes by the peak goes by its own.
  void try_again() noexcept {
    const std::size_t of_all = peak_of_all_tries();
    reset_peak();
    peak_before_ = of_all;
  }
  std::size_t peak_of_all_tries() const noexcept { return std::max(peak_before_, peak()); }
  bool is_short() const noexcept { return short_.load(std::memory_order_relaxed); }
  /// Whether anything was refused since it was asked last.
  bool take_shortage() noexcept { return short_.exchange(false); }
  /// What was taken for arrays that are gone goes back to the system.
  void give_unused_back() noexcept { pages_.give_unused_back(); }

  /// Counts bytes that something else allocates for us (OpenMesh), so that limit and peak see them too.
  void charge(std::size_t bytes);
  void discharge(std::size_t bytes) noexcept;

 private:
  void *do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void *pointer, std::size_t bytes, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource &other) const noexcept override;

  void *take(std::size_t bytes, std::size_t alignment);
  void give(void *pointer, std::size_t bytes, std::size_t alignment);

  AllocatorHooks hooks_;  ///< without one: ours
  PageHeap pages_;
  std::size_t limit_;
  std::atomic<std::size_t> in_use_{0};
  std::atomic<std::size_t> peak_{0};
  std::size_t peak_before_ = 0;  ///< of earlier tries
  std::atomic<bool> short_{false};
};

/// A charge that ends with its scope.
class MemoryCharge {
 public:
  MemoryCharge(Memory &memory, std::size_t bytes) : memory_(memory), bytes_(bytes) { memory_.charge(bytes); }
  ~MemoryCharge() { memory_.discharge(bytes_); }
  MemoryCharge(const MemoryCharge &) = delete;
  MemoryCharge &operator=(const MemoryCharge &) = delete;

 private:
  Memory &memory_;
  std::size_t bytes_;
};

/// An array in the caller's memory, which a copy would silently leave: there is none but into an array that has one.
template <class T>
class Array : public std::pmr::vector<T> {
 public:
  using std::pmr::vector<T>::vector;
  Array(Array &&) = default;
  Array &operator=(Array &&) = default;
  Array(const Array &) = delete;
  Array &operator=(const Array &) = default;
};

}  // namespace tetlod
