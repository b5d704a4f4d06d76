#include "worker_process.hpp"

#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "status.hpp"
#include "worker_files.hpp"

namespace tetlod {

namespace {

constexpr double greeting_seconds = 30;  // for a loaded machine; usually 1 ms
constexpr int worker_killed = 1004;      // beside the codes of TetgenReply: by somebody else

template <std::size_t n>
std::string bounded(const char (&characters)[n]) {
  return std::string(characters, ::strnlen(characters, n));
}

protocol::Call call_message(const TetgenRequest &request) {
  protocol::Call call;
  call.points = std::int64_t(request.points.size());
  call.inserted = std::int64_t(request.insert.size());
  call.triangles = std::int64_t(request.triangles.size());
  for (const std::int64_t count : {call.points, call.inserted, call.triangles, call.points + call.inserted})
    if (!is_count(count)) fail(Status::mesh_too_large, "more than %lld points to remesh", (long long)max_count);
  if (std::strlen(request.switches) >= sizeof call.switches) fail(Status::internal, "too many switches");
  std::strcpy(call.switches, request.switches);
  return call;
}

}  // namespace

WorkerProcess::WorkerProcess(std::string path, std::uint64_t address_space)
    : owner_(::getpid()),
      path_(std::move(path)),
      address_space_(address_space),
      request_(shared_file("tetlod-request")),
      response_(shared_file("tetlod-response")) {}

std::array<pollfd, 3> WorkerProcess::events() const {
  return {{{child_->control(), POLLIN, 0}, {child_->output(), POLLIN, 0}, {child_->handle(), POLLIN, 0}}};
}

bool WorkerProcess::is_ours() const { return owner_ == ::getpid(); }

bool WorkerProcess::is_connected() const {
  return request_.is_open() && response_.is_open() && (!child_ || child_->is_connected());
}

void WorkerProcess::end() noexcept {
  call_.reset();
  child_.reset();
  if (is_ours()) empty_files();
}

template <class Message>
bool WorkerProcess::send(const Message &message) const {
  return ::send(child_->control(), &message, sizeof message, MSG_NOSIGNAL | MSG_DONTWAIT) == sizeof message;
}

template <class Message>
WorkerProcess::Answer WorkerProcess::receive(Message &message, const Patience &patience, double cpu_before) {
  const bool ended = child_->has_ended();  // asked before: the last message may come just before the end
  const ssize_t size = ::recv(child_->control(), &message, sizeof message, MSG_DONTWAIT | MSG_TRUNC);
  if (size == ssize_t(sizeof message)) return Answer::message;
  if (size > 0) return Answer::nonsense;
  const bool nothing_yet = size < 0 && (errno == EAGAIN || errno == EINTR);
  if (ended || !nothing_yet) return Answer::end;
  return patience.is_over(*child_, cpu_before) ? Answer::silence : Answer::nothing_yet;
}

void WorkerProcess::ensure(const TetgenRequest &request, Job &job) {
  if (runs()) return;
  output_ = {};
  child_ = nullptr;  // the old one is reaped before there is a new one
  child_ = std::make_unique<ChildProcess>(path_, request_, response_);
  protocol::Start start;
  start.host_pid = ::getpid();
  start.address_space = address_space_;
  send(start);  // a program that has ended already is noticed below
  const auto &progress = request.progress;
  const Patience patience(greeting_seconds / idle_worth, greeting_seconds,
                          [&](double) { return progress ? progress(0) : 0; });
  protocol::Hello hello;
  const Answer answer = wait_for_greeting(hello, patience, job);
  check_greeting(answer, hello, job);
}

WorkerProcess::Answer WorkerProcess::wait_for_greeting(protocol::Hello &hello, const Patience &patience, Job &job) {
  for (;;) {
    const Answer answer = receive(hello, patience, 0);
    if (answer != Answer::nothing_yet) return answer;
    std::array<pollfd, 3> waited_for = events();
    ::poll(waited_for.data(), waited_for.size(), turn_milliseconds);
    output_.drain(*child_, job);
    patience.poll(job);
  }
}

void WorkerProcess::check_greeting(Answer answer, const protocol::Hello &hello, Job &job) {
  if (answer == Answer::end) {
    const Ending ending = child_->end();
    output_.drain(*child_, job);
    output_.flush(job);
    if (ending.known && !ending.by_signal && ending.status == protocol::no_thread)
      fail(Status::memory, "the system has no thread for %s", path_.c_str());
    if (ending.is_kill())
      fail(Status::memory, "%s was killed before its greeting, perhaps for want of memory", path_.c_str());
    throw Error(Status::backend_missing, path_ + " ended with " + ending.text() + " before its greeting; " +
                                             (output_.last_line().empty() ? "it said nothing" : output_.last_line()));
  }
  if (answer == Answer::silence)
    fail(Status::backend_missing, "%s did not greet within %d seconds", path_.c_str(), int(greeting_seconds));
  if (answer == Answer::nonsense || hello.magic != protocol::magic)
    fail(Status::backend_missing, "%s is not tetlod-remesh", path_.c_str());
  const std::string found = bounded(hello.tetlod_version);
  if (hello.version != protocol::version || found != TETLOD_VERSION)
    fail(Status::backend_missing, "%s is version %s (protocol %u), this library is version %s (protocol %u)",
         path_.c_str(), found.c_str(), hello.version, TETLOD_VERSION, protocol::version);
}

void WorkerProcess::send_request(const Call &call, Job &job) {
  if (!empty_files()) fail(Status::internal, "cannot empty the files shared with the remeshing process");
  write_arrays(request_, call.request, call.patience, job);
  protocol::Call message = call_message(call.request);
  message.number = ++calls_;
  send(message);  // to a worker that has died in between: noticed when receiving
}

bool WorkerProcess::empty_files() const noexcept {
  return request_.is_open() && response_.is_open() && ::ftruncate(request_.number(), 0) == 0 &&
         ::ftruncate(response_.number(), 0) == 0;
}

void WorkerProcess::begin(const TetgenRequest &request, double seconds, bool repeated, Job &job) {
  const bool used_before = runs();
  const double expected = expected_seconds(request.points.size() + request.insert.size());
  ensure(request, job);
  call_.emplace(Call{request, seconds, Patience(seconds, expected, request.progress), 0, used_before, repeated});
  output_.start_call();
  send_request(*call_, job);
  call_->cpu_before = std::max(child_->cpu_seconds(), 0.0);
}

bool WorkerProcess::finish(Job &job, TetgenReply &reply) {
  protocol::Reply answer;
  const Answer kind = receive(answer, call_->patience, call_->cpu_before);
  if (kind == Answer::nothing_yet) {
    output_.drain(*child_, job);
    call_->patience.poll(job);
    return false;
  }
  reply.code = 0;
  reply.failure.clear();
  settle(kind, answer, job, reply);
  // Perhaps it was ended while idle, and what a result is must not depend on that: a fresh one decides.
  const bool perhaps_idle = reply.code == worker_died && call_->used_before;
  if (!call_->repeated && (perhaps_idle || reply.code == worker_killed)) {
    const Call again = *call_;
    begin(again.request, again.seconds, true, job);
    return false;
  }
  if (reply.code == worker_killed)
    fail(Status::memory, "two processes of %s were killed, perhaps for want of memory", path_.c_str());
  call_.reset();
  return true;
}

void WorkerProcess::settle(Answer kind, const protocol::Reply &answer, Job &job, TetgenReply &reply) {
  if (kind == Answer::end) return give_up_dead(job, reply);
  if (kind == Answer::nonsense) return give_up(worker_lied, "sent a message of another length", reply);
  if (kind == Answer::silence)
    return give_up(worker_exhausted, text("took more than %lld ms", std::llround(1000 * call_->seconds)), reply);
  if (answer.number != calls_) return give_up(worker_lied, "answered another call", reply);
  output_.drain(*child_, job);
  reply.peak_bytes = answer.peak_bytes;
  if (answer.code != 0) return give_up(answer.code, bounded(answer.text), reply);
  if (const char *lie = read_arrays(response_, answer, call_->patience, job, reply))
    return give_up(worker_lied, std::string("answered with ") + lie, reply);
  empty_files();
}

void WorkerProcess::give_up(int code, const std::string &failure, TetgenReply &reply) {
  child_.reset();
  empty_files();
  reply.code = code;
  reply.failure = failure;
}

void WorkerProcess::give_up_dead(Job &job, TetgenReply &reply) {
  constexpr int soon_milliseconds = 100;  // between the end of its connections and its own
  pollfd handle = {child_->handle(), POLLIN, 0};
  ::poll(&handle, 1, soon_milliseconds);
  const bool by_itself = child_->has_ended();  // or else by us, now
  const Ending ending = child_->end();
  output_.drain(*child_, job);
  output_.flush(job);
  const bool killed = by_itself && ending.is_kill();
  give_up(killed ? worker_killed : worker_died, "died with " + ending.text(), reply);
}

}  // namespace tetlod
