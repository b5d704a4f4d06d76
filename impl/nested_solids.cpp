#include "nested_solids.hpp"

#include <cmath>

#include "extract_boundary.hpp"
#include "find_crossing.hpp"
#include "geometry.hpp"
#include "host_numbers.hpp"
#include "status.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

class Nesting {
 public:
  Nesting(const Surface &surface, const SurfaceTopology &topology, const TriangleTree &tree, Job &job)
      : surface_(surface), job_(job), widest_(std::size_t(topology.components), -1, &job.memory), tree_(tree) {
    find_widest(topology);
  }

  /// A triangle of a component that lies in another's material, and may not meet any; -1: there is none.
  std::int32_t find(const MayMeet &may_meet) const {
    Array<std::uint8_t> doubtful(widest_.size(), 0, &job_.memory);
    job_.parallel.for_blocks(widest_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; c++) doubtful[c] = !may_meet.any(widest_[c]) && !is_sound_by_ray(widest_[c]);
      job_.poll(1);
    });
    for (std::size_t c = 0; c < widest_.size(); c++)
      if (doubtful[c] && !is_sound_by_winding(widest_[c])) return widest_[c];
    return -1;
  }

 private:
  const Vec3 &point(std::int32_t triangle, std::size_t k) const {
    return surface_.points[std::size_t(surface_.triangles[std::size_t(triangle)][k])];
  }
  Vec3 normal(std::int32_t t) const { return area_vector(surface_.points, surface_.triangles[std::size_t(t)]); }
  Vec3 middle(std::int32_t t) const { return (point(t, 0) + point(t, 1) + point(t, 2)) / 3.0; }

  /// Twice the area of a triangle that rays see, positive where they come out of its material.
  double width(std::int32_t t) const { return normal(t)[tree_.axis_of_rays()]; }

  /// The triangle of each component that is the widest across rays.
  void find_widest(const SurfaceTopology &topology) {
    for (std::int32_t t = 0; t < std::int32_t(surface_.triangles.size()); t++) {
      std::int32_t &widest = widest_[std::size_t(topology.component[std::size_t(t)])];
      if (widest < 0 || std::abs(width(t)) > std::abs(width(widest))) widest = t;
    }
  }

  /// A ray to the triangle comes out of material where that is behind it, and out of none otherwise. Exact, but that
  /// the middle is rounded.
  bool is_sound_by_ray(std::int32_t triangle) const {
    return tree_.depth(middle(triangle), triangle) == int(width(triangle) > 0);
  }

  /// The winding number in the middle of a triangle is one half where material is on one side and none on the other.
  bool is_sound_by_winding(std::int32_t triangle) const {
    const Vec3 p = middle(triangle);
    double sum = 0;
    for (std::int32_t t = 0; t < std::int32_t(surface_.triangles.size()); t++)
      if (t != triangle) sum += winding_share(p, point(t, 0), point(t, 1), point(t, 2));
    job_.poll(1);
    return sum > 0 && sum < 1;
  }

  const Surface &surface_;
  Job &job_;
  Array<std::int32_t> widest_;
  const TriangleTree &tree_;
};

}  // namespace

void refuse_nested_solids(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job, const MayMeet &may_meet) {
  if (topology.components < 2) return;
  const std::int32_t t = Nesting(surface, topology, tree.get(job), job).find(may_meet);
  if (t < 0) return;
  const HostNumbers numbers = host_numbers(surface, index_base);
  const Triangle &face = surface.triangles[std::size_t(t)];
  fail(Status::mesh_intersecting,
       "solids overlap: the boundary face of vertices %lld, %lld, %lld lies in another solid", numbers.vertex(face[0]),
       numbers.vertex(face[1]), numbers.vertex(face[2]));
}

void refuse_intersections(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree,
                          std::int32_t index_base, Job &job, const MayMeet &may_meet) {
  refuse_crossing(surface, tree, index_base, job, may_meet);
  refuse_nested_solids(surface, topology, tree, index_base, job, may_meet);
}

void refuse_overlaps(const Surface &surface, const SurfaceTopology &topology, ContactsOnDemand &contacts,
                     TreeOnDemand &tree, std::int32_t index_base, Job &job) {
  MayMeet may_meet;
  if (find_crossing(surface, tree, job).first >= 0) {
    may_meet = {&contacts.get(surface, topology, tree, job), topology.component};
    refuse_crossing(surface, tree, index_base, job, may_meet);
  }
  refuse_nested_solids(surface, topology, tree, index_base, job, may_meet);
}

void refuse_unsound(const MeshView &mesh, Span<const Triangle> boundary, MayTouch may_touch, std::int32_t index_base,
                    Job &job) {
  Surface surface(job.memory);
  make_surface(mesh, boundary, job, surface);
  SurfaceTopology topology(job.memory);
  find_topology(surface.points, surface.triangles, job, topology, host_numbers(surface, index_base));
  if (may_touch == MayTouch::itself) return;
  TreeOnDemand tree(surface);
  ContactsOnDemand contacts(may_touch == MayTouch::in_contact);
  if (may_touch == MayTouch::in_contact || may_touch == MayTouch::other_solids)
    refuse_overlaps(surface, topology, contacts, tree, index_base, job);
  else
    refuse_intersections(surface, topology, tree, index_base, job);
}

bool is_sound(const MeshView &mesh, Span<const Triangle> boundary, MayTouch may_touch, Job &job) {
  try {
    refuse_unsound(mesh, boundary, may_touch, 0, job);
  } catch (const Error &error) {
    if (error.status() != Status::mesh_intersecting) throw;
    return false;
  }
  return true;
}

}  // namespace tetlod
