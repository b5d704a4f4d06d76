#include "worker.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "child_process.hpp"
#include "remesh_protocol.hpp"
#include "status.hpp"
#include "worker_output.hpp"

namespace tetlod {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int turn_milliseconds = 20;                // between two polls of the job
constexpr double greeting_seconds = 30;              // for a loaded machine; usually 1 ms
constexpr double idle_worth = 5;                     // seconds of waiting that count as one of work
constexpr std::size_t chunk = std::size_t(1) << 22;  // bytes moved between two polls of the job

/// How far a call has got: nobody knows, so the fraction nears the end without reaching it.
class Patience {
 public:
  Patience(double seconds, double expected, double progress_begin, double progress_end)
      : seconds_(seconds), expected_(expected), begin_(progress_begin), end_(progress_end) {}
  /// Of the worker's own time, so that what a result is does not depend on who else is on the machine.
  bool is_over(const ChildProcess &worker, double cpu_before) const {
    if (seconds_ <= 0) return false;
    const double cpu = worker.cpu_seconds();
    if (cpu < 0) return !worker.has_ended() && elapsed() > seconds_;
    return std::max(cpu - cpu_before, elapsed() / idle_worth) > seconds_;
  }
  void poll(Job &job) const { job.poll(begin_ + (end_ - begin_) * (elapsed() / (elapsed() + expected_))); }

 private:
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  Clock::time_point start_ = Clock::now();
  double seconds_, expected_, begin_, end_;
};

/// A process that may not write so large a file is killed by SIGXFSZ when it tries: so ask first.
void check_file_size_limit(std::uint64_t bytes) {
  rlimit limit;
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || bytes <= limit.rlim_cur) return;
  fail(Status::memory, "the request to the remeshing process has %llu bytes, the file size limit (ulimit -f) is %llu",
       static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(limit.rlim_cur));
}

/// Consecutive arrays written to a shared file.
class FileWriter {
 public:
  FileWriter(const Descriptor &file, const Patience &patience, Job &job)
      : file_(file), patience_(patience), job_(job) {}
  template <class T>
  void write(Span<const T> array) {
    const char *data = reinterpret_cast<const char *>(array.data());
    for (std::size_t left = array.size() * sizeof(T); left;) {
      const ssize_t written = ::pwrite(file_.number(), data, std::min(left, chunk), off_t(offset_));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail(Status::memory, "no shared memory for the request to the remeshing process");
      data += written;
      left -= std::size_t(written);
      offset_ += std::uint64_t(written);
      patience_.poll(job_);
    }
  }

 private:
  const Descriptor &file_;
  const Patience &patience_;
  Job &job_;
  std::uint64_t offset_ = 0;
};

/// Consecutive arrays read from a shared file. Never mapped: a file that is cut short is an answer, not a signal.
class FileReader {
 public:
  FileReader(const Descriptor &file, const Patience &patience, Job &job)
      : file_(file), patience_(patience), job_(job) {}
  template <class T>
  bool read(std::int64_t count, Array<T> &array) {
    array.resize(std::size_t(count));
    char *data = reinterpret_cast<char *>(array.data());
    for (std::size_t left = array.size() * sizeof(T); left;) {
      const ssize_t size = ::pread(file_.number(), data, std::min(left, chunk), off_t(offset_));
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) return false;
      data += size;
      left -= std::size_t(size);
      offset_ += std::uint64_t(size);
      patience_.poll(job_);
    }
    return true;
  }

 private:
  const Descriptor &file_;
  const Patience &patience_;
  Job &job_;
  std::uint64_t offset_ = 0;
};

bool is_count(std::int64_t count) { return count >= 0 && count <= max_count; }

bool counts_agree(const protocol::Reply &answer) {
  return is_count(answer.points) && is_count(answer.tets) && (answer.regions == 0 || answer.regions == answer.tets);
}

/// Asks for the blocks in use, not for the length: a hole of terabytes would be read as zeros.
bool holds_arrays(const Descriptor &response, const protocol::Reply &answer) {
  const std::uint64_t bytes = std::uint64_t(answer.points) * protocol::point_bytes +
                              std::uint64_t(answer.tets) * protocol::tet_bytes +
                              std::uint64_t(answer.regions) * protocol::region_bytes;
  struct stat status;
  return ::fstat(response.number(), &status) == 0 && std::uint64_t(status.st_size) == bytes &&
         std::uint64_t(status.st_blocks) * 512 >= bytes;
}

