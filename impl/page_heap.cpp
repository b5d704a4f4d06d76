#include "page_heap.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <new>

namespace tetlod {

namespace {

constexpr std::size_t huge_page = PageHeap::huge_page;

std::size_t round_up(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

std::size_t whole_pages(std::size_t bytes) {
  static const auto page = std::size_t(::sysconf(_SC_PAGESIZE));
  return round_up(bytes, page);
}

char *map(std::size_t bytes) {
  void *const begin = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return begin == MAP_FAILED ? nullptr : static_cast<char *>(begin);
}

void unmap(char *begin, std::size_t bytes) {
  if (bytes > 0) ::munmap(begin, bytes);
}

std::size_t bytes_in_huge_page(const char *place) { return reinterpret_cast<std::uintptr_t>(place) % huge_page; }
std::size_t bytes_to_huge_page(const char *place) { return (huge_page - bytes_in_huge_page(place)) % huge_page; }

/// Whole huge pages, which the system is asked for.
char *map_huge(std::size_t bytes) {
  char *const begin = map(bytes + huge_page);
  if (!begin) return nullptr;
  const std::size_t before =
      round_up(reinterpret_cast<std::uintptr_t>(begin), huge_page) - reinterpret_cast<std::uintptr_t>(begin);
  unmap(begin, before);
  unmap(begin + before + bytes, huge_page - before);
  ::madvise(begin + before, bytes, MADV_HUGEPAGE);  // where there are none, small ones do
  return begin + before;
}

/// What is mapped at `to` goes.
bool move_huge_page(char *from, char *to) {
  return ::mremap(from, huge_page, huge_page, MREMAP_MAYMOVE | MREMAP_FIXED, to) != MAP_FAILED;
}

}  // namespace

PageHeap::PageHeap() : process_(::getpid()) {}

PageHeap::~PageHeap() { give_unused_back(); }

/// Not locked: in this process nobody lets it go.
std::unique_lock<std::mutex> PageHeap::hold() noexcept {
  const pid_t here = ::getpid();
  std::unique_lock lock(mutex_, std::defer_lock);
  if (process_ == here)
    lock.lock();
  else if (lock.try_lock())
    process_ = here;
  return lock;
}

void *PageHeap::take(std::size_t bytes) noexcept {
  bytes = whole_pages(bytes);
  const std::unique_lock lock = hold();
  if (!lock) return map(bytes);
  char *block = take_piece(bytes);
  if (!block && grow(bytes)) block = take_piece(bytes);
  return block;
}

void PageHeap::give(void *block, std::size_t bytes) noexcept {
  const Piece piece{static_cast<char *>(block), whole_pages(bytes)};
  const std::unique_lock lock = hold();
  if (lock)
    add_piece(piece);
  else
    unmap(piece.begin, piece.bytes);
}

void PageHeap::give_unused_back() noexcept {
  const std::unique_lock lock = hold();
  if (lock) drop_pieces();
}

void PageHeap::drop_pieces() noexcept {
  for (const Piece &piece : pieces_) unmap(piece.begin, piece.bytes);
  pieces_.clear();
}

/// From the first one that is large enough: low addresses have been used before.
char *PageHeap::take_piece(std::size_t bytes) noexcept {
  const auto piece =
      std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece &some) { return some.bytes >= bytes; });
  if (piece == pieces_.end()) return nullptr;
  char *const begin = piece->begin;
  *piece = {begin + bytes, piece->bytes - bytes};
  if (piece->bytes == 0) pieces_.erase(piece);
  return begin;
}

/// Becomes one with those before and behind it.
void PageHeap::add_piece(Piece piece) noexcept {
  const auto is_before = [&](const Piece &some) { return some.begin < piece.begin; };
  auto first = std::partition_point(pieces_.begin(), pieces_.end(), is_before), last = first;
  if (first != pieces_.begin() && std::prev(first)->end() == piece.begin) {
    --first;
    piece = {first->begin, first->bytes + piece.bytes};
  }
  if (last != pieces_.end() && piece.end() == last->begin) {
    piece.bytes += last->bytes;
    ++last;
  }
  const auto place = std::size_t(first - pieces_.begin());
  pieces_.erase(first, last);
  insert_piece(place, piece);
}

/// Returns how many are inserted: an empty one is not, and where there is no memory to tell of it, it goes.
std::size_t PageHeap::insert_piece(std::size_t place, Piece piece) noexcept {
  if (piece.bytes == 0) return 0;
  try {
    pieces_.insert(pieces_.begin() + std::ptrdiff_t(place), piece);
    return 1;
  } catch (const std::bad_alloc &) {
    unmap(piece.begin, piece.bytes);
    return 0;
  }
}

/// Whole huge pages: those of pieces first. Null: the system refuses to map or to move; some are gone then.
char *PageHeap::map_moved(std::size_t bytes) noexcept {
  char *const begin = map_huge(bytes);
  char *const hole = begin ? move_pieces(begin, bytes) : nullptr;
  if (!hole) return begin;
  unmap(begin, std::size_t(hole - begin));
  unmap(hole + huge_page, bytes - std::size_t(hole + huge_page - begin));
  return nullptr;
}

bool PageHeap::grow(std::size_t bytes) noexcept {
  std::size_t size = round_up(bytes, huge_page);
  char *begin = map_moved(size);
  if (!begin) {
    drop_pieces();
    begin = map_huge(size);
  }
  if (!begin) begin = map(size = bytes);
  if (!begin) return false;
  add_piece({begin, size});
  return true;
}

/// The whole huge pages of pieces, which are all too small, come to lie from `to` on, so many bytes at most: the system
/// need not clear others. Returns the place to which it lets none move, where nothing may be mapped then; else null.
char *PageHeap::move_pieces(char *to, std::size_t bytes) noexcept {
  for (std::size_t i = 0; i < pieces_.size() && bytes > 0;) {
    const Piece piece = pieces_[i];
    char *const first = piece.begin + bytes_to_huge_page(piece.begin);
    char *const last = piece.end() - bytes_in_huge_page(piece.end());
    if (first >= last) {
      i++;
      continue;
    }
    char *at = first;
    while (at < last && bytes > 0 && move_huge_page(at, to)) {
      at += huge_page;
      to += huge_page;
      bytes -= huge_page;
    }
    pieces_.erase(pieces_.begin() + std::ptrdiff_t(i));
    i += insert_piece(i, {piece.begin, std::size_t(first - piece.begin)});
    i += insert_piece(i, {at, std::size_t(piece.end() - at)});
    if (at < last && bytes > 0) return to;
  }
  return nullptr;
}

}  // namespace tetlod
