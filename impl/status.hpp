// Statuses and the one exception type of the implementation.
// The numbers are those of tetlod_status in the C ABI; capi/entry.cpp holds them equal.
#pragma once
#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace tetlod {

enum class Status : std::int32_t {
  ok = 0,
  internal = 1,
  argument = 10,
  option = 11,
  state = 12,
  struct_size = 13,
  buffer_size = 14,
  memory = 20,
  memory_limit = 21,
  cancelled = 22,
  time_limit = 23,
  mesh_empty = 30,
  mesh_index = 31,
  mesh_nonfinite = 32,
  mesh_degenerate = 33,
  mesh_nonmanifold = 34,
  mesh_intersecting = 35,
  mesh_partition = 36,
  mesh_too_large = 37,
  remesh = 40,
  backend_missing = 41,
  max_error = 42,
};

/// Every failure inside the library: what happened, and a sentence that names the index and the value.
class Error : public std::exception {
 public:
  Error(Status status, std::string message) : status_(status), message_(std::move(message)) {}
  Status status() const noexcept { return status_; }
  const char *what() const noexcept override { return message_.c_str(); }

 private:
  Status status_;
  std::string message_;
};

#if defined(__GNUC__)
#define TETLOD_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define TETLOD_PRINTF(string, first)
#endif

/// printf into a std::string. Numbers are written in the "C" way whatever the host's locale is, as long as
/// the format has no floating-point conversion; for those use number() below.
std::string text(const char *format, ...) TETLOD_PRINTF(1, 2);

/// The shortest decimal that reads back as the same double ("0.1", "1e+300", "nan"), whatever the locale.
std::string number(double value);
/// With two digits ("0.017").
std::string about(double value);

[[noreturn]] void fail(Status status, const char *format, ...) TETLOD_PRINTF(2, 3);

}  // namespace tetlod
