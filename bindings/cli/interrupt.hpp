// Ctrl-C: the first one ends the run in good order, the second one ends the process at once.
#pragma once

struct tetlod_context;

namespace cli {

// From here on SIGINT and SIGTERM are remembered.
void watch_interrupts();
bool interrupted();
// Throws Failure once there was one.
void stop_if_interrupted();

// While it lives, an interruption also cancels what the library does with the context.
class CancelOnInterrupt {
 public:
  explicit CancelOnInterrupt(tetlod_context *context);
  ~CancelOnInterrupt();
  CancelOnInterrupt(const CancelOnInterrupt &) = delete;
  CancelOnInterrupt &operator=(const CancelOnInterrupt &) = delete;
};

}  // namespace cli
