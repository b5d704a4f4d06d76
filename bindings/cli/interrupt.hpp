// Ctrl-C: the first one ends the run in good order, the second one ends the process at once.
#pragma once

struct tetlod_context;

namespace cli {

// From here on SIGINT, SIGTERM and SIGHUP are remembered; what the caller has the process ignore stays ignored.
void watch_interrupts();
bool interrupted();
// Ends the process by the signal that it was asked to end by, so that a script does not go on with the next file.
void die_of_interruption();
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
