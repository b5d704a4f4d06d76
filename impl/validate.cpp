#include "validate.hpp"

#include <algorithm>

#include "budget.hpp"
#include "extract_boundary.hpp"
#include "face_sweep.hpp"
#include "geometry.hpp"
#include "merge_coincident.hpp"
#include "nested_solids.hpp"
#include "predicates.hpp"
#include "prepare.hpp"
#include "surface_topology.hpp"
#include "untangle.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

bool blames_the_mesh(const Error &error) {
  return error.status() >= Status::mesh_empty && error.status() <= Status::mesh_too_large;
}

class Inspector {
 public:
  Inspector(const Input &input, const Options &options, Job &job)
      : input_(input), options_(options), job_(job), base_(input.index_base) {}

  Defects inspect() {
    found_.points = input_.xyz[0].tuples;
    found_.tets = input_.tets.tuples;
    read_tets();
    read_points();
    merge();
    sweep_faces();
    look_at_tets();
    look_at_boundary();
    return found_;
  }

 private:
  /// Keeps the tets whose vertices are there, with their numbers.
  void read_tets() {
    for (std::int64_t t = 0; t < found_.tets; t++) {
      job_.poll_at(std::size_t(t), 0);
      Tet tet{};
      bool sound = true;
      for (int k = 0; k < 4; k++) {
        const std::int64_t v = input_.tets.integer(t, k);  // may be anything: compared before it is computed with
        sound = sound && v >= base_ && v < found_.points + base_;
        tet[std::size_t(k)] = sound ? std::int32_t(v - base_) : 0;
      }
      if (sound)
        keep(tet, std::int32_t(t));
      else
        add_bad(t);
    }
  }

  void add_bad(std::int64_t t) {
    found_.index.add(t + base_);
    in_bad_tet_.resize(std::size_t(found_.points), 0);
    for (int k = 0; k < 4; k++) {
      const std::int64_t v = input_.tets.integer(t, k);
      if (v >= base_ && v < found_.points + base_) in_bad_tet_[std::size_t(v - base_)] = 1;
    }
  }

  void keep(const Tet &tet, std::int32_t number) {
    tets_.push_back(tet);
    number_.push_back(number);
  }

  void read_points() {
    const auto count = std::size_t(found_.points);
    points_.resize(count);
    values_.assign(count, 0.0);
    used_ = find_used(tets_, count, job_);
    for (std::size_t v = 0; v < count; v++) {
      const std::int64_t name = std::int64_t(v) + base_;
      for (int k = 0; k < 3; k++) points_[v][k] = input_.xyz[std::size_t(k)].real(std::int64_t(v), 0);
      if (!used_[v]) {
        if (in_bad_tet_.empty() || !in_bad_tet_[v]) found_.unused.add(name);
      } else if (!is_finite(points_[v])) {
        found_.nonfinite_points.add(name);
        used_[v] = 0;
      } else if (!has_finite_values(input_, std::int64_t(v))) {
        found_.nonfinite_values.add(name);
      }
    }
  }

  /// As a run does, and for its reason.
  Box scale_used_points() {
    Box box, scaled;
    for (std::size_t v = 0; v < points_.size(); v++)
      if (used_[v]) box.add(points_[v]);
    const int exponent = extreme_exponent(box);
    for (std::size_t v = 0; v < points_.size(); v++) {
      if (!used_[v]) continue;
      if (exponent != 0) points_[v] = times_power_of_two(points_[v], -exponent);
      scaled.add(points_[v]);
    }
    return scaled;
  }

