// Options: one table, and what is asked of it.
#include <cinttypes>
#include <cstring>

#include "arguments.hpp"
#include "context.hpp"

namespace tetlod::capi {

namespace {

/// Defaults are those of tetlod::Options, so they stand in one place.
struct Option {
  std::int32_t number;
  const char *name;
  double Options::*real;           ///< one of the two
  std::int64_t Options::*integer;  ///< is null
  double least, most;
  bool in_paper;  ///< governed by TETLOD_PRESET_PAPER
};

constexpr double two_to_53 = 9007199254740992.0;  // the integers up to here are doubles, as the bounds are given

constexpr Option option_table[] = {
    {TETLOD_OPT_RHO, "rho", &Options::rho, nullptr, 0, 1, false},
    {TETLOD_OPT_SIGMA, "sigma", &Options::sigma, nullptr, 0, 1, false},
    {TETLOD_OPT_LAMBDA, "lambda", &Options::lambda, nullptr, 0, 1e6, true},
    {TETLOD_OPT_MIN_DISTANCE, "min-distance", &Options::min_distance, nullptr, 0, 0.5, true},
    {TETLOD_OPT_MERGE_TOLERANCE, "merge-tolerance", &Options::merge_tolerance, nullptr, 0, 0.1, false},
    {TETLOD_OPT_CLEAN_EDGES, "clean-edges", &Options::clean_edges, nullptr, 0, 0.1, false},
    {TETLOD_OPT_BOUNDARY_LEAF, "boundary-leaf", nullptr, &Options::boundary_leaf, 1, 1e6, true},
    {TETLOD_OPT_TET_LEAF, "tet-leaf", nullptr, &Options::tet_leaf, 1, 1e6, true},
    {TETLOD_OPT_THREADS, "threads", nullptr, &Options::threads, 0, 1024, false},
    {TETLOD_OPT_SEED, "seed", nullptr, &Options::seed, 0, two_to_53, false},
    {TETLOD_OPT_TIME_LIMIT, "time-limit", &Options::time_limit, nullptr, 0, 1e9, false},
    {TETLOD_OPT_ON_COINCIDENT, "on-coincident", nullptr, &Options::on_coincident, 0, 1, false},
    {TETLOD_OPT_ON_REPEATED, "on-repeated", nullptr, &Options::on_repeated, 0, 1, false},
    {TETLOD_OPT_ON_FLAT, "on-flat", nullptr, &Options::on_flat, 0, 1, false},
    {TETLOD_OPT_ON_INVERTED, "on-inverted", nullptr, &Options::on_inverted, 0, 1, false},
    {TETLOD_OPT_ON_DUPLICATE, "on-duplicate", nullptr, &Options::on_duplicate, 0, 1, false},
    {TETLOD_OPT_ON_OVERLAP, "on-overlap", nullptr, &Options::on_overlap, 0, 1, false},
    {TETLOD_OPT_ON_UNUSED, "on-unused", nullptr, &Options::on_unused, 0, 1, false},
    {TETLOD_OPT_ON_NONFINITE, "on-nonfinite", nullptr, &Options::on_nonfinite, 0, 1, false},
    {TETLOD_OPT_TARGET_RATIO, "target-ratio", &Options::target_ratio, nullptr, 0, 1, true},
    {TETLOD_OPT_EFFORT, "effort", nullptr, &Options::effort, 1, 2, false},
    {TETLOD_OPT_MAX_ERROR, "max-error", &Options::max_error, nullptr, 0, 1, true},
    {TETLOD_OPT_MAX_DEVIATION, "max-deviation", &Options::max_deviation, nullptr, 0, 1, true},
    {TETLOD_OPT_WARM_START, "warm-start", &Options::warm_start, nullptr, 0, 1, false},
    {TETLOD_OPT_REMESH, "remesh", nullptr, &Options::remesh, 0, 1, false},
};

const Option *find(std::int32_t number) noexcept {
  for (const Option &option : option_table)
    if (option.number == number) return &option;
  return nullptr;
}

const Option &require_option(std::int32_t number) {
  const Option *const option = find(number);
  if (!option) fail(Status::option, "there is no option %d", number);
  return *option;
}

const Option &require_real(std::int32_t number) {
  const Option &option = require_option(number);
  if (!option.real) fail(Status::option, "option %d (%s) is an integer", number, option.name);
  return option;
}

const Option &require_integer(std::int32_t number) {
  const Option &option = require_option(number);
  if (!option.integer) fail(Status::option, "option %d (%s) is real", number, option.name);
  return option;
}

[[noreturn]] void fail_bounds(const Option &option, const std::string &value) {
  fail(Status::option, "%s: %s is not in [%s, %s]", option.name, value.c_str(), number(option.least).c_str(),
       number(option.most).c_str());
}

void set_real(Options &options, const Option &option, double value) {
  const bool inside = value >= option.least && value <= option.most;  // NaN is not
  if (!inside) fail_bounds(option, number(value));
  options.*option.real = value;
  if (option.number == TETLOD_OPT_TARGET_RATIO) options.usual_ratio = false;
}

void set_integer(Options &options, const Option &option, std::int64_t value) {
  if (value < std::int64_t(option.least) || value > std::int64_t(option.most))
    fail_bounds(option, text("%" PRId64, value));
  options.*option.integer = value;
}

double real_of(const Options &options, const Option &option) {
  return option.number == TETLOD_OPT_TARGET_RATIO ? options.asked_ratio() : options.*option.real;
}

double default_of(const Option &option) {
  const Options defaults;
  return option.real ? defaults.*option.real : double(defaults.*option.integer);
}

tetlod_bounds bounds_of(const Option &option) {
  tetlod_bounds bounds{};
  bounds.is_integer = option.integer ? 1 : 0;
  bounds.least = option.least;
  bounds.most = option.most;
  bounds.preset = default_of(option);
  return bounds;
}

/// The defaults are the paper's values.
void set_as_published(Options &options) {
  const Options paper;
  for (const Option &option : option_table) {
    if (!option.in_paper) continue;
    if (option.real) options.*option.real = paper.*option.real;
    if (option.integer) options.*option.integer = paper.*option.integer;
  }
  options.usual_ratio = false;
}

constexpr double usual_ratio = 0.1;

void set_preset(Options &options, std::int32_t preset) {
  if (preset == TETLOD_PRESET_PAPER) return set_as_published(options);
  if (preset != TETLOD_PRESET_FAST && preset != TETLOD_PRESET_ACCURATE)
    fail(Status::option, "there is no preset %d", preset);
  options.effort = preset == TETLOD_PRESET_FAST ? effort_fast : effort_accurate;
  if (options.target_ratio > 0) return;
  options.target_ratio = usual_ratio;
  options.usual_ratio = true;
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_set_real(tetlod_context *handle, int32_t option, double value) {
  return entry(handle, [&](tetlod_context &context) { set_real(context.options, require_real(option), value); });
}

tetlod_status tetlod_set_int(tetlod_context *handle, int32_t option, int64_t value) {
  return entry(handle, [&](tetlod_context &context) { set_integer(context.options, require_integer(option), value); });
}

tetlod_status tetlod_get_real(const tetlod_context *handle, int32_t option, double *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_pointer(out, "out");
    *out = real_of(context.options, require_real(option));
  });
}

tetlod_status tetlod_get_int(const tetlod_context *handle, int32_t option, int64_t *out) {
  return entry(handle, [&](const tetlod_context &context) {
    require_pointer(out, "out");
    *out = context.options.*require_integer(option).integer;
  });
}

tetlod_status tetlod_set_rho(tetlod_context *context, double rho) {
  return tetlod_set_real(context, TETLOD_OPT_RHO, rho);
}

tetlod_status tetlod_set_sigma(tetlod_context *context, double sigma) {
  return tetlod_set_real(context, TETLOD_OPT_SIGMA, sigma);
}

tetlod_status tetlod_set_lambda(tetlod_context *context, double lambda) {
  return tetlod_set_real(context, TETLOD_OPT_LAMBDA, lambda);
}

tetlod_status tetlod_set_min_distance(tetlod_context *context, double fraction) {
  return tetlod_set_real(context, TETLOD_OPT_MIN_DISTANCE, fraction);
}

tetlod_status tetlod_set_preset(tetlod_context *handle, int32_t preset) {
  return entry(handle, [&](tetlod_context &context) { set_preset(context.options, preset); });
}

tetlod_status tetlod_option_bounds(int32_t option, tetlod_bounds *out) {
  return entry([&] {
    require_struct(out, "out", TETLOD_SIZE_TO(tetlod_bounds, preset));
    copy_struct(bounds_of(require_option(option)), out);
  });
}

int32_t tetlod_option_from_name(const char *name) {
  if (!name) return 0;
  for (const Option &option : option_table)
    if (std::strcmp(option.name, name) == 0) return option.number;
  return 0;
}

const char *tetlod_option_name(int32_t option) {
  const Option *const found = find(option);
  return found ? found->name : nullptr;
}
