// SPDX-License-Identifier: AGPL-3.0-or-later
// tetlod-remesh: runs TetGen for libtetlod in a process of its own, one call after the other, until the host is gone.
#include <alloca.h>
#include <malloc.h>
#include <poll.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "channel.hpp"
#include "tetgen_call.hpp"

namespace tetlod::worker {

namespace {

constexpr int watch_interval = 100;  // milliseconds
constexpr std::size_t usual_stack = std::size_t(8) << 20;

/// Ctrl-C, the end of a terminal, and what a batch system sends to a job are for the host to answer; a full file system
/// is an error of write().
void ignore_signals() {
  for (const int signal : {SIGINT, SIGQUIT, SIGHUP, SIGTERM, SIGUSR1, SIGUSR2, SIGALRM, SIGPIPE, SIGXFSZ})
    std::signal(signal, SIG_IGN);
}

/// Ends the process with the host, also in the middle of a call. The socket tells at once; but a process that the
/// host has forked may keep its other end open, hence the question whose child we are. PR_SET_PDEATHSIG would not do:
/// it fires when the thread ends that started us.
void *watch_host(void *host) {
  const pid_t host_pid = pid_t(reinterpret_cast<std::intptr_t>(host));
  pollfd socket = {protocol::control_descriptor, 0, 0};
  while (::getppid() == host_pid && !(socket.revents & (POLLHUP | POLLERR | POLLNVAL)))
    ::poll(&socket, 1, watch_interval);
  ::_exit(0);
}

bool start_thread(void *(*run)(void *), void *argument, std::size_t stack) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  pthread_t thread;
  const int error = pthread_create(&thread, &attributes, run, argument);
  pthread_attr_destroy(&attributes);
  return error == 0;
}

bool start_watching(std::int64_t host_pid) {
  constexpr std::size_t stack = std::size_t(1) << 18;  // the address space may be scarce, what is preloaded large
  return start_thread(watch_host, reinterpret_cast<void *>(std::intptr_t(host_pid)), stack);
}

void limit(__rlimit_resource resource, std::uint64_t bytes) {
  rlimit current;
  if (::getrlimit(resource, &current) != 0) return;
  current.rlim_cur = std::min<rlim_t>(bytes, current.rlim_max);
  ::setrlimit(resource, &current);
}

/// As usual, as far as the host's limit allows; returns what it is.
std::size_t raise_stack_limit() {
  rlimit current;
  if (::getrlimit(RLIMIT_STACK, &current) != 0) return 0;
  if (current.rlim_cur < usual_stack) limit(RLIMIT_STACK, usual_stack);
  return ::getrlimit(RLIMIT_STACK, &current) == 0 ? std::size_t(current.rlim_cur) : 0;
}

/// As much stack as TetGen is likely to want: where all of the address space is used up, it could not grow any more,
/// and that would be a crash.
void grow_stack(std::size_t most) {
  constexpr std::size_t wanted = std::size_t(1) << 19;
  const std::size_t size = std::min(wanted, most / 2);
  auto *const stack = static_cast<volatile char *>(alloca(size));
  for (std::size_t i = 0; i < size; i += 1024) stack[i] = 0;
}

void limit_resources(std::uint64_t address_space) {
  limit(RLIMIT_CORE, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes
  if (address_space) limit(RLIMIT_AS, address_space);
#else
  (void)address_space;
#endif
}

void greet() {
  protocol::Hello hello;
  std::strncpy(hello.tetlod_version, TETLOD_VERSION, sizeof hello.tetlod_version - 1);
  send(&hello, sizeof hello);
}

void warn_of_inexactness() {
  if (!has_exact_predicates())
    std::printf(
        "TetGen was compiled with fused multiply-add: its predicates are not exact, and attempts fail for that\n");
}

void serve(const protocol::Call &call) {
  protocol::Reply reply = tetrahedralize(call);
  ::malloc_trim(0);
  send_reply(reply);
}

void *serve_all(void *) {
  protocol::Call call;
  while (receive_call(call)) serve(call);
  ::_exit(0);
}

/// On a stack of its own where the host's limit leaves too little for TetGen, if there is room for one.
void serve_on_enough_stack(std::size_t stack) {
  if (stack < usual_stack && start_thread(serve_all, nullptr, usual_stack))
    for (;;) ::pause();
  serve_all(nullptr);
}

/// An exception would run TetGen's destructors on structures that are half built.
void report_exhaustion() { fail(protocol::out_of_memory, "out of memory"); }

int explain() {
  std::fprintf(stderr,
               "tetlod-remesh %s (protocol %u): TetGen for libtetlod, which starts it by itself.\n"
               "Licence: AGPL-3.0-or-later.\n",
               TETLOD_VERSION, protocol::version);
  return 2;
}

}  // namespace

}  // namespace tetlod::worker

int main() {
  using namespace tetlod;
  worker::ignore_signals();
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // what TetGen prints before it fails would be lost in a buffer
  std::set_new_handler(worker::report_exhaustion);
  protocol::Start start;
  if (!worker::receive(&start, sizeof start) || start.magic != protocol::magic) return worker::explain();
  if (!worker::start_watching(start.host_pid)) return protocol::no_thread;
  const std::size_t stack = worker::raise_stack_limit();
  worker::grow_stack(stack);
  worker::limit_resources(start.address_space);
  worker::greet();
  worker::warn_of_inexactness();
  worker::serve_on_enough_stack(stack);
}
