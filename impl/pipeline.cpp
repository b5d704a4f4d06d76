#include "pipeline.hpp"

#include <chrono>
#include <limits>

#include "attempts.hpp"
#include "came_from.hpp"
#include "carry_fields.hpp"
#include "decimate_solid_and_check.hpp"
#include "describe.hpp"
#include "footprint.hpp"
#include "nested_solids.hpp"
#include "refine.hpp"
#include "remeshing.hpp"
#include "scale_back.hpp"
#include "status.hpp"
#include "weigh_planes.hpp"

namespace tetlod {

namespace {

class Pipeline : private Remeshing {
 public:
  using Remeshing::Remeshing;

  void run(Worker &worker) {
    if (as_published(options_) && !options_.remesh)
      fail(Status::backend_missing, "remesh is 0, and neither target-ratio nor max-error is set");
    begin();
    refuse_spread();
    if (options_.on_overlap == policy_error)
      refuse_intersections(prepared_.surface(job_), prepared_.topology(job_), tree(), input_.index_base, job_);
    if (as_published(options_)) {
      decimate(budget_.sigma);
      simplify(worker);
      reconstruct_field();
    } else {
      run_to_target(worker);
      if (options_.max_error > 0 && report_.max_error > options_.max_error) fail_bound();
      tell_missed_size();
    }
    scale_back(original_, job_, mesh_);
    describe_size(mesh_, report_);
    describe_moves(original_, report_);
    carry();
  }

 private:
  /// Where the bound does not hold because the boundary is too coarse, one with more triangles follows.
  void run_to_target(Worker &worker) {
    for (double ratio = ratio_of(options_); !meet_budget(worker);) {
      if (budget_.enough > 0)  // as the bound decided
        ratio = std::min(ratio, double(mesh_.tets.size()) / double(report_.sound_tets()));
      if (is_whole(budget_, options_, report_)) fail_bound();
      do {  // with fewer tets than edges collapse to it would hardly be another one
        ratio *= 2;
        budget_ = has_grown() ? larger_budget(1, 1, report_) : larger_budget(ratio, budget_.sigma, report_);
      } while (budget_.tets < stuck_at_ && ratio < 1);
    }
  }

  /// False: the bound does not hold, or takes more tets than a larger budget would, which holds it, too. Before that,
  /// vertices of the boundary are restored where it is at fault.
  bool meet_budget(Worker &worker) {
    for (const Budget budget = budget_;; budget_ = budget) {
      const bool collapsed = coarsen(worker);
      refine(collapsed);
      if (collapsed || (report_.max_deviation > far_off && options_.clean_edges == 0)) weigh_planes_otherwise();
      if (collapsed && beyond_.empty()) hold_nearer();
      if (beyond_.empty()) return !has_grown() || is_whole(budget_, options_, report_);
      if (!collapsed || kept_.restorations() == most_restorations) return false;
      kept_.restore(beyond_, original_.view.points.size());
    }
  }

  /// For the bound, beyond the original.
  bool has_grown() const {
    return options_.max_error > 0 && collapses_edges(options_, report_) &&
           std::int64_t(mesh_.tets.size()) > report_.sound_tets();
  }

  /// By collapses, or from samples; where the one way leads to no sound mesh of the size, by the other, at last by
  /// collapses that fold the boundary more. Returns whether it is by collapses.
  bool coarsen(Worker &worker) {
    CoarseSolid coarse(job_.memory);
    mesh_.tets.clear();
    relaxed_from_ = 0;
    if (!collapses_edges(options_, report_)) {
      if (!remesh_in_place_of(coarse, worker) && options_.clean_edges == 0) collapse_in_place_of_remeshed(coarse);
    } else if (!collapse_edges(false, coarse)) {
      ladder_ = coarse.is_sound ? Ladder::first_rung : Ladder::whole;
      const bool serves = may_remesh(coarse) && remesh_in_place_of(coarse, worker);
      const bool may_fold = coarse.is_sound && options_.max_error == 0 && !meets_size(budget_, coarse.mesh);
      if (!serves && may_fold) attempt_in_memory(job_, [&] { fold(coarse); });
    }
    if (!coarse.is_sound && mesh_.tets.empty()) {
      if (!options_.remesh)  // who remeshes has looked at that
        refuse_overlaps(prepared_.surface(job_), prepared_.topology(job_), prepared_.contacts(), tree(),
                        input_.index_base, job_);
      throw Error(Status::remesh, failure_);
    }
    const bool collapsed = coarse.is_sound && (mesh_.tets.empty() || is_better_than_remeshed(coarse));
    if (collapsed && !coarse.wrong.empty()) stuck_at_ = std::int64_t(coarse.mesh.tets.size());
    if (collapsed) take_over(std::move(coarse));
    return collapsed;
  }

