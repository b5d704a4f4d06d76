// What the functions that do work in a context have in common: a fresh start, and the job that listens to the host.
#include "work.hpp"

#include <sched.h>

#include <algorithm>
#include <thread>

namespace tetlod::capi {

namespace {

/// That the process may use.
std::size_t cores() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? std::size_t(CPU_COUNT(&set))
                                                       : std::thread::hardware_concurrency();
}

int threads_of(const Options &options) {
  const std::size_t most = std::max(cores(), std::size_t(1));
  return int(options.threads ? std::min(std::size_t(options.threads), most) : most);
}

bool host_cancels(tetlod_context &context, Stage stage, double fraction) {
  std::int32_t answer = 0;
  const bool returned = call_host(*context.host, context.callback_failure, "progress", [&] {
    answer = context.progress.call(context.progress.user, std::int32_t(stage), fraction);
  });
  return !returned || answer != 0;
}

/// A log callback that throws cannot be thrown through (it may be told things while others clean up): the run ends at
/// its next poll.
void log_to_host(tetlod_context &context, int level, const char *message) {
  if (level < context.log.least || context.caller.load() != &thread_message()) return;
  const bool returned = call_host(*context.host, context.callback_failure, "log",
                                  [&] { context.log.call(context.log.user, level, message); });
  if (!returned) context.cancel.store(true, std::memory_order_relaxed);
}

bool same(const StridedArray &a, const StridedArray &b) {
  return a.present == b.present && a.type == b.type && a.tuples == b.tuples && a.components == b.components &&
         a.tuple_stride == b.tuple_stride && a.component_stride == b.component_stride && a.data == b.data;
}

bool same(const SteeringField &a, const SteeringField &b) { return a.name == b.name && same(a.values, b.values); }

bool same(const std::vector<SteeringField> &a, const std::vector<SteeringField> &b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SteeringField &f, const SteeringField &g) { return same(f, g); });
}

/// What of the one is not in the other; null: nothing.
const char *first_difference(const Input &a, const Input &b) {
  if (!same(a.xyz[0], b.xyz[0]) || !same(a.xyz[1], b.xyz[1]) || !same(a.xyz[2], b.xyz[2])) return "points";
  if (!same(a.tets, b.tets) || a.index_base != b.index_base) return "tets";
  if (!same(a.scalars, b.scalars)) return "scalars";
  return same(a.steering, b.steering) ? nullptr : "fields that steer";
}

void require_submitted(const StridedArray &array, const char *name) {
  if (!array.present) fail(Status::state, "no %s are submitted", name);
}

}  // namespace

void require_mesh(const Input &input) {
  require_submitted(input.xyz[0], "points");
  require_submitted(input.tets, "tets");
}

void require_submitted(const Input &input) {
  require_mesh(input);
  require_submitted(input.scalars, "scalars");
}

Input original_of(const Outcome &outcome, const Input &now) {
  require_submitted(now);
  if (const char *changed = first_difference(outcome.input, now))
    fail(Status::state, "the %s of the last run are not submitted any more", changed);
  Input original = outcome.input;
  original.flags = now.flags;
  original.fields.clear();
  return original;
}

void begin(tetlod_context &context) {
  context.cancel.store(false, std::memory_order_relaxed);
  context.callback_failure.set("");
  context.memory.reset_peak();
  context.parallel = Parallel(threads_of(context.options));
}

Job quiet_job_of(tetlod_context &context) {
  Job job(context.memory, context.parallel);
  job.cancel = &context.cancel;
  if (context.log.call) job.log = [&context](int level, const char *message) { log_to_host(context, level, message); };
  return job;
}

Job job_of(tetlod_context &context) {
  Job job = quiet_job_of(context);
  job.time_limit = context.options.time_limit;
  if (context.progress.call)
    job.progress = [&context](Stage stage, double fraction) { return host_cancels(context, stage, fraction); };
  return job;
}

}  // namespace tetlod::capi
