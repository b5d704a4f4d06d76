#include "status.hpp"

#include <charconv>
#include <cstdarg>
#include <cstdio>

namespace tetlod {

namespace {

std::string format_text(const char *format, std::va_list arguments) {
  char buffer[1024];  // as much as a context keeps
  const int length = std::vsnprintf(buffer, sizeof buffer, format, arguments);
  return length >= 0 ? std::string(buffer) : std::string(format);
}

}  // namespace

std::string text(const char *format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::string result = format_text(format, arguments);
  va_end(arguments);
  return result;
}

std::string number(double value) {
  if (value != value) return "nan";  // its sign says nothing
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, end.ptr);
}

std::string about(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 2);
  return std::string(buffer, end.ptr);
}

void fail(Status status, const char *format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::string message = format_text(format, arguments);
  va_end(arguments);
  throw Error(status, std::move(message));
}

}  // namespace tetlod
