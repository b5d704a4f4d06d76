#include "host.hpp"

#include <dirent.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <utility>

#include "demand.hpp"

namespace fuzz {

namespace {

struct Head {
  std::size_t bytes, alignment;
};

std::size_t room(std::size_t alignment) { return std::max(alignment, sizeof(Head)); }

}  // namespace

void Allocator::install(tetlod_config &config) {
  config.allocate = [](void *user, std::size_t bytes, std::size_t alignment) {
    return static_cast<Allocator *>(user)->allocate(bytes, alignment);
  };
  config.release = [](void *user, void *pointer, std::size_t bytes, std::size_t alignment) {
    static_cast<Allocator *>(user)->release(pointer, bytes, alignment);
  };
  config.allocator_user = this;
}

void Allocator::call_after(long count, std::function<void()> call) {
  call_ = std::move(call);
  until_call_ = count;
}

void Allocator::forget() {
  left_ = until_call_ = -1;
  more_ = 0;
}

void *Allocator::allocate(std::size_t bytes, std::size_t alignment) {
  DEMAND(alignment && (alignment & (alignment - 1)) == 0, "an alignment is a power of two, not %zu", alignment);
  if (until_call_ >= 0 && until_call_-- == 0) call_();
  if (left_ > 0) {
    left_--;
  } else if (left_ == 0) {
    if (more_-- <= 0) left_ = -1;
    failed_ = true;
    return nullptr;
  }
  const std::size_t head = room(alignment);
  auto *const block = static_cast<unsigned char *>(
      ::operator new(bytes + head, std::align_val_t(std::max(alignment, alignof(Head))), std::nothrow));
  if (!block) return nullptr;
  const Head asked{bytes, alignment};
  std::memcpy(block, &asked, sizeof asked);
  in_use_ += bytes;
  return block + head;
}

void Allocator::release(void *pointer, std::size_t bytes, std::size_t alignment) {
  unsigned char *const block = static_cast<unsigned char *>(pointer) - room(alignment);
  Head asked;
  std::memcpy(&asked, block, sizeof asked);
  DEMAND(asked.bytes == bytes && asked.alignment == alignment,
         "release gets what allocate got: %zu bytes at %zu, not %zu at %zu", asked.bytes, asked.alignment, bytes,
         alignment);
  in_use_ -= bytes;
  ::operator delete(block, std::align_val_t(std::max(alignment, alignof(Head))));
}

int open_files() {
  int count = 0;
  DIR *const directory = opendir("/proc/self/fd");
  while (directory && readdir(directory)) count++;
  if (directory) closedir(directory);
  return count;
}

bool has_children() {
  siginfo_t ended;
  return waitid(P_ALL, 0, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

void settle() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

void keep(const char *why, const std::uint8_t *data, std::size_t size) {
  const char *const folder = std::getenv("TETLOD_FUZZ_KEEP");
  if (!folder) return;
  std::uint64_t hash = 14695981039346656037u;
  for (std::size_t i = 0; i < size; i++) hash = (hash ^ data[i]) * 1099511628211u;
  std::ofstream file(std::string(folder) + "/" + why + "-" + std::to_string(hash), std::ios::binary);
  file.write(reinterpret_cast<const char *>(data), std::streamsize(size));
}

}  // namespace fuzz
