#include "crossing_guard.hpp"

#include <algorithm>

#include "few.hpp"
#include "predicates.hpp"
#include "ray.hpp"
#include "turned_box.hpp"

namespace tetlod {

namespace {

constexpr std::int64_t leaf = 4;

Triangle spoke_ids(const Star &star, std::size_t i) {
  return {star.centre_id, star.ring_id[i], star.ring_id[star.after(i)]};
}

/// Seen along their mean normal the spokes turn once around the centre without overlap.
bool is_flat_fan(const Star &star) {
  Vec3 up(0);
  for (const Vec3 &n : star.normal) up += n;
  const double size = length2(up);
  for (const Vec3 &n : star.normal)
    if (glm::dot(n, up) <= 1e-6 * std::sqrt(length2(n) * size)) return false;
  // How often the ring passes a ray from the centre, upward less downward.
  const Vec3 ahead = star.ring[0] - star.centre;
  const Vec3 across = glm::cross(up, ahead);
  int turns = 0;
  for (std::size_t i = 0; i < star.size(); i++) {
    const Vec3 a = star.ring[i] - star.centre, b = star.ring[star.after(i)] - star.centre;
    const bool a_left = glm::dot(a, across) >= 0, b_left = glm::dot(b, across) >= 0;
    turns += !a_left && b_left;
  }
  return turns == 1;
}

bool spokes_cross(const Star &star) {
  for (std::size_t i = 0; i < star.size(); i++) {
    const Vec3 first[3] = {star.centre, star.ring[i], star.ring[star.after(i)]};
    for (std::size_t j = 0; j < i; j++) {
      const Vec3 second[3] = {star.centre, star.ring[j], star.ring[star.after(j)]};
      if (!triangles_apart(first, spoke_ids(star, i), second, spoke_ids(star, j))) return true;
    }
  }
  return false;
}

/// What a ray to p gains by a triangle of this box.
int depth_behind(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Box &box, const Vec3 &p) {
  return overlap(box, ray_to(p, box)) ? depth_gained(end_of_ray(a, b, c, p)) : 0;
}

}  // namespace

/// A triangle of the surface, looked up once for all spokes.
struct CrossingGuard::Other {
  Vec3 point[3];
  Triangle id;
  Box box;

  Other(const CrossingGuard &surface, std::int32_t face) {
    const Triangle &t = surface.triangles_[std::size_t(face)];
    for (std::size_t k = 0; k < 3; k++) {
      point[k] = surface.points_[std::size_t(t[k])];
      id[k] = surface.id_of(t[k]);
      box.add(point[k]);
    }
  }

  bool meets_spoke(const Star &star, std::size_t i) const {
    if (!overlap(star.spoke_box[i], box)) return false;
    const Vec3 spoke[3] = {star.centre, star.ring[i], star.ring[star.after(i)]};
    return !triangles_apart(spoke, spoke_ids(star, i), point, id);
  }

  bool meets(const Star &star) const {
    for (std::size_t i = 0; i < star.size(); i++)
      if (meets_spoke(star, i)) return true;
    return false;
  }

  /// One that is none of the star's; null: there is none.
  const Vec3 *outer_corner(const Star &star) const {
    for (std::size_t k = 0; k < 3; k++)
      if (id[k] != star.centre_id && std::find(star.ring_id.begin(), star.ring_id.end(), id[k]) == star.ring_id.end())
        return &point[k];
    return nullptr;
  }
};

CrossingGuard::CrossingGuard(const Array<Vec3> &points, const Array<Triangle> &triangles, Span<const std::int32_t> id,
                             Job &job, const MayMeet &may_meet, Span<const std::int32_t> origin)
    : points_(points), triangles_(triangles), id_(id), job_(job), component_(&job.memory), tree_(job.memory) {
  if (may_meet.contacts) component_ = components_of_triangles(triangles, origin, may_meet.component, job.memory);
  may_meet_ = {may_meet.contacts, component_};
  const auto is_there = [](const Triangle &t) { return t[0] >= 0; };
  left_ = in_tree_ = std::size_t(std::count_if(triangles.begin(), triangles.end(), is_there));
  const auto box = [&](std::size_t t) { return is_there(triangles[t]) ? box_of(points, triangles[t]) : Box(); };
  tree_.build(boxes_of(triangles.size(), job, box), leaf, job);
}

bool CrossingGuard::is_passed(const Star &star) const {
  if (!is_flat_fan(star) && spokes_cross(star)) return true;
  Few<Vec3, 3 * (longest_ring + 2) + 1> before_and_after;
  before_and_after.push(star.centre);
  for (std::int32_t face : star.old_faces)
    for (std::int32_t v : triangles_[std::size_t(face)]) before_and_after.push(points_[std::size_t(v)]);
  const Box box = box_of(before_and_after);
  const TurnedBox turned_box(before_and_after);
  return tree_.any_overlap(box, [&](std::int32_t face) {
    const Other other(*this, face);
    if (turned_box.is_clear_of(other.point)) return false;
    if (std::find(star.old_faces.begin(), star.old_faces.end(), face) != star.old_faces.end()) return false;
    if (may_meet_(star.old_faces[0], face, box, other.box)) return false;
    return other.meets(star) || passes_over(star, box, other);
  });
}

/// Between the star before and after: as neither meets the triangle, all of it is if one corner is. A solid may hang on
/// the ring by an edge.
bool CrossingGuard::passes_over(const Star &star, const Box &of_both, const Other &other) const {
  const Vec3 *const p = other.outer_corner(star);
  if (!p || distance2(of_both, *p) > 0) return false;
  int depth = 0;
  for (std::int32_t face : star.old_faces) {
    const Other old(*this, face);
    depth += depth_behind(old.point[0], old.point[1], old.point[2], old.box, *p);
  }
  for (std::size_t i = 0; i < star.size(); i++)
    depth -= depth_behind(star.centre, star.ring[i], star.ring[star.after(i)], star.spoke_box[i], *p);
  return depth != 0;
}

/// The tree is made again when half of its triangles are left, or it would be mostly empty.
void CrossingGuard::move_on(const Star &star) {
  for (std::size_t i = 0; i < 2; i++) tree_.refit(star.old_faces[i], Box());
  for (std::size_t i = 0; i < star.size(); i++) tree_.refit(star.spoke_face(i), star.spoke_box[i]);
  left_ -= 2;
  if (left_ >= in_tree_ / 2) return;
  tree_.rebuild(job_);
  in_tree_ = left_;
}

}  // namespace tetlod
