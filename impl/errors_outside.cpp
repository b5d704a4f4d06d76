#include "errors_outside.hpp"

#include <algorithm>
#include <limits>

#include "boundary_tree.hpp"
#include "geometry.hpp"
#include "kd_tree.hpp"
#include "solids.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// How far apart two may find what is the same.
double rounding_of(const Array<Vec3> &points) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  double largest = 0;
  for (const Vec3 &p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return rounding * largest;
}

bool is_corner(const TetComplex &mesh, std::int32_t t, const Vec3 &p) {
  const Tet &tet = mesh.tets[std::size_t(t)];
  return std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return mesh.points[std::size_t(v)] == p; });
}

/// Vertices that counts(probe, tet, its least weight there) is true of.
template <std::size_t m, class Counts>
void add_probed(Job &job, const AdaptiveMesh<m> &mesh, const Counts &counts, Array<std::int32_t> &vertices) {
  Array<Array<std::int32_t>> parts(mesh.tets.size() / stretch + 1, &job.memory);
  for_each(mesh.tets.size(), job, [&](std::size_t i) {
    const auto t = std::int32_t(i);
    if (!mesh.alive(t)) return;
    const TetFrame frame = mesh.frame(t);
    mesh.for_probes(t, [&](std::int32_t probe) {
      double w[4];
      if (std::size_t(probe) < mesh.vertex_probes &&
          counts(probe, t, frame.weights(mesh.probes[std::size_t(probe)].point, w)))
        parts[i / stretch].push_back(mesh.vertex_of_probe[std::size_t(probe)]);
    });
  });
  for (const Array<std::int32_t> &part : parts) vertices.insert(vertices.end(), part.begin(), part.end());
}

/// Changes of the mesh have left it out of its tet: it may be in another by rounding.
bool is_left_out(double least_weight) { return least_weight <= -out_by_rounding; }

/// Vertices in tets, but on the boundary, as far as rounding goes, or left out: to another they may be outside. Where a
/// vertex of the mesh is, nobody is outside.
template <std::size_t m>
void add_those_on(const BoundaryTree &boundary, Job &job, const AdaptiveMesh<m> &mesh, Array<std::int32_t> &outside) {
  const double rounding = rounding_of(mesh.points);
  const auto counts = [&](std::int32_t probe, std::int32_t t, double least) {
    const Vec3 &p = mesh.probes[std::size_t(probe)].point;
    if (mesh.outside[std::size_t(probe)] || least > out_by_rounding || is_corner(mesh, t, p)) return false;
    return is_left_out(least) || boundary.tree.nearest(p).distance <= rounding;
  };
  add_probed(job, mesh, counts, outside);
}

template <std::size_t m>
class OutsideVertices {
 public:
  OutsideVertices(const MeshView &original, Array<std::int32_t> &&vertices, Job &job, const AdaptiveMesh<m> &mesh)
      : original_(original),
        job_(job),
        mesh_(mesh),
        vertices_(std::move(vertices)),
        solids_(mesh, original.solid, job) {}

  std::int32_t vertex(std::size_t k) const { return vertices_[k]; }

  /// Of each, at the nearest point of the boundary.
  Array<double> errors_on(const BoundaryTree &boundary) const {
    Array<double> error(vertices_.size(), 0.0, &job_.memory);
    for_each(vertices_.size(), job_, [&](std::size_t k) {
      const NearestPoint at = boundary.nearest(place(k), vertex(k), solids_);
      const Triangle &face = boundary.faces[std::size_t(at.triangle)];
      const double w[4] = {at.weights[0], at.weights[1], at.weights[2], 0};
      error[k] = error_in(k, {face[0], face[1], face[2], face[0]}, w);
    });
    return error;
  }

