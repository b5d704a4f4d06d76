#include "find_crossing.hpp"

#include <array>

#include "first_culprit.hpp"
#include "host_numbers.hpp"
#include "predicates.hpp"
#include "status.hpp"
#include "surface_distance.hpp"
#include "surface_topology.hpp"
#include "turned_box.hpp"

namespace tetlod {

namespace {

constexpr std::size_t block = 256;

std::array<Vec3, 3> corners(const Surface &surface, std::int32_t triangle) {
  const Triangle &t = surface.triangles[std::size_t(triangle)];
  return {surface.points[std::size_t(t[0])], surface.points[std::size_t(t[1])], surface.points[std::size_t(t[2])]};
}

/// One that others may cross: what is known of it is found once.
class Candidate {
 public:
  Candidate(const Surface &surface, std::int32_t triangle)
      : surface_(surface),
        triangle_(triangle),
        corners_(corners(surface, triangle)),
        box_({corners_.data(), corners_.size()}) {}

  bool is_crossed_by(std::int32_t other) const {
    const std::array<Vec3, 3> second = corners(surface_, other);
    return !box_.is_clear_of(second.data()) &&
           !triangles_apart(corners_.data(), surface_.triangles[std::size_t(triangle_)], second.data(),
                            surface_.triangles[std::size_t(other)]);
  }

 private:
  const Surface &surface_;
  std::int32_t triangle_;
  std::array<Vec3, 3> corners_;
  TurnedBox box_;
};

/// What the host calls the corners of a triangle.
std::array<long long, 3> names(const Surface &surface, std::int32_t triangle, const HostNumbers &numbers) {
  const Triangle &t = surface.triangles[std::size_t(triangle)];
  return {numbers.vertex(t[0]), numbers.vertex(t[1]), numbers.vertex(t[2])};
}

/// Whether two triangles are of one solid, or cavity.
bool hang_together(const Surface &surface, std::int32_t a, std::int32_t b, const HostNumbers &numbers, Job &job) {
  SurfaceTopology topology(job.memory);
  find_topology(surface.points, surface.triangles, job, topology, numbers);
  return topology.component[std::size_t(a)] == topology.component[std::size_t(b)];
}

}  // namespace

std::pair<std::int32_t, std::int32_t> find_crossing(const Surface &surface, TreeOnDemand &tree_of_it, Job &job,
                                                    const MayMeet &may_meet) {
  const TriangleTree &tree = tree_of_it.get(job);
  const std::size_t triangles = surface.triangles.size();
  const auto none = std::int32_t(triangles);
  const auto box = [&](std::int32_t t) { return box_of(surface.points, surface.triangles[std::size_t(t)]); };
  const auto first_partner = [&](std::size_t t) {
    std::int32_t first = none;
    const auto self = std::int32_t(t);
    const Candidate candidate(surface, self);
    tree.for_near(self, [&](std::int32_t other) {
      if (other > self && other < first && candidate.is_crossed_by(other) &&
          !may_meet(self, other, box(self), box(other)))
        first = other;
    });
    return first;
  };
  FirstCulprit culprit;
  job.parallel.for_blocks(triangles, block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end && t < culprit.index(); t++) {
      if (t % 8 == 0) job.poll(double(t) / double(triangles));
      if (first_partner(t) != none) culprit.report(t);
    }
  });
  if (!culprit.any()) return {-1, -1};
  return {std::int32_t(culprit.index()), first_partner(culprit.index())};
}

void refuse_crossing(const Surface &surface, TreeOnDemand &tree, std::int32_t index_base, Job &job,
                     const MayMeet &may_meet) {
  const auto [a, b] = find_crossing(surface, tree, job, may_meet);
  if (a < 0) return;
  const HostNumbers numbers = host_numbers(surface, index_base);
  const std::array<long long, 3> first = names(surface, a, numbers), second = names(surface, b, numbers);
  fail(Status::mesh_intersecting, "%s of vertices %lld, %lld, %lld and of vertices %lld, %lld, %lld meet",
       hang_together(surface, a, b, numbers, job)
           ? "the boundary crosses or touches itself: its faces"
           : "components of the boundary cross or touch, as of solids in contact: their faces",
       first[0], first[1], first[2], second[0], second[1], second[2]);
}

}  // namespace tetlod
