#include "pipeline.hpp"

#include <chrono>
#include <cstring>

#include "cull_samples.hpp"
#include "extract_boundary.hpp"
#include "geometry.hpp"
#include "interpolate.hpp"
#include "prepare.hpp"
#include "sample_interior.hpp"
#include "surface_topology.hpp"

namespace tetlod {

namespace {

/// The seconds of a stage are those that a StageTimer of it lives.
class StageTimer {
 public:
  StageTimer(Stage stage, Job &job, Report &report) : seconds_(report.seconds[std::size_t(stage)]) { job.enter(stage); }
  ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  StageTimer(const StageTimer &) = delete;
  StageTimer &operator=(const StageTimer &) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double &seconds_;
  Clock::time_point begin_ = Clock::now();
};

class Pipeline {
 public:
  Pipeline(const Input &input, const Options &options, Worker &worker, Job &job, Result &result)
      : input_(input), options_(options), worker_(worker), job_(job), mesh_(result.mesh), report_(result.report) {}

  void run() {
    prepare();
    extract();
    decimate();
    sample();
    cull();
    remesh();
    reconstruct_field();
  }

 private:
  void prepare() {
    const StageTimer timer(Stage::prepare, job_, report_);
    prepare_original(input_, options_.merge_tolerance, job_, original_);
    report_.points_in = input_.xyz[0].tuples;
    report_.tets_in = input_.tets.tuples;
    report_.merged_points = original_.merged_points;
    report_.dropped_tets = original_.dropped_tets;
    report_.scalar_min = original_.scalar_min;
    report_.scalar_max = original_.scalar_max;
  }

  void extract() {
    const StageTimer timer(Stage::boundary, job_, report_);
    extract_boundary(original_.view, job_, boundary_);
    make_surface(original_.view, boundary_.triangles, job_, surface_);
    report_.dropped_tets += boundary_.flat_tets;
    report_.unused_points = boundary_.unused_points - report_.merged_points;
    report_.interior_points_in = std::int64_t(boundary_.interior.size());
    report_.boundary_triangles_in = std::int64_t(boundary_.triangles.size());
  }

  void decimate() {
    const StageTimer timer(Stage::decimate, job_, report_);
    {
      SurfaceTopology topology(job_.memory);
      find_topology(surface_.points, surface_.triangles, job_, topology);
      report_.boundary_points_in = topology.used_points;
      report_.boundary_edges_in = topology.edges;
      report_.components = topology.components;
      report_.nonmanifold_edges = topology.nonmanifold_edges;
      report_.nonmanifold_points = topology.nonmanifold_points;
      const DecimateOptions options{options_.sigma, options_.lambda, options_.clean_edges};
      report_.cleaned_edges = decimate_boundary(surface_, topology, {}, options, job_).cleaned_edges;
    }
    find_topology(surface_.points, surface_.triangles, job_, topology_);
    report_.boundary_points_out = topology_.used_points;
    report_.boundary_edges_out = topology_.edges;
    report_.boundary_triangles_out = std::int64_t(surface_.triangles.size());
  }

  void sample() {
    const StageTimer timer(Stage::sample, job_, report_);
    const double variation = options_.rho * (original_.scalar_max - original_.scalar_min);
    sample_interior(original_.view, {boundary_.interior.data(), boundary_.interior.size()}, variation, job_, samples_);
    report_.selected_samples = std::int64_t(samples_.size());
  }

  void cull() {
    const StageTimer timer(Stage::cull, job_, report_);
    Box box;
    for (const Vec3 &p : surface_.points) box.add(p);
    const double diagonal = glm::length(box.high - box.low);
    const CullReport culled = cull_samples(original_.view.points, surface_, topology_, options_.min_distance * diagonal,
                                           options_.boundary_leaf, job_, samples_);
    report_.samples_outside = culled.outside;
    report_.samples_too_near = culled.too_near;
  }

  void remesh() {
    const StageTimer timer(Stage::remesh, job_, report_);
    Array<Vec3> sample_points(&job_.memory);
    sample_points.reserve(samples_.size());
    for (std::int32_t v : samples_) sample_points.push_back(original_.view.points[std::size_t(v)]);
    tetlod::remesh(surface_, sample_points, worker_, job_, remeshed_);
    report_.samples = std::int64_t(samples_.size()) - remeshed_.report.dropped_samples;
    report_.steiner_points = remeshed_.report.steiner_points;
    report_.remesh_attempts = remeshed_.report.attempts;
    report_.worker_peak_bytes = remeshed_.report.worker_peak_bytes;
  }

  void reconstruct_field() {
    const StageTimer timer(Stage::values, job_, report_);
    mesh_.scalars.reserve(remeshed_.points.size());
    std::size_t first_steiner = remeshed_.points.size();
    for (std::size_t i = 0; i < remeshed_.points.size() && first_steiner > i; i++) {
      const std::int32_t origin = remeshed_.origin[i];
      if (origin < 0)
        first_steiner = i;
      else
        mesh_.scalars.push_back(known_value(std::size_t(origin)));
    }
    Array<double> values(&job_.memory);
    const Span<const Vec3> steiner{remeshed_.points.data() + first_steiner, remeshed_.points.size() - first_steiner};
    interpolate(original_.view, boundary_.triangles, steiner, options_.tet_leaf, job_, values);
    mesh_.scalars.insert(mesh_.scalars.end(), values.begin(), values.end());
    mesh_.points = std::move(remeshed_.points);
    mesh_.tets = std::move(remeshed_.tets);
    mesh_.boundary = std::move(surface_.triangles);
    report_.points_out = std::int64_t(mesh_.points.size());
    report_.tets_out = std::int64_t(mesh_.tets.size());
  }

  double known_value(std::size_t origin) const {
    const std::size_t boundary = surface_.points.size();
    return origin < boundary ? surface_.scalars[origin]
                             : original_.view.scalars[std::size_t(samples_[origin - boundary])];
  }

  const Input &input_;
  const Options &options_;
  Worker &worker_;
  Job &job_;
  TetMesh &mesh_;
  Report &report_;
  Original original_{job_.memory};
  Boundary boundary_{job_.memory};
  Surface surface_{job_.memory};           // the original boundary, then the simplified one
  SurfaceTopology topology_{job_.memory};  // of the simplified boundary
  Array<std::int32_t> samples_{&job_.memory};
  RemeshResult remeshed_{job_.memory};
};

/// Of the bytes, eight at a time.
class Hash {
 public:
  template <class T>
  void add(const Array<T> &array) {
    const auto *bytes = reinterpret_cast<const unsigned char *>(array.data());
    const std::size_t size = array.size() * sizeof(T);
    mix(size);
    for (std::size_t i = 0; i < size; i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i, std::min<std::size_t>(8, size - i));
      mix(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15u;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value_ = 0x51ed270b0a1f39c1u;
};

std::uint64_t hash_of(const TetMesh &mesh) {
  Hash hash;
  hash.add(mesh.points);
  hash.add(mesh.scalars);
  hash.add(mesh.tets);
  return hash.value();
}

}  // namespace

void run(const Input &input, const Options &options, Worker &worker, Job &job, Result &result) {
  const auto begin = std::chrono::steady_clock::now();
  Pipeline(input, options, worker, job, result).run();
  result.report.hash = hash_of(result.mesh);
  result.report.peak_bytes = job.memory.peak();
  result.report.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace tetlod
