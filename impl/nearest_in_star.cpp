#include "nearest_in_star.hpp"

#include <algorithm>
#include <cmath>

#include "few.hpp"
#include "geometry.hpp"

namespace tetlod {

namespace {

constexpr int rounds = 40;
/// Of the size of the face across from v: tets that are lower than that, only, get no lower.
constexpr double least_height = 0.03;
/// Of a height: a plane is passed by so little that few rounds will do.
constexpr double beyond = 1.05;

/// normal . p is to be at least this.
struct HalfSpace {
  Vec3 normal{0};  ///< of length 1; 0: of a face that has none
  double least = 0;
  double lack = 0;  ///< by which p was taken along the normal in the last round

  HalfSpace() = default;
  HalfSpace(const Tet &t, std::int32_t v, Span<const Vec3> points) {
    const auto k = std::size_t(std::find(t.begin(), t.end(), v) - t.begin());
    const auto across = [&](std::size_t i) -> const Vec3 & { return points[std::size_t(t[(k + i) % 4])]; };
    const Vec3 area = glm::cross(across(2) - across(1), across(3) - across(1));
    const double area2 = glm::length(area);
    if (!(area2 > 0)) return;
    const double height = glm::dot(area, points[std::size_t(v)] - across(1)) / area2;
    normal = area / (height > 0 ? area2 : -area2);
    least = glm::dot(normal, across(1)) + std::min(std::abs(height), least_height * std::sqrt(area2));
  }
  bool has(const Vec3 &p) const { return glm::dot(normal, p) >= least; }
};

}  // namespace

bool nearest_in_star(Span<const Tet> tets, std::int32_t v, Span<const Vec3> points, Vec3 &p) {
  Few<HalfSpace, largest_cavity> spaces;
  for (const Tet &t : tets)
    if (!spaces.push(HalfSpace(t, v, points))) return false;
  const Vec3 &from = points[std::size_t(v)];
  const double asked = glm::length(p - from);
  for (int round = 0; round < rounds; round++) {
    for (HalfSpace &space : spaces) {  // [Dykstra 1983]
      p -= space.lack * space.normal;
      const double lack = space.least - glm::dot(space.normal, p);
      space.lack = std::max(lack * beyond, 0.0);
      p += space.lack * space.normal;
    }
    if (std::all_of(spaces.begin(), spaces.end(), [&](const HalfSpace &space) { return space.has(p); }))
      return glm::length(p - from) <= asked;
  }
  return false;
}

}  // namespace tetlod
