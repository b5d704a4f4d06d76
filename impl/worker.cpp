#include "worker.hpp"

#include <poll.h>

#include <utility>

#include "remesh_protocol.hpp"
#include "status.hpp"
#include "worker_process.hpp"

namespace tetlod {

double expected_seconds(std::size_t points) { return 1e-5 * double(points) + 1e-3; }

Worker::Worker(std::string path, std::uint64_t address_space)
    : path_(path.empty() ? find_remesher() : std::move(path)), address_space_(address_space) {}

Worker::~Worker() = default;

void Worker::begin(std::size_t process, const TetgenRequest &request, double seconds, Job &job) {
  try {
    forget_lost();
    if (processes_.size() <= process) processes_.resize(process + 1);
    std::unique_ptr<WorkerProcess> &chosen = processes_[process];
    if (!chosen) chosen = std::make_unique<WorkerProcess>(path_, address_space_);
    chosen->begin(request, seconds, job);
  } catch (...) {
    if (process < processes_.size() && processes_[process]) processes_[process]->end();
    abandon();
    throw;
  }
}

/// All of them where we have been forked since, perhaps while they were busy; and those whose descriptors the host has
/// closed.
void Worker::forget_lost() {
  for (auto &process : processes_)
    if (process && !(process->is_ours() && process->is_connected())) process = nullptr;
}

std::size_t Worker::finish_any(Job &job, TetgenReply &reply) {
  try {
    for (;;) {
      forget_lost();
      bool is_busy = false;
      for (std::size_t i = 0; i < processes_.size(); i++) {
        if (!processes_[i] || !processes_[i]->is_busy()) continue;
        is_busy = true;
        if (!processes_[i]->finish(job, reply)) continue;
        refuse_exhaustion(reply);
        return i;
      }
      if (!is_busy)
        fail(Status::state, "the host has forked, or closed descriptors, while %s was at work", path_.c_str());
      wait_for_something();
    }
  } catch (...) {
    abandon();  // one in the middle of a call would answer to the next
    throw;
  }
}

void Worker::wait_for_something() const {
  std::vector<pollfd> events;
  for (const auto &process : processes_)
    if (process && process->is_busy())
      for (const pollfd &event : process->events()) events.push_back(event);
  ::poll(events.data(), nfds_t(events.size()), turn_milliseconds);
}

void Worker::abandon() noexcept {
  for (const auto &process : processes_)
    if (process && process->is_busy()) process->end();
}

void Worker::refuse_exhaustion(const TetgenReply &reply) const {
  if (reply.code != protocol::out_of_memory) return;
  if (address_space_)
    fail(Status::memory_limit, "TetGen needs more than the %llu bytes that it may use",
         static_cast<unsigned long long>(address_space_));
  fail(Status::memory, "TetGen ran out of memory");
}

}  // namespace tetlod
