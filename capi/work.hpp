// What the functions that do work in a context have in common: a fresh start, and the job that listens to the host.
#pragma once
#include "context.hpp"
#include "job.hpp"

namespace tetlod::capi {

/// Throws Status::state when points or tets are missing.
void require_mesh(const Input &input);
/// The same for scalars, too.
void require_submitted(const Input &input);

/// The arrays of the run that gave the outcome, and no others. A result compared with another input gives numbers that
/// mean nothing, and nobody would notice.
void require_input_of(const Outcome &outcome, const Input &input);

/// The work that begins here is what tetlod_cancel means from now on.
void begin(tetlod_context &context);

/// The host's log and tetlod_cancel.
void connect_log(Job &job, tetlod_context &context);
/// The host's progress callback and the time limit.
void connect_progress(Job &job, tetlod_context &context);

}  // namespace tetlod::capi
