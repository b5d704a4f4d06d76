#include "demand.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace fuzz {

namespace {

bool is_known(const std::string &promise) {
  const char *const known = std::getenv("TETLOD_FUZZ_KNOWN");
  const std::string pieces(known ? known : "");
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end + 1) {
    end = std::min(pieces.find('|', begin), pieces.size());
    if (end > begin && promise.find(pieces.substr(begin, end - begin)) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

void broken(const char *format, ...) {
  char promise[2048];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(promise, sizeof promise, format, arguments);
  va_end(arguments);
  if (is_known(promise)) return;
  std::fprintf(stderr, "\nbroken promise: %s\n", promise);
  std::abort();
}

void trace(const char *format, ...) {
  static const bool wanted = std::getenv("TETLOD_FUZZ_TRACE") != nullptr;
  if (!wanted) return;
  va_list arguments;
  va_start(arguments, format);
  std::vfprintf(stderr, format, arguments);
  va_end(arguments);
}

}  // namespace fuzz