  /// Whether it led to the size, and not far off.
  bool remesh_in_place_of(const CoarseSolid &coarse, Worker &worker) {
    if (!coarse.is_sound) return remesh_to_target(worker) && report_.max_deviation <= far_off;
    bool met = false;
    if (!attempt_in_memory(job_, [&] { met = remesh_to_target(worker); })) mesh_.tets.clear();
    return met && report_.max_deviation <= far_off;
  }

  /// Long before no edge was left those that were left had become dear.
  void fold(CoarseSolid &coarse) {
    constexpr std::int64_t long_before = 2;  // times the tets
    relaxed_from_ = long_before * std::int64_t(coarse.mesh.tets.size());
    collapse_edges(true, coarse);
  }

  /// Where remeshing led to the size, but far off, that serves as well.
  void collapse_in_place_of_remeshed(CoarseSolid &coarse) {
    const auto collapse = [&] { collapse_edges(true, coarse); };
    if (mesh_.tets.empty())
      collapse();
    else
      attempt_in_memory(job_, collapse);
  }

  /// Of two of the size the nearer one, where remeshing led far off, else the smaller one.
  bool is_better_than_remeshed(const CoarseSolid &coarse) const {
    if (report_.max_deviation > far_off && meets_size(budget_, coarse.mesh) && meets_size(budget_, mesh_))
      return coarse.deviation < report_.max_deviation * original_.box.diagonal();
    return coarse.mesh.tets.size() < mesh_.tets.size();
  }

  /// Where collapses stopped before the size once, and remeshing left more tets, or found no way: it takes seconds, and
  /// hardly ever betters that for a larger budget.
  bool may_remesh(const CoarseSolid &coarse) const { return options_.remesh && (stuck_at_ == 0 || !coarse.is_sound); }

  /// Further attempts of a small mesh; the best of all is kept.
  void weigh_planes_otherwise() {
    Attempt best{std::move(mesh_), report_, score_};
    const auto attempt = [&](double planes) {
      if (!collapse_otherwise(planes)) return;
      refine(true);
      if (score_ < best.score) best = {std::move(mesh_), report_, score_};
    };
    for (double planes : weights_of_attempts(budget_, options_, report_))
      if (!attempt_in_memory(job_, [&] { attempt(planes); })) break;
    keep(std::move(best));
  }

  /// Not the last one. All have taken their time.
  void keep(Attempt &&attempt) {
    mesh_ = std::move(attempt.mesh);
    attempt.report.seconds = report_.seconds;
    report_ = attempt.report;
  }

  /// A bound alone, that is held: where the boundary is far off, it comes nearer if that takes hardly more tets.
  void hold_nearer() {
    if (budget_.enough == 0 || options_.max_deviation > 0 || report_.max_deviation <= 2 * far_off) return;
    Attempt far{std::move(mesh_), report_, score_};
    const Budget budget = budget_;
    SolidOptions options = collapse_options();
    options.max_deviation = far_off * original_.box.diagonal();
    const auto attempt = [&] {
      if (collapse_again(options)) refine(true);
    };
    const bool is_held = attempt_in_memory(job_, attempt) && !mesh_.tets.empty() && beyond_.empty();
    const bool is_small = double(mesh_.tets.size()) <= hardly_more * double(far.mesh.tets.size());
    if (is_held && is_small && report_.max_deviation < far.report.max_deviation) return;
    keep(std::move(far));
    budget_ = budget;
    beyond_.clear();
  }

