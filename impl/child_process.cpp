#include "child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "remesh_protocol.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

constexpr int wait_by_pidfd = 3;  // P_PIDFD, which older headers lack

std::string error_text(int error) {
  const char *description = ::strerrordesc_np(error);  // strerror is neither thread-safe nor free of the locale
  return description ? description : text("error %d", error);
}

[[noreturn]] void fail_for_want_of(const char *what, int error) {
  fail(Status::memory, "cannot make %s for the remeshing process: %s", what, error_text(error).c_str());
}

/// A copy above the numbers that the child's will have, so that no dup2 overwrites the source of another (the host
/// may have closed 0, 1 and 2, and then gets these first).
Descriptor lifted(const Descriptor &low, const char *what) {
  if (low.number() < 0) fail_for_want_of(what, errno);
  const int high = ::fcntl(low.number(), F_DUPFD_CLOEXEC, 2 * protocol::first_free_descriptor);
  if (high < 0) fail_for_want_of(what, errno == EINVAL ? EMFILE : errno);  // fewer numbers than that are allowed
  return Descriptor(high);
}

struct Pair {
  Descriptor host, child;
};

Pair lifted_pair(const int (&ends)[2], const char *what) {
  const Descriptor first(ends[0]), second(ends[1]);
  return {lifted(first, what), lifted(second, what)};
}

Pair socket_pair() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) fail_for_want_of("a socket", errno);
  return lifted_pair(ends, "a socket");
}

Pair output_pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail_for_want_of("a pipe", errno);
  Pair pair = lifted_pair(ends, "a pipe");
  if (::fcntl(pair.host.number(), F_SETFL, O_NONBLOCK) != 0) fail_for_want_of("a pipe", errno);
  return pair;
}

/// What posix_spawn does in the child before it executes the program.
class FileActions {
 public:
  FileActions() { check(::posix_spawn_file_actions_init(&actions_)); }
  ~FileActions() { ::posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions &) = delete;
  FileActions &operator=(const FileActions &) = delete;
  void give(const Descriptor &source, int number) {
    check(::posix_spawn_file_actions_adddup2(&actions_, source.number(), number));
  }
  void open_nothing(int number) {
    check(::posix_spawn_file_actions_addopen(&actions_, number, "/dev/null", O_RDONLY, 0));
  }
  void close_from(int number) { check(::posix_spawn_file_actions_addclosefrom_np(&actions_, number)); }
  const posix_spawn_file_actions_t *get() const { return &actions_; }

 private:
  static void check(int error) {
    if (error) fail_for_want_of("a list of descriptors", error);
  }
  posix_spawn_file_actions_t actions_;
};

