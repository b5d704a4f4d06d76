#include "beginning.hpp"

#include <algorithm>

#include "describe.hpp"
#include "footprint.hpp"
#include "least_change.hpp"
#include "select_samples.hpp"
#include "status.hpp"
#include "untangle.hpp"
#include "validate.hpp"

namespace tetlod {

void Beginning::begin() {
  prepare();
  extract();
  refuse_moves(original_, options_);
  if (original_.unequal_field > 0) tell_unequal_fields();
  tell_moves();
  budget_.sigma = options_.sigma;
  if (as_published(options_)) return sample();
  report_.least_change = least_change(original_.view);
  budget_ = first_budget(options_, original_.box.diagonal(), report_);
}

void Beginning::tell_unequal_fields() const {
  const std::string &name = input_.name_of_steering(original_.unequal_field);
  const std::string fields = text("field %.100s: its range and the scalars', %s, are too far apart", name.c_str(),
                                  number(original_.scalar_max - original_.scalar_min).c_str());
  if (options_.max_error > 0) throw Error(Status::max_error, "max-error cannot be held for " + fields);
  if (job_.log) job_.log(2, ("the smaller one does not steer: " + fields).c_str());
}

void Beginning::tell_moves() const {
  if (!job_.log) return;
  const std::string moved_by = about(original_.boundary_moved_by / original_.box.diagonal());
  const auto opened = static_cast<long long>(original_.moves.opened.size()),
             upright = static_cast<long long>(original_.moves.upright.size());
  if (opened > 0)
    job_.log(
        2, text("a field jumps across cracks: %lld points of their sides lie apart, by up to twice %s of the diagonal",
                opened, moved_by.c_str())
               .c_str());
  if (upright > 0)
    job_.log(2, text("tets are turned over: %lld points are moved, those on the boundary by up to %s of the diagonal",
                     upright, moved_by.c_str())
                    .c_str());
}

double Beginning::bound() const {
  constexpr double rounding = 1e-12;  // of sums, beside the bound
  const double whole = options_.max_error * original_.range;
  if (original_.spread_error == 0) return whole;
  return std::max((1 - rounding) * whole - original_.spread_error, 0.0);
}

double Beginning::deviation_limit() const {
  if (options_.max_deviation == 0) return 0;
  return options_.max_deviation * original_.box.diagonal() - original_.boundary_moved_by;
}

void Beginning::refuse_spread() const {
  const bool is_held = bound() > 0 || options_.max_error >= 1;  // no value leaves the range
  if (options_.max_error <= 0 || original_.spread_error == 0 || is_held) return;
  const auto off = [&](std::size_t k) { return original_.view.scales.relative[k] * original_.spread[k].distance; };
  std::size_t field = 0;
  for (std::size_t k = 1; k < original_.view.fields; k++)
    if (off(k) > off(field)) field = k;
  const Spread &spread = original_.spread[field];
  const auto number_of = [&](std::int32_t v) { return static_cast<long long>(v) + input_.index_base; };
  const std::string &name = input_.name_of_steering(field);
  fail(Status::max_error,
       "max-error %s cannot be held: vertices %lld and %lld are one, and values%s%.100s of theirs are %s off",
       number(options_.max_error).c_str(), number_of(spread.lowest), number_of(spread.highest),
       name.empty() ? "" : " of field ", name.c_str(), number(spread.distance).c_str());
}

void Beginning::prepare() {
  const StageTimer timer(Stage::prepare, job_, report_);
  result_.original = fingerprint_of_mesh(input_, options_, job_);
  if (prepared_.renew(result_.original, input_, options_, job_)) {
    report_.reused_tets = input_.tets.tuples;
  } else {
    if (any_strict_policy(options_)) refuse_defects(find_defects(input_, options_, job_), options_);
    prepare_original(input_, options_, job_, original_);
  }
}

void Beginning::extract() {
  const StageTimer timer(Stage::boundary, job_, report_);
  if (!report_.reused_tets) prepare_boundary(input_, options_, job_, original_, boundary_);
  prepared_.complete();
  result_.torn = original_.torn;
  result_.moves = original_.moves;
  describe_input(input_, original_, report_);
  describe_extraction(boundary_, report_);
}

void Beginning::sample() {
  sample_by([this] { select(); });
}

void Beginning::select() { select_samples(original_, boundary_, options_, budget_.samples, job_, selected_); }

namespace {

class Estimate : public Beginning {
 public:
  using Beginning::Beginning;
  double bytes_to_come() {
    begin();
    return expected_bytes(outlook_of(original_, boundary_, selected_, options_, budget_, report_, job_), input_);
  }
};

}  // namespace

std::uint64_t estimate_memory(const Input &input, const Options &options, Prepared &prepared, Job &job) {
  job.memory.reset_peak();
  Result result(job.memory);
  Estimate estimate(input, options, prepared, job, result);
  const double to_come = estimate.bytes_to_come();
  const double later = double(job.memory.in_use()) + to_come;
  return std::max(std::uint64_t(job.memory.peak()), std::uint64_t(later));
}

}  // namespace tetlod
