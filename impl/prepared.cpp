#include "prepared.hpp"

#include "budget.hpp"
#include "decimate_and_check.hpp"
#include "solids.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

Fingerprint stamp_of(const Fingerprint &mesh, const Input &input, const Options &options, Job &job) {
  Fingerprint stamp = mesh;
  stamp.add(input.flags, job);
  stamp.add(options.merge_tolerance);
  for (const std::int64_t policy : {options.on_coincident, options.on_repeated, options.on_flat, options.on_inverted,
                                    options.on_duplicate, options.on_overlap, options.on_unused, options.on_nonfinite})
    stamp.add(std::uint64_t(policy));
  return stamp;
}

/// Of what a cost that sees the fields depends on; of nothing, for the paper's.
Fingerprint fingerprint_of(Span<const double> values, const DecimateOptions &options, Job &job) {
  Fingerprint fingerprint;
  if (options.sees_fields()) fingerprint.add(values, job);
  return fingerprint;
}

/// Which points have one, in whichever field: they and their tets are ignored.
void add_nonfinite_values(const Input &input, Job &job, Fingerprint &mesh) {
  for (std::int64_t v = 0; v < input.scalars.tuples; v++) {
    job.poll_at(std::size_t(v), 0);
    if (!has_finite_values(input, v)) mesh.add(std::uint64_t(v));
  }
}

}  // namespace

Fingerprint fingerprint_of_mesh(const Input &input, const Options &options, Job &job) {
  Fingerprint mesh;
  for (const StridedArray &coordinate : input.xyz) mesh.add(coordinate, job);
  mesh.add(input.tets, job);
  mesh.add(std::uint64_t(input.index_base));
  if (options.on_nonfinite == policy_repair) add_nonfinite_values(input, job, mesh);
  return mesh;
}

bool Prepared::holds(const Fingerprint &mesh, const Input &input, const Options &options, Job &job) {
  surface_has_values_ = false;
  const bool would_merge_others = original.merging_depends && (took_contacts_ != takes_contacts(options) ||
                                                               max_deviation_ != options.max_deviation);
  return filled_ && !would_merge_others && stamp_of(mesh, input, options, job) == stamp_ &&
         renew_values(input, job, original);
}

bool Prepared::renew(const Fingerprint &mesh, const Input &input, const Options &options, Job &job) {
  if (holds(mesh, input, options, job)) return true;
  forget(job.memory);
  stamp_ = stamp_of(mesh, input, options, job);
  took_contacts_ = takes_contacts(options);
  max_deviation_ = options.max_deviation;
  return false;
}

void Prepared::prepare_surface(Job &job) {
  if (!has_surface_) {
    Surface surface(job.memory);
    make_surface(original.view, boundary.triangles, job, surface);
    SurfaceTopology topology(job.memory);
    find_topology(surface.points, surface.triangles, job, topology, host_numbers(surface, original.index_base));
    surface_ = std::move(surface);
    topology_ = std::move(topology);
    has_surface_ = true;
  }
  if (!surface_has_values_) fill_surface(job);
}

void Prepared::fill_surface(Job &job) {
  const std::size_t fields = surface_.fields = original.view.fields;
  surface_.scalars.resize(fields * surface_.points.size());
  for_each(surface_.origin.size(), job, [&](std::size_t i) {
    for (std::size_t k = 0; k < fields; k++)
      surface_.scalars[i * fields + k] = original.view.scalars[std::size_t(surface_.origin[i]) * fields + k];
  });
  surface_has_values_ = true;
}

const Surface &Prepared::surface(Job &job) {
  prepare_surface(job);
  return surface_;
}

const SurfaceTopology &Prepared::topology(Job &job) {
  prepare_surface(job);
  return topology_;
}

Span<const std::int32_t> Prepared::solids(Job &job) {
  if (solids_.empty()) solids_ = solids_of_vertices(original.view, job);
  return solids_;
}

Array<std::uint8_t> Prepared::flags_of_surface(Job &job) const {
  Array<std::uint8_t> flags(&job.memory);
  if (original.flags.empty()) return flags;
  for (std::int32_t v : surface_.origin) flags.push_back(original.flags[std::size_t(v)]);
  return flags;
}

bool Prepared::Logged::holds(const DecimateOptions &of, const Fingerprint &of_values) const {
  return filled && of.lambda == options.lambda && of.clean_edges == options.clean_edges &&
         of.max_deviation == options.max_deviation && of.field_weight == options.field_weight && of_values == values;
}

DecimateReport Prepared::decimate_logged(const DecimateOptions &options, Span<const std::uint8_t> flags, Job &job,
                                         Surface &surface, bool &reused) {
  Logged &logged = options.careful ? careful_ : careless_;
  const Fingerprint values = fingerprint_of(surface_.scalars, options, job);
  DecimateReport report;
  report.edges_in = std::int64_t(topology_.mate.size() / 2);
  const std::int64_t count =
      logged.holds(options, values) ? collapses_to(options.sigma, report.edges_in, logged.log) : -1;
  reused = count >= 0;
  if (reused) {
    const MovedValues way = options.sees_fields() ? MovedValues::logged : MovedValues::along_edges;
    replay(logged.log, std::size_t(count), topology_, way, job, surface);
    report.cleaned_edges = logged.log.cleaned;
    report.edges_out = report.edges_in - 3 * count;
  } else {
    verdicts_way_ = deviation_way_ = {};
    Logged fresh(job.memory);
    report = decimate_boundary(surface, topology_, flags, options, job, fresh.log);
    fresh.options = options;
    fresh.values = values;
    fresh.filled = true;
    logged = std::move(fresh);
  }
  last_ = {options.careful, reused ? count : std::int64_t(logged.log.collapses.size())};
  return report;
}

Prepared::Decimated Prepared::decimate(const DecimateOptions &options, std::int32_t index_base, Job &job,
                                       Surface &out) {
  prepare_surface(job);
  out = surface_;
  bool reused = false;
  const Array<std::uint8_t> flags = flags_of_surface(job);
  const auto decimate = [&](Surface &surface, const DecimateOptions &way) {
    return decimate_logged(way, flags, job, surface, reused);
  };
  const DecimateReport report = decimate_and_check(out, topology_, options, index_base, job, decimate);
  return {report.cleaned_edges, reused};
}

double Prepared::deviation(TreeOnDemand &tree, const Surface &decimated, Samples samples, Job &job) {
  if (deviation_way_ != last_)
    deviation_ = largest_deviation(surface_, tree, decimated, TreeOnDemand(decimated), samples, job);
  deviation_way_ = last_;
  return deviation_;
}

SolidHistory &Prepared::history(const CollapseWay &way, Job &job) {
  history_.begin(original.view, way, job);
  return history_;
}

Span<std::uint8_t> Prepared::verdicts(double least_distance, std::int64_t leaf, Memory &memory) {
  if (verdicts_way_ != last_ || verdicts_distance_ != least_distance || verdicts_leaf_ != leaf) {
    verdicts_ = Array<std::uint8_t>(original.view.points.size(), 0, &memory);
    verdicts_way_ = last_;
    verdicts_distance_ = least_distance;
    verdicts_leaf_ = leaf;
  }
  return {verdicts_.data(), verdicts_.size()};
}

}  // namespace tetlod
