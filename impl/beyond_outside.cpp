#include "beyond_outside.hpp"

#include "geometry.hpp"
#include "kd_tree.hpp"
#include "surface_distance.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

template <std::size_t m>
class OutsideVertices {
 public:
  OutsideVertices(const MeshView &original, double bound, Job &job, const AdaptiveMesh<m> &mesh)
      : original_(original), bound_(bound), job_(job), mesh_(mesh), probes_(&job.memory) {
    for (std::size_t i = 0; i < mesh.outside.size(); i++)
      if (mesh.outside[i]) probes_.push_back(std::int32_t(i));
  }

  Array<std::int32_t> beyond() const {
    if (probes_.empty()) return Array<std::int32_t>(&job_.memory);
    Array<std::uint8_t> is_beyond = beyond_on_boundary();
    for (const Array<std::int32_t> &of_part : beyond_in_tets())
      for (std::int32_t k : of_part) is_beyond[std::size_t(k)] = 1;
    Array<std::int32_t> vertices(&job_.memory);
    for (std::size_t k = 0; k < probes_.size(); k++)
      if (is_beyond[k]) vertices.push_back(vertex(k));
    return vertices;
  }

 private:
  std::int32_t vertex(std::size_t k) const { return mesh_.vertex_of_probe[std::size_t(probes_[k])]; }
  const Vec3 &place(std::size_t k) const { return original_.points[std::size_t(vertex(k))]; }

  bool is_beyond(std::size_t k, const Tet &t, const double w[4]) const {
    return mesh_.largest_part(mesh_.residual(t, w, mesh_.probes[std::size_t(probes_[k])])) > bound_;
  }

  Array<std::uint8_t> beyond_on_boundary() const {
    Array<Triangle> faces(&job_.memory);
    Array<std::int32_t> tet_of_face(&job_.memory);
    mesh_.find_boundary(faces, tet_of_face);
    const TriangleTree boundary(mesh_.points, faces, job_);
    Array<std::uint8_t> beyond(probes_.size(), 0, &job_.memory);
    for_each(probes_.size(), job_, [&](std::size_t k) {
      const NearestPoint at = boundary.nearest(place(k));
      const Triangle &face = faces[std::size_t(at.triangle)];
      const double w[4] = {at.weights[0], at.weights[1], at.weights[2], 0};
      beyond[k] = is_beyond(k, {face[0], face[1], face[2], face[0]}, w);
    });
    return beyond;
  }

  /// Tets stream past a tree of the vertices, which are few.
  Array<Array<std::int32_t>> beyond_in_tets() const {
    KdTree tree(job_.memory);
    Array<Box> places(&job_.memory);
    for (std::size_t k = 0; k < probes_.size(); k++) places.push_back({place(k), place(k)});
    tree.build(std::move(places), 8, job_);
    Array<Array<std::int32_t>> parts(mesh_.tets.size() / stretch + 1, &job_.memory);
    for_each(mesh_.tets.size(), job_, [&](std::size_t t) {
      if (!mesh_.alive(std::int32_t(t))) return;
      const Tet &tet = mesh_.tets[t];
      tree.any_overlap(with_rounding(box_of<4>(mesh_.points, tet)), [&](std::int32_t k) {
        double w[4];
        if (holds(tet, place(std::size_t(k)), w) && is_beyond(std::size_t(k), tet, w)) parts[t / stretch].push_back(k);
        return false;
      });
    });
    return parts;
  }

  bool holds(const Tet &t, const Vec3 &p, double w[4]) const {
    const auto corner = [&](std::size_t k) -> const Vec3 & { return mesh_.points[std::size_t(t[k])]; };
    return barycentric(p, corner(0), corner(1), corner(2), corner(3), w) &&
           std::min({w[0], w[1], w[2], w[3]}) > -out_by_rounding;
  }

  const MeshView &original_;
  double bound_;
  Job &job_;
  const AdaptiveMesh<m> &mesh_;
  Array<std::int32_t> probes_;
};

}  // namespace

template <std::size_t m>
Array<std::int32_t> beyond_outside(const MeshView &original, double bound, Job &job, const AdaptiveMesh<m> &mesh) {
  return OutsideVertices<m>(original, bound, job, mesh).beyond();
}

template Array<std::int32_t> beyond_outside(const MeshView &, double, Job &, const AdaptiveMesh<1> &);
template Array<std::int32_t> beyond_outside(const MeshView &, double, Job &, const AdaptiveMesh<2> &);
template Array<std::int32_t> beyond_outside(const MeshView &, double, Job &, const AdaptiveMesh<3> &);
template Array<std::int32_t> beyond_outside(const MeshView &, double, Job &, const AdaptiveMesh<4> &);

}  // namespace tetlod