  void merge() {
    const Box box = scale_used_points();
    Array<std::int32_t> representative(&job_.memory);
    const Moves none(&job_.memory);  // whether a crack can be open is not known yet
    merge_coincident(input_, points_, tets_, used_, box, options_, job_, representative, &none);
    for (std::size_t v = 0; v < points_.size(); v++)
      if (representative[v] != std::int32_t(v)) found_.coincident.add(std::int64_t(v) + base_);
    drop_tets([&](Tet &t, std::int64_t name) {
      for (std::int32_t &v : t) {
        if (!used_[std::size_t(v)]) return true;
        v = representative[std::size_t(v)];
      }
      const bool repeated = has_repeated_vertex(t);
      if (repeated) found_.repeated.add(name);
      return repeated;
    });
  }

  /// drop(tet, name) may change the tet that it keeps.
  template <class Drop>
  void drop_tets(const Drop &drop) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tets_.size(); i++) {
      if (drop(tets_[i], std::int64_t(number_[i]) + base_)) continue;
      tets_[kept] = tets_[i];
      number_[kept++] = number_[i];
    }
    tets_.resize(kept);
    number_.resize(kept);
  }

  void look_at_tets() {
    for (std::size_t i = 0; i < tets_.size(); i++) {
      job_.poll_at(i, 0.5);
      const int sign = orientation(points_, tets_[i]);
      if (sign == 0) found_.flat.add(std::int64_t(number_[i]) + base_);
      if (sign < 0) found_.inverted.add(std::int64_t(number_[i]) + base_);
    }
  }

  /// Which tets are given twice comes first, so that the faces of the others can be judged.
  void sweep_faces() {
    Array<std::uint8_t> duplicate(tets_.size(), 0, &job_.memory);
    for_each_face_of_tets([&](const FaceUse *first, const FaceUse *last) {
      const Span<const FaceUse> uses(first, std::size_t(last - first));
      if (uses.size() == 1 || are_neighbours(uses, tets_)) return;
      const Array<std::uint8_t> again = find_given_again(uses, tets_, job_);
      for (std::size_t i = 0; i < again.size(); i++)
        if (again[i]) duplicate[uses[i].tet()] = 1;
    });
    std::size_t i = 0;
    drop_tets([&](const Tet &, std::int64_t name) {
      if (duplicate[i]) found_.duplicate.add(name);
      return duplicate[i++] != 0;
    });
    for_each_face_of_tets([&](const FaceUse *first, const FaceUse *last) {
      const std::int64_t name = std::int64_t(number_[first->tet()]) + base_;
      if (last - first == 1) found_.boundary_triangles++;
      if (last - first > 2) found_.nonmanifold_faces.add(name);
      if (last - first == 2 && overlap(first[0], first[1])) found_.overlapping.add(name);
    });
  }

  template <class Visit>
  void for_each_face_of_tets(const Visit &visit) {
    if (!tets_.empty()) for_each_face({points_, values_, tets_}, {}, job_, visit);
  }

  /// Both tets on one side of their face.
  bool overlap(const FaceUse &a, const FaceUse &b) const {
    const auto [p, q, r] = face_opposite(tets_[a.tet()], a.corner());
    const auto side_of = [&, p = p, q = q, r = r](std::int32_t v) { return orientation(points_, Tet{p, q, r, v}); };
    const int first = side_of(tip_of(a, tets_));
    return first != 0 && first == side_of(tip_of(b, tets_));
  }

  /// Only where it can be made out: a face with three tets, or a boundary that overlaps itself, has no answer here.
  void look_at_boundary() {
    if (found_.nonmanifold_faces.count || tets_.empty()) return;
    const MeshView mesh{points_, values_, tets_};
    try {
      Boundary boundary(job_.memory);
      extract_boundary(mesh, job_, boundary, {base_, {}, number_});
      Surface surface(job_.memory);
      make_surface(mesh, boundary.triangles, job_, surface);
      SurfaceTopology topology(job_.memory);
      find_topology(surface.points, surface.triangles, job_, topology, {base_, surface.origin, {}});
      found_.components = topology.components;
      found_.nonmanifold_edges = {topology.nonmanifold_edges, first_touching(surface, topology, at_nonmanifold_edge)};
      found_.nonmanifold_points = {topology.nonmanifold_points, first_touching(surface, topology, cut_apart)};
    } catch (const Error &error) {
      if (!blames_the_mesh(error)) throw;
    }
  }

  /// In that way; -1: none does.
  std::int64_t first_touching(const Surface &surface, const SurfaceTopology &topology, std::uint8_t way) const {
    std::int64_t first = -1;
    for (std::size_t i = 0; i < surface.points.size(); i++) {
      const std::int64_t vertex = surface.origin[i] + base_;
      if ((topology.touching[i] & way) != 0 && (first < 0 || vertex < first)) first = vertex;
    }
    return first;
  }

  const Input &input_;
  const Options &options_;
  Job &job_;
  std::int64_t base_;
  Defects found_;
  Array<Tet> tets_{&job_.memory};
  Array<std::int32_t> number_{&job_.memory};
  Array<Vec3> points_{&job_.memory};
  Array<double> values_{&job_.memory};
  Array<std::uint8_t> used_{&job_.memory};
  Array<std::uint8_t> in_bad_tet_{&job_.memory};  // of each point; empty: there is none
};