/// The child starts without the host's blocked and ignored signals.
class FreshSignals {
 public:
  FreshSignals() {
    ::posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~FreshSignals() { ::posix_spawnattr_destroy(&attributes_); }
  FreshSignals(const FreshSignals &) = delete;
  FreshSignals &operator=(const FreshSignals &) = delete;
  const posix_spawnattr_t *get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

bool is_shortage(int error) {
  return error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE || error == ENOSPC;
}

/// posix_spawn reports a missing program and a missing /dev/null alike; this one names the program.
void check_executable(const std::string &path) {
  if (::access(path.c_str(), X_OK) == 0) return;
  const int error = errno;
  throw Error(Status::backend_missing, "cannot execute " + path + ": " + error_text(error) +
                                           "; TETLOD_REMESHER or tetlod_config.remesher may name another");
}

/// The host's, but for glibc's allocator: huge pages, where the system has them, and what was freed is used again. The
/// system takes a quarter of TetGen's time to give it pages otherwise.
std::vector<char *> environment_of_child() {
  static char tunables[] =
      "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:"
      "glibc.malloc.trim_threshold=4294967296";
  const auto name = std::size_t(std::strchr(tunables, '=') + 1 - tunables);
  std::vector<char *> variables;
  for (char **variable = environ; variable && *variable; variable++)
    if (std::strncmp(*variable, tunables, name) != 0) variables.push_back(*variable);
  variables.push_back(tunables);
  variables.push_back(nullptr);
  return variables;
}

pid_t spawn(const std::string &path, const FileActions &actions) {
  const FreshSignals signals;
  const std::vector<char *> variables = environment_of_child();
  char *arguments[] = {const_cast<char *>(path.c_str()), nullptr};
  pid_t pid = -1;
  const int error = ::posix_spawn(&pid, path.c_str(), actions.get(), signals.get(), arguments, variables.data());
  if (is_shortage(error)) fail_for_want_of("room", error);
  if (error) fail(Status::backend_missing, "cannot start %s: %s", path.c_str(), error_text(error).c_str());
  return pid;
}

/// Of a pidfd; 0: it is none. Below zero: the system does not show it now, or the process has been waited for.
long pid_shown_of(int descriptor) noexcept {
  char path[64], text[1024];
  std::snprintf(path, sizeof path, "/proc/self/fdinfo/%d", descriptor);
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return -1;
  const ssize_t size = ::read(file, text, sizeof text - 1);
  ::close(file);
  text[size > 0 ? size : 0] = 0;
  const char *const line = std::strstr(text, "\nPid:");
  return line ? std::strtol(line + 5, nullptr, 10) : 0;
}

}  // namespace

Descriptor &Descriptor::operator=(Descriptor &&other) noexcept {
  if (this != &other) {
    close();
    number_ = std::exchange(other.number_, -1);
    file_ = other.file_;
  }
  return *this;
}

void Descriptor::close() noexcept {
  if (is_open()) ::close(number_);
  number_ = -1;
}

Descriptor::File Descriptor::file_of(int number) noexcept {
  struct stat status;
  if (number < 0 || ::fstat(number, &status) != 0) return {};
  return {status.st_dev, status.st_ino};
}

Descriptor shared_file(const char *name) {
  const Descriptor low(::memfd_create(name, MFD_CLOEXEC));
  return lifted(low, "shared memory");
}

bool Ending::is_kill() const { return known && by_signal && status == SIGKILL; }

std::string Ending::text() const {
  if (!known) return "an ending that the host has collected";
  if (!by_signal) return tetlod::text("exit status %d", status);
  const char *name = ::sigabbrev_np(status);
  return tetlod::text("signal %d (%s)", status, name ? name : "unknown");
}

ChildProcess::ChildProcess(const std::string &path, const Descriptor &request, const Descriptor &response)
    : owner_(::getpid()) {
  check_executable(path);
  start(path, request, response);
}

void ChildProcess::start(const std::string &path, const Descriptor &request, const Descriptor &response) {
  Pair control = socket_pair();
  Pair output = output_pipe();
  FileActions actions;
  actions.open_nothing(0);
  actions.give(output.child, 1);
  actions.give(output.child, 2);
  actions.give(control.child, protocol::control_descriptor);
  actions.give(request, protocol::request_descriptor);
  actions.give(response, protocol::response_descriptor);
  actions.close_from(protocol::first_free_descriptor);
  const pid_t pid = spawn(path, actions);

  pid_ = pid;
  control_ = std::move(control.host);
  output_ = std::move(output.host);
  // A host that ignores SIGCHLD, or waits for any child, may have reaped it by now; then there is nothing to hold.
  handle_ = Descriptor(int(::syscall(SYS_pidfd_open, pid, 0)));
  const int error = errno;
  shown_pid_ = pid_shown_of(handle_.number());
  if (handle_.number() >= 0) return;
  if (error == ESRCH) return;
  ::kill(pid, SIGKILL);
  while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (error == ENOSYS)
    fail(Status::backend_missing, "the system has no handles of processes, which Linux has from 5.4 on (remesh: 0)");
  fail_for_want_of("a process handle", error);
}

ChildProcess::~ChildProcess() {
  if (!has_handle()) handle_.forget();
  if (is_ours()) end();
}

/// Before Linux 6.9 all pidfds are one file, to which descriptors of events belong, too.
bool ChildProcess::has_handle() const noexcept {
  if (!handle_.is_open() || shown_pid_ < 0) return handle_.is_open();
  const long shown = pid_shown_of(handle_.number());
  return shown == shown_pid_ || shown < 0;
}

bool ChildProcess::is_ours() const noexcept { return owner_ == ::getpid(); }

bool ChildProcess::is_connected() const noexcept {
  return control_.is_as_it_was() && output_.is_as_it_was() && (handle_.number() < 0 || has_handle());
}

bool ChildProcess::has_ended() const noexcept {
  if (!has_handle()) return true;
  pollfd ended = {handle_.number(), POLLIN, 0};
  return ::poll(&ended, 1, 0) == 1;
}

/// Not of one that has ended: its number may be another's.
double ChildProcess::cpu_seconds() const noexcept {
  clockid_t clock;
  timespec used;
  if (has_ended() || ::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &used) != 0) return -1;
  return double(used.tv_sec) + 1e-9 * double(used.tv_nsec);
}

// Signals and waits go through the pidfd: the number of a process that the host has reaped may be another's already.
// Nor is it touched where the host has closed the pidfd, whose number may be that of one of its own; the end of the
// control socket ends it then.
Ending ChildProcess::end() noexcept {
  siginfo_t information = {};
  if (!has_handle()) {
    handle_.forget();
  } else {
    if (::syscall(SYS_pidfd_send_signal, handle_.number(), SIGKILL, nullptr, 0) != 0)
      control_.close();  // where signals are refused it ends by that
    while (::waitid(idtype_t(wait_by_pidfd), id_t(handle_.number()), &information, WEXITED) < 0 && errno == EINTR) {
    }
    handle_.close();
  }
  return {information.si_pid != 0, information.si_code != CLD_EXITED, information.si_status};
}

}  // namespace tetlod
