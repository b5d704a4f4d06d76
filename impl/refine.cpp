#include "refine.hpp"

#include <algorithm>

#include "adaptive_mesh.hpp"
#include "errors_outside.hpp"
#include "fill_up.hpp"
#include "fit_values.hpp"
#include "flip_tets.hpp"
#include "hold_bound.hpp"
#include "insert_vertices.hpp"
#include "move_vertices.hpp"
#include "place_probes.hpp"
#include "remove_vertices.hpp"
#include "solids.hpp"
#include "sort_by_place.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

/// What a tet must gain to be worth it, in mean errors of a tet; and where a vertex goes that was worth its tets once.
constexpr double price_of_tet = 1.33, price_of_vertex = 0.5;
/// How the price of a tet rises, sweep after sweep, while there are too many.
constexpr double dearer = 4;
constexpr int dearer_sweeps = 3;
constexpr int fit_steps = 4;
/// Probes for each tet, below which passes serve the probes alone, and what is between them suffers.
constexpr double least_probes = 1.7;

template <std::size_t m>
class Refinement {
 public:
  Refinement(const MeshView &original, const RefineOptions &options, Job &job, TetMesh &mesh)
      : original_(original), options_(options), job_(job), out_(mesh), mesh_(job.memory), report_(job.memory) {
    mesh_.points = std::move(mesh.points);
    const Values<m> *values = reinterpret_cast<const Values<m> *>(mesh.scalars.data());
    mesh_.values.assign(values, values + mesh_.points.size());
    mesh_.scales = original.scales;
    mesh_.tets = std::move(mesh.tets);
    sort_by_place(mesh_.points, mesh_.tets, job);
    first_inserted_ = mesh_.points.size();
    mesh_.kept.assign(options.kept.begin(), options.kept.end());
    mesh_.solid = std::move(mesh.solid);
    mesh_.kept.resize(mesh_.points.size(), 0);
    mesh_.connect(job);
    if (options.max_deviation > 0)
      mesh_.may_bound = [this](const Vec3 &p) { return deviation_at(p) <= options_.max_deviation; };
  }

  RefineReport run() {
    const ProbeOptions enough =
        projected(enough_probes(double(options_.tets), options_.rounds, options_.follows_field));
    place_probes(original_, enough, job_, mesh_);
    if (options_.follows_field && mean_error() > square_of_rounding()) follow_field();
    insert(options_.before_lowering - count());
    fit_values(fit_steps, job_, mesh_);
    if (mesh_.share_of_vertices < 1) place_probes(original_, every_vertex(), job_, mesh_);
    if (options_.bound > 0) {
      hold_bound_outside_too();
    } else {
      use_up_tets();
      report_.max_error = largest_outside(original_, job_, mesh_);
    }
    report_.max_error = std::max(report_.max_error, largest_error(mesh_, job_).value);
    report_.mean_square = mesh_.mean_square();
    report_.outside = double(mesh_.vertices_left_out) / double(mesh_.vertex_probes);
    count_points();
    write();
    return std::move(report_);
  }

 private:
  /// A bound is for the vertices outside, too.
  ProbeOptions projected(ProbeOptions probes) const {
    probes.project_outside = options_.bound > 0;
    return probes;
  }
  ProbeOptions every_vertex() const {
    ProbeOptions probes;
    probes.most_inner = 0;
    return projected(probes);
  }

  void follow_field() {
    if (double(mesh_.probes.size()) < least_probes * double(mesh_.count())) return move(0);
    fit_values(fit_steps, job_, mesh_);
    move(0);
    flip();
    move(0);
    for (int round = 0; round < options_.rounds; round++) {
      fit_values(fit_steps, job_, mesh_);
      const bool last = round + 1 == options_.rounds;
      if (!last) remove();
      const std::size_t first = mesh_.points.size();
      insert((options_.before_lowering - count()) / (last ? 1 : 2));
      move(first);
      flip();
      move(0);
    }
  }

  void hold_bound_outside_too() {
    report_.beyond_bound = hold_bound(options_.bound, job_, mesh_);
    if (!report_.beyond_bound.empty()) return;
    constexpr double rounding = 1e-12;  // of what is reported, over the range
    OutsideErrors errors = errors_outside(original_, (1 - rounding) * options_.bound, job_, mesh_);
    if (errors.beyond.empty()) report_.max_error = errors.largest;  // otherwise it is not the mesh's own
    report_.beyond_bound = std::move(errors.beyond);
  }

