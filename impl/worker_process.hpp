// One process of tetlod-remesh: started, greeted, called, ended.
#pragma once
#include <poll.h>
#include <sys/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "child_process.hpp"
#include "job.hpp"
#include "patience.hpp"
#include "remesh_protocol.hpp"
#include "worker.hpp"
#include "worker_output.hpp"

namespace tetlod {

constexpr int turn_milliseconds = 20;  ///< between two polls of the job

/// Started by its first call. After an exception it is to be ended: it may be in the middle of a call.
class WorkerProcess {
 public:
  WorkerProcess(std::string path, std::uint64_t address_space);

  /// False in a process forked from the one that made this.
  bool is_ours() const;
  /// False where the host has closed what is shared with it, or leads to it.
  bool is_connected() const;
  /// From begin() until finish() has an answer.
  bool is_busy() const { return call_.has_value(); }

  /// Hands over the call; waits for the greeting of a process that has to be started. What the request points to has to
  /// live until the end of the call.
  void begin(const TetgenRequest &request, double seconds, Job &job) { begin(request, seconds, false, job); }
  /// True when the call is over, with what Worker::finish_any() says of the reply. Polls the job, does not wait.
  /// Throws Status::memory when two processes were killed, for what came of another attempt would depend on that.
  bool finish(Job &job, TetgenReply &reply);
  /// What says that finish() may have something to do.
  std::array<pollfd, 3> events() const;
  /// The files that are shared with it give their memory back.
  void end() noexcept;

 private:
  enum class Answer { message, nonsense, silence, end, nothing_yet };

  /// The call that is under way.
  struct Call {
    TetgenRequest request;
    double seconds;
    Patience patience;
    double cpu_before;
    bool used_before;  ///< the process has had a call before this one
    bool repeated;     ///< by a process that died
  };

  void begin(const TetgenRequest &request, double seconds, bool repeated, Job &job);
  bool runs() const { return child_ && !child_->has_ended(); }
  void ensure(const TetgenRequest &request, Job &job);
  template <class Message>
  bool send(const Message &message) const;
  template <class Message>
  Answer receive(Message &message, const Patience &patience, double cpu_before);
  Answer wait_for_greeting(protocol::Hello &hello, const Patience &patience, Job &job);
  void check_greeting(Answer answer, const protocol::Hello &hello, Job &job);
  void send_request(const Call &call, Job &job);
  void settle(Answer kind, const protocol::Reply &answer, Job &job, TetgenReply &reply);
  void give_up(int code, const std::string &failure, TetgenReply &reply);
  void give_up_dead(Job &job, TetgenReply &reply);
  bool empty_files() const noexcept;

  pid_t owner_;
  std::string path_;
  std::uint64_t address_space_;
  Descriptor request_, response_;
  std::unique_ptr<ChildProcess> child_;
  WorkerOutput output_;
  std::optional<Call> call_;
  std::uint64_t calls_ = 0;
};

}  // namespace tetlod
