// Running, and what is asked about a run while its input is still there.
#include <algorithm>

#include "arguments.hpp"
#include "context.hpp"
#include "measure_error.hpp"
#include "prepare.hpp"
#include "work.hpp"

namespace tetlod::capi {

namespace {

std::unique_ptr<Outcome> fresh_outcome(tetlod_context &context) {
  auto outcome = std::make_unique<Outcome>(context.memory);
  outcome->input = context.input;
  outcome->options = context.options;
  outcome->threads = context.parallel.threads();
  return outcome;
}

void require_samples(std::int32_t samples_per_tet) {
  if (samples_per_tet < 0 || samples_per_tet > 100)
    fail(Status::argument, "samples_per_tet %d is not in [0, 100]", samples_per_tet);
}

tetlod_error_report report_of(const FieldError &error, std::int32_t samples_per_tet) {
  tetlod_error_report report{};
  report.samples_per_tet = samples_per_tet;
  report.rms = error.rms;
  report.max = error.max;
  report.outside = error.outside;
  report.rms_inner = error.rms_inner;
  report.max_inner = error.max_inner;
  report.outside_inner = error.outside_inner;
  return report;
}

void require_bins(std::int32_t side, std::int32_t bins) {
  if (side != 0 && side != 1) fail(Status::argument, "side %d is neither 0 (original) nor 1 (result)", side);
  if (bins < 1 || bins > 1 << 20) fail(Status::argument, "%d bins are not in [1, %d]", bins, 1 << 20);
}

/// In pieces, so that no memory is needed.
void count_values(const StridedArray &values, double low, double high, Span<std::int64_t> counts) {
  double piece[512];
  const std::int64_t most = std::int64_t(std::size(piece));
  for (std::int64_t first = 0; first < values.tuples; first += most) {
    const std::int64_t count = std::min(most, values.tuples - first);
    for (std::int64_t i = 0; i < count; i++) piece[i] = values.real(first + i, 0);
    histogram({piece, std::size_t(count)}, low, high, counts);
  }
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_run(tetlod_context *handle) {
  return entry(handle, [](tetlod_context &context) {
    begin(context);
    require_submitted(context.input);
    for (const SubmittedField &field : context.input.fields)
      check_count(context.input, field.name, field.values.tuples, field.association);
    check_counts(context.input);
    Job job = job_of(context);
    auto outcome = fresh_outcome(context);
    with_what_is_kept(context, [&] {
      outcome->result = Result(context.memory);
      run(context.input, context.options, context.worker, context.prepared, job, outcome->result);
      job.poll(1);  // who cancels before the end gets what was asked for
    });
    context.outcome = std::move(outcome);
  });
}

tetlod_status tetlod_measure_error(tetlod_context *handle, int32_t samples_per_tet, tetlod_error_report *out) {
  return entry(handle, [&](tetlod_context &context) {
    begin(context);
    require_struct(out, "out", TETLOD_SIZE_TO(tetlod_error_report, outside_inner));
    require_samples(samples_per_tet);
    const Outcome &outcome = last_outcome(context);
    const Input original = original_of(outcome, context.input);
    Options options = outcome.options;
    options.seed = context.options.seed;
    Job job = job_of(context);
    ahead_of_what_is_kept(context, [&] {
      const FieldError error = measure_error(original, options, outcome.result, samples_per_tet, context.prepared, job);
      copy_struct(report_of(error, samples_per_tet), out);
    });
  });
}

tetlod_status tetlod_histogram(const tetlod_context *handle, int32_t side, int32_t bins, int64_t *counts) {
  return entry(handle, [&](const tetlod_context &context) {
    require_bins(side, bins);
    require_pointer(counts, "counts");
    const Outcome &outcome = last_outcome(context);
    const Report &report = outcome.result.report;
    const Span<std::int64_t> room(counts, std::size_t(bins));
    const StridedArray values = side == 0 ? original_of(outcome, context.input).scalars : StridedArray();
    std::fill(room.begin(), room.end(), 0);
    if (side == 0)
      count_values(values, report.scalar_min, report.scalar_max, room);
    else
      histogram(outcome.result.mesh.scalars, report.scalar_min, report.scalar_max, room);
  });
}
