#include "remesh.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "remesh_attempts.hpp"
#include "remesh_checks.hpp"
#include "remesh_parts.hpp"
#include "remesh_result.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

/// Long enough for a machine that is loaded, short enough to end an endless loop.
double time_share(const RemeshInput &input, Ladder ladder) {
  const double least = ladder == Ladder::whole ? 10 : 1;
  return std::max(least, 50 * expected_seconds(input.points.size() + input.insert.size()));
}

/// How far a part has got when so many attempts are over: the first usually is the only one.
double progress_after(int count) { return count ? 1 - 0.1 * std::ldexp(1.0, 1 - count) : 0; }

/// How far all parts have got together.
class Progress {
 public:
  explicit Progress(const RemeshParts &parts) : share_(parts.count()), done_(parts.count(), 0) {
    double whole = 0;
    for (std::size_t p = 0; p < share_.size(); p++) whole += double(parts.size(p));
    for (std::size_t p = 0; p < share_.size(); p++) share_[p] = double(parts.size(p)) / whole;
  }
  /// The fraction of the whole, now that so much of the part is done.
  double set(std::size_t part, double fraction) {
    done_[part] = fraction;
    return std::inner_product(share_.begin(), share_.end(), done_.begin(), 0.0);
  }

 private:
  std::vector<double> share_, done_;
};

/// A part on its way through the attempts.
class Climb {
 public:
  Climb(std::size_t part, const Surface &surface, Span<const Vec3> samples, std::int64_t components, Ladder ladder,
        Progress &progress, Job &job)
      : part_(part),
        problem_{surface, samples, box_of(surface.points), components, job},
        ladder_(ladder),
        progress_(progress) {}
  Climb(std::size_t part, std::unique_ptr<RemeshPart> own, Ladder ladder, Progress &progress, Job &job)
      : Climb(part, own->surface, own->samples, own->components, ladder, progress, job) {
    own_ = std::move(own);
  }

  std::size_t part() const { return part_; }
  int attempts() const { return attempts_; }
  /// What was wrong with each attempt.
  const std::string &failures() const { return failures_; }

  /// Hands the next attempt to the worker. False: there is none left.
  bool begin(Worker &worker, std::size_t process) {
    const Span<const RemeshAttempt> all = remesh_attempts();
    while (next_ < all.size() && all[next_].about_samples && problem_.samples.empty()) next_++;
    if (next_ == all.size() || (next_ > 0 && ladder_ == Ladder::first_rung)) return false;
    const double from = progress_after(attempts_++), to = progress_after(attempts_);
    attempt_ = &all[next_++];
    input_.emplace(attempt_->input(problem_, progress_.set(part_, from)));
    TetgenRequest request;
    request.switches = input_->switches.c_str();
    request.points = input_->points;
    request.insert = input_->insert;
    request.triangles = input_->triangles;
    request.progress = [this, from, to](double done) { return progress_.set(part_, from + (to - from) * done); };
    worker.begin(process, request, time_share(*input_, ladder_), problem_.job);
    return true;
  }

  /// Whether the answer to the attempt is as it should be: then it is the result.
  bool accept(TetgenReply &reply, RemeshResult &result) {
    const double fraction = progress_.set(part_, progress_after(attempts_));
    std::string failure = reply.failure;
    if (reply.code == 0)
      failure = accept_reply(*input_, problem_.surface, problem_.samples, reply, fraction, problem_.job, result);
    if (failure.empty()) return true;
    failures_ += std::string(failures_.empty() ? "" : "; ") + attempt_->name + ": " + failure;
    if (problem_.job.log) problem_.job.log(1, (std::string("remeshing, ") + attempt_->name + ": " + failure).c_str());
    return false;
  }

 private:
  std::size_t part_;
  std::unique_ptr<RemeshPart> own_;  // what the problem is of, unless that is the whole
  RemeshProblem problem_;
  Ladder ladder_;
  Progress &progress_;
  const RemeshAttempt *attempt_ = nullptr;
  std::size_t next_ = 0;
  int attempts_ = 0;
  std::optional<RemeshInput> input_;
  std::string failures_;
};