bool points_are_finite(const TetgenReply &reply) {
  return std::all_of(reply.points.begin(), reply.points.end(),
                     [](const Vec3 &p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

bool corners_are_in_range(const TetgenReply &reply) {
  const auto count = std::int32_t(reply.points.size());
  return std::all_of(reply.tets.begin(), reply.tets.end(), [count](const Tet &tet) {
    return std::all_of(tet.begin(), tet.end(), [count](std::int32_t v) { return v >= 0 && v < count; });
  });
}

bool regions_are_in_range(const TetgenReply &reply) {
  const auto count = std::int64_t(reply.tets.size());
  return std::all_of(reply.regions.begin(), reply.regions.end(),
                     [count](std::int32_t region) { return region >= 0 && region <= count; });
}

/// What a reply says that cannot be so, or null.
const char *read_arrays(const Descriptor &response, const protocol::Reply &answer, const Patience &patience, Job &job,
                        TetgenReply &reply) {
  if (!counts_agree(answer)) return "impossible numbers of points, tets or regions";
  if (!holds_arrays(response, answer)) return "fewer or more bytes than it says";
  FileReader reader(response, patience, job);
  if (!reader.read(answer.points, reply.points) || !reader.read(answer.tets, reply.tets) ||
      !reader.read(answer.regions, reply.regions))
    return "arrays that end too soon";
  if (!points_are_finite(reply)) return "coordinates that are not finite";
  if (!corners_are_in_range(reply)) return "corners that are no points";
  if (!regions_are_in_range(reply)) return "more regions than tets";
  return nullptr;
}

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

double expected_seconds(std::size_t points) { return 1e-5 * double(points) + 1e-3; }

/// A worker that has been greeted, or none.
class Worker::Process {
 public:
  Process() : request_(shared_file("tetlod-request")), response_(shared_file("tetlod-response")) {}

  bool is_ours() const { return !child_ || child_->is_ours(); }
  bool runs() const { return child_ && !child_->has_ended(); }

  /// A process that runs and has said which version it is.
  void ensure(const std::string &path, std::uint64_t address_space, double progress, Job &job);
  void call(const TetgenRequest &request, double seconds, Job &job, TetgenReply &reply);
  void end() noexcept { child_.reset(); }

 private:
  enum class Answer { message, nonsense, silence, end };

  template <class Message>
  bool send(const Message &message) const {
    return ::send(child_->control(), &message, sizeof message, MSG_NOSIGNAL | MSG_DONTWAIT) == sizeof message;
  }
  template <class Message>
  Answer receive(Message &message, const Patience &patience, Job &job);
  void wait_for_something(Job &job);
  void check_greeting(const std::string &path, Answer answer, const protocol::Hello &hello, Job &job);
  void give_up(int code, const std::string &failure, TetgenReply &reply);
  void give_up_dead(Job &job, TetgenReply &reply);
  void send_request(const TetgenRequest &request, const Patience &patience, Job &job);
  void discard_files() const;

  Descriptor request_, response_;
  std::unique_ptr<ChildProcess> child_;
  WorkerOutput output_;
  std::uint64_t calls_ = 0;
};

void Worker::Process::wait_for_something(Job &job) {
  pollfd events[3] = {{child_->control(), POLLIN, 0}, {child_->output(), POLLIN, 0}, {child_->handle(), POLLIN, 0}};
  ::poll(events, 3, turn_milliseconds);
  output_.drain(*child_, job);
}

template <class Message>
Worker::Process::Answer Worker::Process::receive(Message &message, const Patience &patience, Job &job) {
  const double cpu_before = std::max(child_->cpu_seconds(), 0.0);
  for (;;) {
    const bool ended = child_->has_ended();  // asked before: the last message may come just before the end
    const ssize_t size = ::recv(child_->control(), &message, sizeof message, MSG_DONTWAIT | MSG_TRUNC);
    if (size == ssize_t(sizeof message)) return Answer::message;
    if (size > 0) return Answer::nonsense;
    const bool nothing_yet = size < 0 && (errno == EAGAIN || errno == EINTR);
    if (ended || !nothing_yet) return Answer::end;
    if (patience.is_over(*child_, cpu_before)) return Answer::silence;
    wait_for_something(job);
    patience.poll(job);
  }
}

void Worker::Process::ensure(const std::string &path, std::uint64_t address_space, double progress, Job &job) {
  if (runs()) return;
  output_ = {};
  child_ = nullptr;  // the old one is reaped before there is a new one
  child_ = std::make_unique<ChildProcess>(path, request_, response_);
  protocol::Start start;
  start.host_pid = ::getpid();
  start.address_space = address_space;
  send(start);  // a program that has ended already is noticed below
  protocol::Hello hello;
  const Patience patience(greeting_seconds / idle_worth, greeting_seconds, progress, progress);
  check_greeting(path, receive(hello, patience, job), hello, job);
}

void Worker::Process::check_greeting(const std::string &path, Answer answer, const protocol::Hello &hello, Job &job) {
  if (answer == Answer::end) {
    const Ending ending = child_->end();
    output_.drain(*child_, job);
    output_.flush(job);
    throw Error(Status::backend_missing, path + " ended with " + ending.text() + " before its greeting; " +
                                             (output_.last_line().empty() ? "it said nothing" : output_.last_line()));
  }
  if (answer == Answer::silence)
    fail(Status::backend_missing, "%s did not greet within %d seconds", path.c_str(), int(greeting_seconds));
  if (answer == Answer::nonsense || hello.magic != protocol::magic)
    fail(Status::backend_missing, "%s is not tetlod-remesh", path.c_str());
  const std::string found = bounded(hello.tetlod_version);
  if (hello.version != protocol::version || found != TETLOD_VERSION)
    fail(Status::backend_missing, "%s is version %s (protocol %u), this library is version %s (protocol %u)",
         path.c_str(), found.c_str(), hello.version, TETLOD_VERSION, protocol::version);
}

void Worker::Process::send_request(const TetgenRequest &request, const Patience &patience, Job &job) {
  check_file_size_limit(request.points.size() * protocol::point_bytes + request.insert.size() * protocol::point_bytes +
                        request.triangles.size() * protocol::triangle_bytes);
  discard_files();
  FileWriter writer(request_, patience, job);
  writer.write(request.points);
  writer.write(request.insert);
  writer.write(request.triangles);
  protocol::Call message = call_message(request);
  message.number = ++calls_;
  send(message);  // to a worker that has died in between: noticed when receiving
}

/// Gives the memory back; also before a call, after one that was interrupted.
void Worker::Process::discard_files() const {
  if (::ftruncate(request_.number(), 0) != 0 || ::ftruncate(response_.number(), 0) != 0)
    fail(Status::internal, "cannot empty the files shared with the remeshing process");
}

void Worker::Process::give_up(int code, const std::string &failure, TetgenReply &reply) {
  end();
  reply.code = code;
  reply.failure = failure;
}

void Worker::Process::give_up_dead(Job &job, TetgenReply &reply) {
  const Ending ending = child_->end();
  output_.drain(*child_, job);
  output_.flush(job);
  const bool perhaps_memory = ending.known && ending.by_signal && ending.status == SIGKILL;
  give_up(worker_died, "died with " + ending.text() + (perhaps_memory ? ", perhaps for want of memory" : ""), reply);
}

void Worker::Process::call(const TetgenRequest &request, double seconds, Job &job, TetgenReply &reply) {
  const double expected = expected_seconds(request.points.size() + request.insert.size());
  const Patience patience(seconds, expected, request.progress_begin, request.progress_end);
  output_.start_call();
  send_request(request, patience, job);
  protocol::Reply answer;
  switch (receive(answer, patience, job)) {
    case Answer::end: return give_up_dead(job, reply);
    case Answer::nonsense: return give_up(worker_lied, "sent a message of another length", reply);
    case Answer::silence: return give_up(worker_exhausted, "took more than " + number(seconds) + " seconds", reply);
    case Answer::message: break;
  }
  if (answer.number != calls_) return give_up(worker_lied, "answered another call", reply);
  output_.drain(*child_, job);
  reply.peak_bytes = answer.peak_bytes;
  if (answer.code != 0) return give_up(answer.code, bounded(answer.text), reply);
  if (const char *lie = read_arrays(response_, answer, patience, job, reply))
    return give_up(worker_lied, std::string("answered with ") + lie, reply);
  discard_files();
}

Worker::Worker(std::string path, std::uint64_t address_space)
    : path_(path.empty() ? find_remesher() : std::move(path)), address_space_(address_space) {}

Worker::~Worker() = default;

void Worker::tetrahedralize(const TetgenRequest &request, double seconds, Job &job, TetgenReply &reply) {
  if (process_ && !process_->is_ours()) process_ = nullptr;  // the parent's, as we have been forked since
  if (!process_) process_ = std::make_unique<Process>();
  const auto attempt = [&] {
    reply.code = 0;
    reply.failure.clear();
    process_->ensure(path_, address_space_, request.progress_begin, job);
    process_->call(request, seconds, job, reply);
  };
  try {
    const bool used_before = process_->runs();
    attempt();
    // Perhaps it was killed while idle, and what a result is must not depend on that: a fresh one decides.
    if (reply.code == worker_died && used_before) attempt();
  } catch (...) {
    process_->end();  // in the middle of a call: it would answer to the next
    throw;
  }
  if (reply.code != protocol::out_of_memory) return;
  if (address_space_)
    fail(Status::memory_limit, "TetGen needs more than the %llu bytes that it may use",
         static_cast<unsigned long long>(address_space_));
  fail(Status::memory, "TetGen ran out of memory");
}

}  // namespace tetlod
