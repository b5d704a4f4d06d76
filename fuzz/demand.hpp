// What ends a fuzzer: a promise of the library that does not hold.
#pragma once

namespace fuzz {

/// Prints the promise, printf-like, and aborts, so that libFuzzer keeps the input and a replay fails. Goes on where the
/// environment's TETLOD_FUZZ_KNOWN (pieces of promises, separated by |) knows it, to look for others meanwhile.
void broken(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// Prints, printf-like, what an input does, where the environment has TETLOD_FUZZ_TRACE.
void trace(const char *format, ...) __attribute__((format(printf, 1, 2)));

/// DEMAND(holds, "what was promised")
#define DEMAND(holds, ...)                     \
  do {                                         \
    if (!(holds)) ::fuzz::broken(__VA_ARGS__); \
  } while (false)

}  // namespace fuzz
