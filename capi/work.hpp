// What the functions that do work in a context have in common: a fresh start, and the job that listens to the host.
#pragma once
#include <new>

#include "context.hpp"
#include "job.hpp"
#include "status.hpp"

namespace tetlod::capi {

/// Throws Status::state when points or tets are missing.
void require_mesh(const Input &input);
/// The same for scalars, too.
void require_submitted(const Input &input);

/// The mesh and the fields that steered the run that gave the outcome; throws Status::state when others are submitted
/// now. A result compared with another input gives numbers that mean nothing, and nobody would notice. Flags are those
/// of now, as those of the run may be gone; other fields are left out.
Input original_of(const Outcome &outcome, const Input &now);

/// body(). What is kept of earlier runs is the first to go when memory is short here, not in the remeshing process:
/// then it is called again.
template <class Body>
void ahead_of_what_is_kept(tetlod_context &context, const Body &body) {
  const bool any_kept = !context.prepared.empty();
  context.memory.take_shortage();
  try {
    return body();
  } catch (const Error &error) {
    const bool is_shortage = error.status() == Status::memory || error.status() == Status::memory_limit;
    if (!any_kept || !is_shortage || !context.memory.take_shortage()) throw;
  } catch (const std::bad_alloc &) {  // of what takes its memory elsewhere
    if (!any_kept) throw;
  }
  context.prepared.forget(context.memory);
  context.memory.try_again();
  body();
}

/// body(), which may use and renew context.prepared: after a throw nothing is kept.
template <class Body>
void with_what_is_kept(tetlod_context &context, const Body &body) {
  ahead_of_what_is_kept(context, [&] {
    try {
      body();
    } catch (...) {
      context.prepared.forget(context.memory);
      throw;
    }
  });
}

/// The work that begins here is what tetlod_cancel means from now on.
void begin(tetlod_context &context);

/// That heeds tetlod_cancel and writes to the host's log.
Job quiet_job_of(tetlod_context &context);
/// That heeds the time limit, too, and calls the host's progress callback.
Job job_of(tetlod_context &context);

}  // namespace tetlod::capi
