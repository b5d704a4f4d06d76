// Memory for large arrays, in the pages that the system has: huge ones, where it has them, and used again by the next
// array, since to be given a page takes longer than to fill it.
#pragma once
#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <vector>

namespace tetlod {

/// Blocks of whole pages. Thread-safe. In a process that was forked while another thread was in here, of which nothing
/// here is known then, blocks come from the system and go back to it.
class PageHeap {
 public:
  PageHeap();
  ~PageHeap();  ///< all blocks have been given back
  PageHeap(const PageHeap &) = delete;
  PageHeap &operator=(const PageHeap &) = delete;

  /// What the system clears at once, where it has huge pages.
  static constexpr std::size_t huge_page = std::size_t(1) << 21;

  /// Blocks of at least so many bytes are worth it; they lie at the begin of a page.
  static constexpr std::size_t worthwhile = std::size_t(1) << 16;

  void *take(std::size_t bytes) noexcept;  ///< null: the system has none
  void give(void *block, std::size_t bytes) noexcept;
  void give_unused_back() noexcept;  ///< to the system

 private:
  /// A piece that no block has. What tells of it lies elsewhere, as the system clears a page that is touched, while
  /// other threads wait here.
  struct Piece {
    char *begin;
    std::size_t bytes;
    char *end() const { return begin + bytes; }
  };

  std::unique_lock<std::mutex> hold() noexcept;
  char *take_piece(std::size_t bytes) noexcept;
  void add_piece(Piece piece) noexcept;
  std::size_t insert_piece(std::size_t place, Piece piece) noexcept;
  bool grow(std::size_t bytes) noexcept;
  char *map_moved(std::size_t bytes) noexcept;
  char *move_pieces(char *to, std::size_t bytes) noexcept;
  void drop_pieces() noexcept;

  std::mutex mutex_;
  std::atomic<pid_t> process_;  ///< in which `mutex_` is let go again by whoever has it
  std::vector<Piece> pieces_;   ///< by their addresses, none right behind another
};

}  // namespace tetlod