  bool collapse_otherwise(double planes) {
    SolidOptions options = collapse_options();
    options.planes *= planes;
    options.is_attempt = true;
    return collapse_again(options);
  }

  bool collapse_again(const SolidOptions &options) {
    SolidHistory none(job_.memory);
    CoarseSolid coarse = collapse(options, none);
    const bool is_of_the_size = coarse.wrong.empty();
    if (is_of_the_size) take_over(std::move(coarse));
    return is_of_the_size;
  }

  /// To the budget, or to what suits the bound, where that betters `best`. False: to no sound mesh of the size.
  bool collapse_edges(bool may_relax, CoarseSolid &best) {
    describe_boundary(prepared_.topology(job_), report_);
    SolidOptions options = collapse_options();
    options.may_relax = may_relax;
    // With further attempts it would save the first alone, and take memory from the others.
    SolidHistory none(job_.memory);
    SolidHistory &history =
        weights_of_attempts(budget_, options_, report_).empty()
            ? prepared_.history({options.holds_bound, options.hasty, options.warm_start > 0, options.planes}, job_)
            : none;
    options.one_of_many = report_.reused_tets > 0 && history.is_repeated();
    CoarseSolid coarse = collapse(options, history);
    const std::string failure = coarse.wrong.empty() ? "" : "edges collapsed in vain: " + coarse.wrong;
    if (is_better(coarse, best)) best = std::move(coarse);
    if (failure.empty()) return true;
    if (job_.log && failure != failure_) job_.log(1, failure.c_str());
    if (failure_.empty()) failure_ = failure;
    return false;
  }

  SolidOptions collapse_options() const {
    SolidOptions options;
    options.tets = collapse_sizes(budget_, options_, report_).tets;
    options.enough = budget_.enough;
    options.dearest = budget_.dearest;
    options.max_deviation = deviation_limit();
    options.measured_at = samples_for(options_.max_deviation);
    options.hasty = is_hasty(options_, report_);
    options.holds_bound = options_.max_error > 0;
    if (!options.holds_bound) options.planes = planes_at_size(double(budget_.tets) / double(report_.sound_tets()));
    options.may_relax = relaxed_from_ > 0;
    options.relaxed_from = relaxed_from_;
    options.warm_start = options_.warm_start;
    options.kept = kept_.by_host();
    options.restored = kept_.restored();
    options.later = job_.memory.in_use() + bytes_to_refine(original_.view, options.tets, rounds_of(options_, report_));
    return options;
  }

  CoarseSolid collapse(const SolidOptions &options, SolidHistory &history) {
    const StageTimer timer(Stage::decimate, job_, report_);
    const OriginalSolid original{original_.view,           boundary_, prepared_.surface(job_),
                                 prepared_.topology(job_), tree(),    prepared_.contacts()};
    const std::int64_t lowered = collapse_sizes(budget_, options_, report_).lowered;
    return decimate_solid_and_check(original, options, lowered, history, job_);
  }

  void take_over(CoarseSolid &&coarse) {
    describe_collapses(coarse, original_, report_);
    in_contact_ = coarse.in_contact;
    mesh_ = std::move(coarse.mesh);
    if (budget_.enough > 0) budget_.tets = std::int64_t(mesh_.tets.size());
    origin_ = std::move(coarse.origin);
  }

  void tell_missed_size() const {
    if (!job_.log || options_.max_error > 0 || meets_size(budget_, mesh_)) return;
    job_.log(1, text("the result has %zu tets, not %lld", mesh_.tets.size(), (long long)budget_.tets).c_str());
  }

  [[noreturn]] void fail_bound() const {
    fail(Status::max_error, "%s", failed_bound(options_.max_error, beyond_, input_.index_base, report_).c_str());
  }

  /// A tree that is made anew, which a limit to the deviation asks for at once, takes less than memory that the run has
  /// not had.
  void make_room_to_refine() {
    const std::size_t wanted = bytes_to_refine(original_.view, budget_.tets, rounds_of(options_, report_));
    if (options_.max_deviation == 0 && job_.memory.in_use() + wanted > job_.memory.peak()) tree_.reset();
  }

