#include "remeshing.hpp"

#include "beside.hpp"
#include "cull_samples.hpp"
#include "describe.hpp"
#include "nested_solids.hpp"
#include "status.hpp"

namespace tetlod {

TreeOnDemand &Remeshing::tree() {
  if (!tree_) tree_.emplace(prepared_.surface(job_));
  return *tree_;
}

void Remeshing::decimate(double sigma) {
  const StageTimer timer(Stage::decimate, job_, report_);
  tree_.reset();  // the memory is wanted
  describe_boundary(prepared_.topology(job_), report_);
  const Surface &surface = prepared_.surface(job_);
  const double range = original_.range, diagonal = box_of(surface.points).diagonal();
  const double weight = as_published(options_) || !(range > 0) ? 0 : field_weight_of(report_) * diagonal / range;
  const double lambda = as_published(options_) ? options_.lambda : Options().lambda;  // of a constant field
  DecimateOptions options{sigma, lambda, options_.clean_edges, deviation_limit()};
  for (std::size_t k = 0; k < surface.fields; k++) options.field_weight[k] = weight * original_.view.scales.weighted[k];
  const Prepared::Decimated decimated = prepared_.decimate(options, input_.index_base, job_, surface_);
  report_.cleaned_edges = decimated.cleaned_edges;
  topology_ = SurfaceTopology(job_.memory);
  find_topology(surface_.points, surface_.triangles, job_, topology_);
  describe_simplified_boundary(topology_, report_);
  report_.reused_triangles = decimated.reused ? report_.boundary_triangles_out : 0;
}

/// Neither needs the other.
void Remeshing::decimate_and_sample() {
  Beside sampling(job_, [this] { select(); });
  decimate(budget_.sigma);
  sample_by([&] { sampling.finish(); });
}

void Remeshing::cull() {
  const StageTimer timer(Stage::cull, job_, report_);
  const double diagonal = box_of(surface_.points).diagonal();
  const double least = as_published(options_) ? options_.min_distance * diagonal : 0;
  samples_ = selected_;
  const Span<std::uint8_t> known = prepared_.verdicts(least, options_.boundary_leaf, job_.memory);
  const CullReport culled = cull_samples(original_.view.points, surface_, topology_, least, options_.boundary_leaf,
                                         job_, samples_, original_.flags, known);
  report_.samples_outside = culled.outside;
  report_.samples_too_near = culled.too_near;
  report_.reused_samples = culled.known;
}

void Remeshing::remesh(Worker &worker) {
  const StageTimer timer(Stage::remesh, job_, report_);
  Array<Vec3> sample_points(&job_.memory);
  sample_points.reserve(samples_.size());
  for (std::int32_t v : samples_) sample_points.push_back(original_.view.points[std::size_t(v)]);
  const auto meanwhile = [this] { measure_deviation(); };
  tetlod::remesh(surface_, sample_points, worker, job_, remeshed_, usual_points_at_once, meanwhile, ladder_);
  describe_remeshing(remeshed_.report, samples_.size(), report_);
}

void Remeshing::measure_deviation() {
  const double deviation = prepared_.deviation(tree(), surface_, samples_for(options_.max_deviation), job_);
  report_.max_deviation = deviation / original_.box.diagonal();
}

void Remeshing::reconstruct_field() {
  const StageTimer timer(Stage::values, job_, report_);
  tetlod::reconstruct_field(original_.view, boundary_, {surface_, samples_, remeshed_}, options_.tet_leaf, job_, mesh_,
                            origin_);
}

/// False: TetGen finds no way with all that is to be kept.
bool Remeshing::fill(Worker &worker) {
  cull();
  try {
    remesh(worker);
    if (!original_.flags.empty())
      kept_.refuse_lost(selected_, original_vertices({surface_, samples_, remeshed_}, job_.memory),
                        original_.index_base, job_.memory);
    return true;
  } catch (const Error &error) {
    if (error.status() != Status::remesh) throw;
    refuse_overlapping_solids();
    failure_ = error.what();
    if (job_.log) job_.log(2, error.what());
    return false;
  }
}

/// Too dear to be looked for when nothing is wrong. Of the original, whose vertices have names.
void Remeshing::refuse_overlapping_solids() {
  refuse_nested_solids(prepared_.surface(job_), prepared_.topology(job_), tree(), input_.index_base, job_);
}

void Remeshing::simplify(Worker &worker) {
  while (!fill(worker)) {
    if (budget_.sigma >= 1 || ladder_ == Ladder::first_rung) throw Error(Status::remesh, failure_);
    report_.boundary_retries++;
    budget_.sigma = less_decimated(budget_.sigma);
    decimate(budget_.sigma);
  }
}

/// What TetGen makes of so many samples is known afterwards alone: too many tets are taken back here, too few are
/// made good by refine().
void Remeshing::meet_target(Worker &worker) {
  double sigma = budget_.sigma;
  for (int round = 0; round < most_rounds; round++) {
    const double excess = double(remeshed_.tets.size()) - double(budget_.tets);
    if (excess <= 0) return;
    const std::int64_t edges = report_.boundary_edges_out;
    if (budget_.samples > 0) {
      const double surplus = (excess + spare * double(budget_.tets)) / tets_a_sample;
      budget_.samples -= std::min(budget_.samples, std::size_t(1 + surplus));
      sample();
    } else {
      sigma *= double(budget_.tets) / double(remeshed_.tets.size());
      decimate(sigma);
      if (report_.boundary_edges_out >= edges) round = most_rounds;  // the topology allows no less
    }
    if (fill(worker)) continue;
    decimate(budget_.sigma);
    return simplify(worker);
  }
}

/// TetGen cannot take those, but edges can collapse. Throws what else is wrong with the original.
bool Remeshing::has_contacts() {
  if (options_.clean_edges > 0) return false;
  const Surface &surface = prepared_.surface(job_);
  const SurfaceTopology &topology = prepared_.topology(job_);
  if (prepared_.contacts().get(surface, topology, tree(), job_).empty()) return false;
  refuse_overlaps(surface, topology, prepared_.contacts(), tree(), input_.index_base, job_);
  return true;
}

bool Remeshing::remesh_to_target(Worker &worker) {
  try {
    decimate_and_sample();
    simplify(worker);
    meet_target(worker);
  } catch (const Error &error) {
    const bool blames_boundary =
        error.status() == Status::mesh_degenerate || error.status() == Status::mesh_intersecting;
    const bool has_collapsed = ladder_ == Ladder::first_rung;  // to a sound mesh
    if (error.status() != Status::remesh && !(blames_boundary && (has_collapsed || has_contacts()))) throw;
    return false;
  }
  reconstruct_field();
  return meets_size(budget_, mesh_);
}

}  // namespace tetlod
