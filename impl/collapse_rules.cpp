#include "collapse_rules.hpp"

#include <algorithm>

namespace tetlod {

namespace {

constexpr double least_cos_of_turn = 0.2;   // 78 degrees
constexpr double least_cos_of_fold = -0.9;  // a dihedral angle of 26 degrees
constexpr double sliver_quality = 0.1;

bool cos_below(const Vec3 &a, const Vec3 &b, double limit) {
  return glm::dot(a, b) < limit * std::sqrt(length2(a) * length2(b));
}

/// Of the angles between normals of neighbours, which may be those of the spokes or of what they replace.
double least_cos(const Star &star, Span<const Vec3> normal) {
  const auto cos = [](const Vec3 &a, const Vec3 &b) { return glm::dot(a, b) / std::sqrt(length2(a) * length2(b)); };
  double least = 1;
  for (std::size_t i = 0; i < star.size(); i++)
    least = std::min({least, cos(normal[i], normal[star.after(i)]), cos(normal[i], star.outer_normal[i])});
  return least;
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

bool pinches_ring(const Star &star) {
  for (std::size_t i = 0; i < star.size(); i++)
    for (std::size_t j = 0; j < i; j++)
      if (star.ring_id[i] == star.ring_id[j]) return true;
  return false;
}

bool strays(const Star &star, const Vec3 &end, const Vec3 &other_end, double most) {
  Box around;
  around.add(end);
  around.add(other_end);
  for (const Vec3 &p : star.ring) around.add(p);
  return distance2(around, star.centre) > most * most * length2(around.high - around.low);
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

bool sharpens(const Star &star, double kept) {
  return folds(star) && 1 + least_cos(star, star.normal) < kept * kept * (1 + least_cos(star, star.old_normal));
}

bool makes_sliver(const Star &star, double kept) {
  const double least = std::min(sliver_quality, kept * star.old_quality);
  for (std::size_t i = 0; i < star.size(); i++)
    if (triangle_quality(star.centre, star.ring[i], star.ring[star.after(i)]) < least) return true;
  return false;
}

}  // namespace tetlod
