#include "interrupt.hpp"

#include <csignal>

#include "failure.hpp"
#include "tetlod.h"

namespace cli {
namespace {

// What a signal handler may touch.
volatile std::sig_atomic_t asked = 0;
tetlod_context *volatile running = nullptr;

void on_signal(int signal) {
  asked = signal;
  if (running != nullptr) tetlod_cancel(running);
}

}  // namespace

void watch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  for (const int signal : {SIGHUP, SIGTERM, SIGINT}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

bool interrupted() { return asked != 0; }

void die_of_interruption() {
  std::signal(asked, SIG_DFL);
  std::raise(asked);
}

void stop_if_interrupted() {
  if (interrupted()) throw Failure("interrupted");
}

CancelOnInterrupt::CancelOnInterrupt(tetlod_context *context) { running = context; }

CancelOnInterrupt::~CancelOnInterrupt() { running = nullptr; }

}  // namespace cli