/// The classes that a policy governs, in the order in which they are refused.
struct Rule {
  Defect Defects::*defect;
  std::int64_t Options::*policy;
  Status status;
  const char *what;
};

constexpr Rule rules[] = {
    {&Defects::repeated, &Options::on_repeated, Status::mesh_degenerate, "tets have a vertex twice, the first is tet"},
    {&Defects::nonfinite_values, &Options::on_nonfinite, Status::mesh_nonfinite,
     "points have no finite value, the first is point"},
    {&Defects::coincident, &Options::on_coincident, Status::mesh_degenerate,
     "points coincide with an earlier one, the first is point"},
    {&Defects::duplicate, &Options::on_duplicate, Status::mesh_intersecting,
     "tets have the vertices of an earlier one, the first is tet"},
    {&Defects::flat, &Options::on_flat, Status::mesh_degenerate, "tets have no volume, the first is tet"},
    {&Defects::inverted, &Options::on_inverted, Status::mesh_degenerate, "tets are inverted, the first is tet"},
    {&Defects::overlapping, &Options::on_overlap, Status::mesh_intersecting,
     "faces have both their tets on one side, the first is of tet"},
    {&Defects::unused, &Options::on_unused, Status::mesh_degenerate, "points are in no tet, the first is point"},
};

}  // namespace

Defects find_defects(const Input &input, const Options &options, Job &job) {
  return Inspector(input, options, job).inspect();
}

Error verdict_on(const Input &input, const Options &options, const Defects &defects, Job &job) {
  try {
    check_counts(input);  // before policies: as a run does
    if (any_strict_policy(options)) refuse_defects(defects, options);
    Original original(job.memory);
    Boundary boundary(job.memory);
    prepare_with_boundary(input, options, job, original, boundary);
    refuse_moves(original, options);
    refuse_unsound(original.view, boundary.triangles,
                   takes_contacts(options) ? MayTouch::in_contact : MayTouch::nothing, input.index_base, job);
  } catch (const Error &error) {
    if (!blames_the_mesh(error)) throw;
    return error;
  }
  return Error(Status::ok, "");
}

void refuse_defects(const Defects &defects, const Options &options) {
  if (defects.index.count) return;  // whoever prepares the mesh refuses that, by its own status
  for (const Rule &rule : rules) {
    const Defect &defect = defects.*rule.defect;
    if (defect.count && options.*rule.policy == policy_error)
      fail(rule.status, "%lld %s %lld", static_cast<long long>(defect.count), rule.what,
           static_cast<long long>(defect.first));
  }
}

bool any_strict_policy(const Options &options) {
  return std::any_of(std::begin(rules), std::end(rules), [&](const Rule &rule) {
    return rule.policy != &Options::on_nonfinite && options.*rule.policy == policy_error;
  });
}

}  // namespace tetlod