/// All parts, as many at once as there are threads. What becomes of one does not depend on the others.
class RemeshingOfParts {
 public:
  RemeshingOfParts(const Surface &surface, const SurfaceFacts &facts, Span<const Vec3> samples,
                   const RemeshParts &parts, Ladder ladder, Worker &worker, Job &job)
      : surface_(surface),
        facts_(facts),
        samples_(samples),
        parts_(parts),
        ladder_(ladder),
        worker_(worker),
        job_(job),
        progress_(parts),
        waiting_(parts.count()),
        climbs_(std::min(parts.count(), std::size_t(job.parallel.threads()))),
        peak_bytes_(climbs_.size(), 0) {
    std::iota(waiting_.begin(), waiting_.end(), 0);
    std::sort(waiting_.begin(), waiting_.end(), [&](std::size_t a, std::size_t b) {
      return parts.size(a) != parts.size(b) ? parts.size(a) < parts.size(b) : a < b;
    });
    for (std::size_t p = 0; p < parts.count(); p++) results_.emplace_back(job.memory);
  }
  /// After an exception calls may be under way.
  ~RemeshingOfParts() { worker_.abandon(); }
  RemeshingOfParts(const RemeshingOfParts &) = delete;
  RemeshingOfParts &operator=(const RemeshingOfParts &) = delete;

  RemeshResult run(const std::function<void()> &meanwhile) {
    for (std::size_t process = 0; process < climbs_.size(); process++) start(process);
    if (meanwhile) meanwhile();
    for (std::size_t left = parts_.count(); left > 0;) left -= finish_any();
    RemeshResult whole(job_.memory);
    if (results_.size() == 1)
      whole = std::move(results_[0]);
    else
      parts_.join({results_.data(), results_.size()}, whole);
    whole.report.attempts = attempts_;
    whole.report.worker_peak_bytes = std::accumulate(peak_bytes_.begin(), peak_bytes_.end(), std::uint64_t(0));
    return whole;
  }

 private:
  /// The largest of those that wait first, so that at the end no process works alone for long.
  void start(std::size_t process) {
    const std::size_t part = waiting_.back();
    waiting_.pop_back();
    if (parts_.count() == 1)
      climbs_[process] = std::make_unique<Climb>(part, surface_, samples_, facts_.components, ladder_, progress_, job_);
    else
      climbs_[process] =
          std::make_unique<Climb>(part, std::make_unique<RemeshPart>(parts_.part(part)), ladder_, progress_, job_);
    climbs_[process]->begin(worker_, process);
  }

  /// The number of parts, one or none, that are done with it.
  std::size_t finish_any() {
    TetgenReply reply(job_.memory);
    const std::size_t process = worker_.finish_any(job_, reply);
    Climb &climb = *climbs_[process];
    peak_bytes_[process] = std::max(peak_bytes_[process], reply.peak_bytes);
    const bool accepted = climb.accept(reply, results_[climb.part()]);
    attempts_ = std::max(attempts_, climb.attempts());
    if (!accepted) {
      if (!climb.begin(worker_, process)) fail_for(climb);
      return 0;
    }
    climbs_[process] = nullptr;
    if (!waiting_.empty()) start(process);
    return 1;
  }

  [[noreturn]] void fail_for(const Climb &climb) const {
    const std::string which = parts_.count() == 1 ? "" : text("part %zu of %zu, ", climb.part() + 1, parts_.count());
    throw Error(Status::remesh,
                "the simplified boundary could not be filled with tets (" + which + climb.failures() + ")");
  }

  const Surface &surface_;
  const SurfaceFacts &facts_;
  Span<const Vec3> samples_;
  const RemeshParts &parts_;
  Ladder ladder_;
  Worker &worker_;
  Job &job_;
  Progress progress_;
  std::vector<std::size_t> waiting_;
  std::vector<std::unique_ptr<Climb>> climbs_;  // of each process
  std::vector<std::uint64_t> peak_bytes_;       // of each process
  std::vector<RemeshResult> results_;           // of each part
  std::int32_t attempts_ = 0;
};

}  // namespace

void remesh(const Surface &surface, Span<const Vec3> samples, Worker &worker, Job &job, RemeshResult &result,
            std::size_t points_at_once, const std::function<void()> &meanwhile, Ladder ladder) {
  check_samples(samples);
  const SurfaceFacts facts = check_surface(surface, job);
  const RemeshParts parts(surface, facts, samples, points_at_once, job);
  result = RemeshingOfParts(surface, facts, samples, parts, ladder, worker, job).run(meanwhile);
}

}  // namespace tetlod