  /// What passes left of them.
  void use_up_tets() {
    if (options_.before_lowering < options_.tets) lower_largest(options_.tets, job_, mesh_);
    fill_up(options_.tets, job_, mesh_);
  }

  void move(std::size_t first) { move_vertices(first, job_, mesh_); }
  /// More faces become edges than edges faces; where that makes too many tets, a tet has to gain more.
  void flip() {
    double price = price_of_tet * std::max(mean_error(), square_of_rounding());
    flip_tets(price, job_, mesh_);
    for (int i = 0; i < dearer_sweeps && count() > options_.before_lowering; i++)
      flip_tets(price *= dearer, job_, mesh_);
  }
  void remove() { remove_vertices(price_of_vertex * mean_error(), job_, mesh_); }
  void insert(std::int64_t tets) {
    if (tets > 0) insert_vertices(tets, job_, mesh_);
  }

  std::int64_t count() const { return std::int64_t(mesh_.count()); }
  double mean_error() const { return mesh_.total_error() / double(mesh_.count()); }

  /// Of the values: errors that are no more are none, and nothing that a tet could be worth.
  double square_of_rounding() const {
    constexpr double rounding = 1e-14;
    double largest = 0;
    for (const Values<m> &values : mesh_.values) largest = std::max(largest, mesh_.square(values));
    return rounding * rounding * largest;
  }

  void count_points() {
    const std::size_t first_steiner = first_inserted_ - std::size_t(options_.steiner);
    for (std::size_t v = 0; v < mesh_.points.size(); v++) {
      const bool is_there = mesh_.tet_of[v] >= 0;
      if (v >= first_inserted_) {
        report_.inserted += is_there;
        if (!is_there || !mesh_.fixed[v]) continue;
        report_.inserted_on_boundary++;
        look_at(mesh_.points[v]);
      } else if (!is_there) {
        (v < first_steiner ? report_.removed_samples : report_.removed_steiner)++;
      }
    }
  }

  void look_at(const Vec3 &p) { report_.deviation = std::max(report_.deviation, deviation_at(p)); }
  /// From the original's boundary.
  double deviation_at(const Vec3 &p) const { return options_.boundary->get(job_).nearest(p).distance; }

  std::int32_t solid_of_point(std::size_t v, const SolidsOfTets &solids) const {
    return v < mesh_.solid.size() ? mesh_.solid[v] : solids.of(mesh_.tet_of[v]);
  }

  void write() {
    Array<std::int32_t> number(mesh_.points.size(), -1, &job_.memory);
    const SolidsOfTets solids(mesh_, original_.solid, job_);
    out_.solid.clear();
    out_.points.clear();
    out_.scalars.clear();
    out_.tets.clear();
    out_.boundary.clear();
    for (const bool boundary : {true, false})
      for (std::size_t v = 0; v < number.size(); v++) {
        if ((mesh_.fixed[v] != 0) != boundary || mesh_.tet_of[v] < 0) continue;
        number[v] = std::int32_t(out_.points.size());
        out_.points.push_back(mesh_.points[v]);
        out_.scalars.insert(out_.scalars.end(), mesh_.values[v].begin(), mesh_.values[v].end());
        if (solids.are_several()) out_.solid.push_back(solid_of_point(v, solids));
      }
    for (std::size_t t = 0; t < mesh_.tets.size(); t++) {
      job_.poll_at(t, 1);
      if (!mesh_.alive(std::int32_t(t))) continue;
      Tet tet = mesh_.tets[t];
      for (std::int32_t &v : tet) v = number[std::size_t(v)];
      for (std::size_t k = 0; k < 4; k++)
        if (mesh_.neighbours[t][k] < 0) out_.boundary.push_back(face_opposite(tet, k));
      out_.tets.push_back(tet);
    }
  }

  const MeshView &original_;
  const RefineOptions &options_;
  Job &job_;
  TetMesh &out_;
  AdaptiveMesh<m> mesh_;
  std::size_t first_inserted_ = 0;
  RefineReport report_;
};

}  // namespace

RefineReport refine(const MeshView &original, const RefineOptions &options, Job &job, TetMesh &mesh) {
  return with_fields(original.fields, [&](auto m) { return Refinement<m>(original, options, job, mesh).run(); });
}

}  // namespace tetlod