  /// Of each, in tets that it is out of by no more than rounding; 0: there are none. Tets stream past a tree of the
  /// vertices, which are few.
  Array<double> errors_in_tets() const {
    struct Found {
      std::int32_t k;
      double error;
    };
    KdTree tree(job_.memory);
    const auto box = [&](std::size_t k) { return Box{place(k), place(k)}; };
    tree.build(boxes_of(vertices_.size(), job_, box), 8, job_);
    Array<Array<Found>> parts(mesh_.tets.size() / stretch + 1, &job_.memory);
    for_each(mesh_.tets.size(), job_, [&](std::size_t t) {
      if (!mesh_.alive(std::int32_t(t))) return;
      const Tet &tet = mesh_.tets[t];
      tree.any_overlap(with_rounding(box_of<4>(mesh_.points, tet)), [&](std::int32_t k) {
        double w[4];
        if (!solids_.may_hold(std::int32_t(t), vertex(std::size_t(k)))) return false;
        if (holds(tet, place(std::size_t(k)), w)) parts[t / stretch].push_back({k, error_in(std::size_t(k), tet, w)});
        return false;
      });
    });
    Array<double> error(vertices_.size(), 0.0, &job_.memory);
    for (const Array<Found> &part : parts)
      for (const Found &f : part) error[std::size_t(f.k)] = std::max(error[std::size_t(f.k)], f.error);
    return error;
  }

 private:
  const Vec3 &place(std::size_t k) const { return original_.place(std::size_t(vertices_[k])); }

  double error_in(std::size_t k, const Tet &t, const double w[4]) const {
    const Values<m> &value = original_.values<m>()[std::size_t(vertices_[k])];
    return mesh_.largest_part(mesh_.residual(t, w, {place(k), value}));
  }

  bool holds(const Tet &t, const Vec3 &p, double w[4]) const {
    const auto corner = [&](std::size_t k) -> const Vec3 & { return mesh_.points[std::size_t(t[k])]; };
    return barycentric(p, corner(0), corner(1), corner(2), corner(3), w) &&
           std::min({w[0], w[1], w[2], w[3]}) > -out_by_rounding;
  }

  const MeshView &original_;
  Job &job_;
  const AdaptiveMesh<m> &mesh_;
  Array<std::int32_t> vertices_;
  SolidsOfTets solids_;
};

}  // namespace

template <std::size_t m>
OutsideErrors errors_outside(const MeshView &original, double bound, Job &job, const AdaptiveMesh<m> &mesh) {
  OutsideErrors errors{Array<std::int32_t>(&job.memory)};
  Array<std::int32_t> outside(&job.memory);
  for (std::size_t i = 0; i < mesh.outside.size(); i++)
    if (mesh.outside[i]) outside.push_back(mesh.vertex_of_probe[i]);
  const BoundaryTree boundary(mesh, job);
  add_those_on(boundary, job, mesh, outside);
  if (outside.empty()) return errors;
  const OutsideVertices<m> vertices(original, std::move(outside), job, mesh);
  const Array<double> on_boundary = vertices.errors_on(boundary), in_tets = vertices.errors_in_tets();
  for (std::size_t k = 0; k < in_tets.size(); k++) {
    if (std::max(on_boundary[k], in_tets[k]) > bound) errors.beyond.push_back(vertices.vertex(k));
    errors.largest = std::max(errors.largest, in_tets[k]);
  }
  return errors;
}

template <std::size_t m>
double largest_outside(const MeshView &original, Job &job, const AdaptiveMesh<m> &mesh) {
  Array<std::int32_t> outside(mesh.in_no_tet, &job.memory);
  const auto counts = [](std::int32_t, std::int32_t, double least) { return is_left_out(least); };
  add_probed(job, mesh, counts, outside);
  if (outside.empty()) return 0;
  const Array<double> errors = OutsideVertices<m>(original, std::move(outside), job, mesh).errors_in_tets();
  return *std::max_element(errors.begin(), errors.end());
}

template OutsideErrors errors_outside(const MeshView &, double, Job &, const AdaptiveMesh<1> &);
template double largest_outside(const MeshView &, Job &, const AdaptiveMesh<1> &);
template OutsideErrors errors_outside(const MeshView &, double, Job &, const AdaptiveMesh<2> &);
template double largest_outside(const MeshView &, Job &, const AdaptiveMesh<2> &);
template OutsideErrors errors_outside(const MeshView &, double, Job &, const AdaptiveMesh<3> &);
template double largest_outside(const MeshView &, Job &, const AdaptiveMesh<3> &);
template OutsideErrors errors_outside(const MeshView &, double, Job &, const AdaptiveMesh<4> &);
template double largest_outside(const MeshView &, Job &, const AdaptiveMesh<4> &);

}  // namespace tetlod
