// A child process that cannot outlive its owner's interest in it, whatever the host does with signals, forks and
// descriptors. Linux only: pidfd, memfd, SOCK_SEQPACKET.
#pragma once
#include <sys/types.h>

#include <string>
#include <utility>

namespace tetlod {

/// Owns a file descriptor. A host that becomes a daemon may close it, and then has files of its own under its number,
/// which are left alone.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) noexcept : number_(number), file_(file_of(number)) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor &&other) noexcept : number_(std::exchange(other.number_, -1)), file_(other.file_) {}
  Descriptor &operator=(Descriptor &&other) noexcept;
  int number() const noexcept { return number_; }
  bool is_open() const noexcept { return number_ >= 0 && file_of(number_) == file_; }
  /// There was none, or it is open.
  bool is_as_it_was() const noexcept { return number_ < 0 || is_open(); }
  void close() noexcept;
  void forget() noexcept { number_ = -1; }  ///< it is another's

 private:
  using File = std::pair<dev_t, ino_t>;
  static File file_of(int number) noexcept;

  int number_ = -1;
  File file_{};
};

/// An anonymous file in memory, close-on-exec. Throws Status::memory.
Descriptor shared_file(const char *name);

/// How a process ended. `known` is false when the host ignores SIGCHLD or has waited for any child itself.
struct Ending {
  bool known, by_signal;
  int status;
  bool is_kill() const;      ///< as for want of memory
  std::string text() const;  ///< "exit status 3", "signal 11 (SEGV)"
};

/// The running executable with its ends of the three channels that remesh_protocol.hpp numbers, and with its
/// standard output and error in a pipe.
class ChildProcess {
 public:
  /// Throws Status::backend_missing when the path cannot be executed, or the system has no pidfds, Status::memory when
  /// it is short of processes, descriptors or memory.
  ChildProcess(const std::string &path, const Descriptor &request, const Descriptor &response);
  /// Kills and reaps. In a process forked from the one that started it, does nothing.
  ~ChildProcess();
  ChildProcess(const ChildProcess &) = delete;
  ChildProcess &operator=(const ChildProcess &) = delete;

  /// False in a process forked from the one that started it.
  bool is_ours() const noexcept;
  /// False where the host has closed what leads to it.
  bool is_connected() const noexcept;
  bool has_ended() const noexcept;
  /// Of processor time that it has used; negative where that cannot be known.
  double cpu_seconds() const noexcept;
  /// Kills it if it still runs, and reaps it; forgets it where the host has closed the handle.
  Ending end() noexcept;

  int control() const noexcept { return control_.number(); }  ///< socket, non-blocking
  int output() const noexcept { return output_.number(); }    ///< pipe, non-blocking; -1 after close_output
  int handle() const noexcept { return handle_.number(); }    ///< pidfd, readable when it has ended
  void close_output() noexcept { output_.close(); }

 private:
  void start(const std::string &path, const Descriptor &request, const Descriptor &response);
  bool has_handle() const noexcept;

  pid_t owner_, pid_ = -1;
  long shown_pid_ = -1;  // as the system shows it of the handle; below zero: it does not
  Descriptor control_, output_, handle_;
};

}  // namespace tetlod