  void refine(bool collapsed) {
    const StageTimer timer(Stage::values, job_, report_);
    make_room_to_refine();
    const bool is_original = collapsed && is_the_original(mesh_, origin_, report_);
    Array<std::uint8_t> kept = kept_.flags_of(origin_, job_.memory);
    if (is_original) kept.assign(mesh_.points.size(), keep_vertex);
    RefineOptions options;
    options.tets = budget_.tets;
    options.before_lowering = tets_before_lowering(budget_, options_, report_, collapsed, mesh_.tets.size());
    options.steiner = report_.steiner_points;
    options.follows_field = !is_original && (!collapsed || options_.effort == effort_accurate);
    options.rounds = rounds_of(options_, report_);
    options.bound = bound();
    options.kept = kept;
    options.boundary = &tree();
    options.max_deviation = deviation_limit();
    RefineReport refined(job_.memory);
    MeshView original = original_.view;
    if (collapsed && in_contact_) original.solid = prepared_.solids(job_);
    mesh_.solid = solids_of_points(original.solid);
    // A bound is looked for all the same: the sides of a slit may be nearer than weights are rounded by.
    if (options.bound > 0 || !is_original) refined = tetlod::refine(original, options, job_, mesh_);
    describe_refinement(refined, original_, report_);
    if (options_.max_deviation > 0 && refined.inserted_on_boundary > 0) measure_deviation_of_result();
    score_ = meets_size(budget_, mesh_) ? score_of(refined, original_.range, report_)
                                        : std::numeric_limits<double>::infinity();
    beyond_ = std::move(refined.beyond_bound);
  }

  /// Where edges have collapsed; empty where none is known of the original's vertices.
  Array<std::int32_t> solids_of_points(Span<const std::int32_t> of_vertices) const {
    Array<std::int32_t> solid(&job_.memory);
    if (!of_vertices.empty())
      for (const std::int32_t v : origin_) solid.push_back(of_vertices[std::size_t(came_from(v))]);
    return solid;
  }

  /// Where triangles were divided, other middles than before are samples of a limit.
  void measure_deviation_of_result() {
    Surface surface(job_.memory);
    make_surface({mesh_.points, mesh_.scalars, mesh_.tets, original_.view.fields}, mesh_.boundary, job_, surface);
    const double deviation = largest_deviation(prepared_.surface(job_), tree(), surface, TreeOnDemand(surface),
                                               samples_for(options_.max_deviation), job_);
    report_.max_deviation = deviation / original_.box.diagonal();
  }

  void carry() {
    const StageTimer timer(Stage::values, job_, report_);
    tree_.reset();  // the memory is wanted
    const Span<const std::int32_t> solids = mesh_.solid.empty() ? Span<const std::int32_t>() : prepared_.solids(job_);
    carry_fields(input_, options_, original_, solids, boundary_, job_, result_);
    split_fields(input_, job_, result_);
  }

  bool in_contact_ = false;        // solids of the mesh, as collapses left it
  std::int64_t stuck_at_ = 0;      // tets, where no edge was left to collapse; 0: the size was reached so far
  std::int64_t relaxed_from_ = 0;  // tets, from which folds may sharpen; 0: rules hold as long as they can
  double score_ = 0;               // of the last refinement
  Array<std::int32_t> beyond_{&job_.memory};  // the bound: original vertices, after the last refinement
};

/// The same result, the same number.
std::uint64_t hash_of(const TetMesh &mesh, Job &job) {
  Fingerprint bytes;
  bytes.add(Span<const Vec3>(mesh.points), job);
  bytes.add(Span<const double>(mesh.scalars), job);
  bytes.add(Span<const Tet>(mesh.tets), job);
  return bytes.number();
}

}  // namespace

void run(const Input &input, const Options &options, Worker &worker, Prepared &prepared, Job &job, Result &result) {
  const auto begin = std::chrono::steady_clock::now();
  job.makes_do = prepared.empty();
  Pipeline(input, options, prepared, job, result).run(worker);
  result.report.hash = hash_of(result.mesh, job);
  result.report.peak_bytes = job.memory.peak_of_all_tries();
  result.report.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace tetlod
