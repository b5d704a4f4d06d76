#include "collapse_rules.hpp"

#include <algorithm>

#include "predicates.hpp"

namespace tetlod {

namespace {

constexpr double least_cos_of_turn = 0.2;   // 78 degrees
constexpr double least_cos_of_fold = -0.9;  // a dihedral angle of 26 degrees
constexpr double sliver_quality = 0.1;

bool cos_below(const Vec3 &a, const Vec3 &b, double limit) {
  return glm::dot(a, b) < limit * std::sqrt(length2(a) * length2(b));
}

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

/// A triangle of the surface, looked up once for all spokes.
struct Other {
  Vec3 point[3];
  Triangle id;
  Box box;

  Other(const SurfaceNow &surface, std::int32_t face) {
    const Triangle &t = surface.triangles[std::size_t(face)];
    for (std::size_t k = 0; k < 3; k++) {
      point[k] = surface.points[std::size_t(t[k])];
      id[k] = surface.id[std::size_t(t[k])];
      box.add(point[k]);
    }
  }
};

bool spoke_meets(const Star &star, std::size_t i, const Other &other) {
  if (!overlap(star.spoke_box[i], other.box)) return false;
  const Vec3 spoke[3] = {star.centre, star.ring[i], star.ring[star.after(i)]};
  return !triangles_apart(spoke, spoke_ids(star, i), other.point, other.id);
}

}  // namespace

void Star::clear() {
  ring.clear();
  ring_id.clear();
  old_normal.clear();
  outer_normal.clear();
  old_faces.clear();
  normal.clear();
  spoke_box.clear();
  old_quality = 1;
}

void Star::find_spokes() {
  normal.clear();
  spoke_box.clear();
  for (std::size_t i = 0; i < size(); i++) {
    normal.push_back(area_vector(centre, ring[i], ring[after(i)]));
    spoke_box.emplace_back();
    for (const Vec3 &p : {centre, ring[i], ring[after(i)]}) spoke_box.back().add(p);
  }
}

Box Star::box() const {
  Box box;
  for (const Box &spoke : spoke_box) box.add(spoke);
  return box;
}

bool pinches_ring(const Star &star) {
  for (std::size_t i = 0; i < star.size(); i++)
    for (std::size_t j = 0; j < i; j++)
      if (star.ring_id[i] == star.ring_id[j]) return true;
  return false;
}

bool turns_too_far(const Star &star) {
  for (std::size_t i = 0; i < star.size(); i++)
    if (cos_below(star.normal[i], star.old_normal[i], least_cos_of_turn)) return true;
  return false;
}

bool folds(const Star &star) {
  for (std::size_t i = 0; i < star.size(); i++)
    if (cos_below(star.normal[i], star.normal[star.after(i)], least_cos_of_fold) ||
        cos_below(star.normal[i], star.outer_normal[i], least_cos_of_fold))
      return true;
  return false;
}

bool makes_sliver(const Star &star, double kept) {
  const double least = std::min(sliver_quality, kept * star.old_quality);
  for (std::size_t i = 0; i < star.size(); i++)
    if (triangle_quality(star.centre, star.ring[i], star.ring[star.after(i)]) < least) return true;
  return false;
}

bool crosses_surface(const Star &star, const SurfaceNow &surface) {
  if (!is_flat_fan(star) && spokes_cross(star)) return true;
  return surface.tree.any_overlap(star.box(), [&](std::int32_t face) {
    if (std::find(star.old_faces.begin(), star.old_faces.end(), face) != star.old_faces.end()) return false;
    const Other other(surface, face);
    for (std::size_t i = 0; i < star.size(); i++)
      if (spoke_meets(star, i, other)) return true;
    return false;
  });
}

}  // namespace tetlod
