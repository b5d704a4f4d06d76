#include "exact.hpp"

#include <algorithm>

namespace tetlod::test {

namespace {

using Integer = RationalPoint::Integer;

Integer divisor_of(Integer a, Integer b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) {
    const Integer rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

RationalPoint reduced(RationalPoint p) {
  Integer g = divisor_of(divisor_of(p.x, p.y), divisor_of(p.z, p.w));
  if (p.w < 0) g = -g;
  return {p.x / g, p.y / g, p.z / g, p.w / g};
}

/// Where the segment from p to q meets the plane, when they are on different sides of it.
RationalPoint cut(const RationalPoint &p, const RationalPoint &q, const LatticePlane &plane) {
  const Integer at_p = plane.value_at(p), at_q = plane.value_at(q);
  // In homogeneous coordinates: at_p q - at_q p lies in the plane.
  return reduced({at_p * q.x - at_q * p.x, at_p * q.y - at_q * p.y, at_p * q.z - at_q * p.z, at_p * q.w - at_q * p.w});
}

/// What of a convex polygon lies where the plane's value is not negative.
std::vector<RationalPoint> clipped(const std::vector<RationalPoint> &polygon, const LatticePlane &plane) {
  std::vector<RationalPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); i++) {
    const RationalPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Integer at_p = plane.value_at(p), at_q = plane.value_at(q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) kept.push_back(cut(p, q, plane));
  }
  return kept;
}

struct Lattice3 {
  std::int64_t x, y, z;
};

Lattice3 between(const Vec3 &from, const Vec3 &to) {
  return {std::int64_t(to.x - from.x), std::int64_t(to.y - from.y), std::int64_t(to.z - from.z)};
}

Lattice3 cross(const Lattice3 &a, const Lattice3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

LatticePlane plane_through(const Vec3 &p, const Lattice3 &n) {
  return {{n.x, n.y, n.z}, n.x * std::int64_t(p.x) + n.y * std::int64_t(p.y) + n.z * std::int64_t(p.z)};
}

LatticePlane opposite(const LatticePlane &p) { return {{-p.n[0], -p.n[1], -p.n[2]}, -p.d}; }

bool on_segment(const RationalPoint &p, const Vec3 &from, const Vec3 &to) {
  const Lattice3 e = between(from, to);
  const Integer dx = p.x - Integer(std::int64_t(from.x)) * p.w, dy = p.y - Integer(std::int64_t(from.y)) * p.w,
                dz = p.z - Integer(std::int64_t(from.z)) * p.w;
  if (dy * e.z != dz * e.y || dz * e.x != dx * e.z || dx * e.y != dy * e.x) return false;
  if (from == to) return dx == 0 && dy == 0 && dz == 0;
  const Integer ahead = dx * e.x + dy * e.y + dz * e.z, whole = e.x * e.x + e.y * e.y + e.z * e.z;
  return ahead >= 0 && ahead <= whole * p.w;
}

}  // namespace

std::vector<RationalPoint> common_part(const Vec3 *first, const Vec3 *second) {
  const Lattice3 normal = cross(between(first[0], first[1]), between(first[0], first[2]));
  const LatticePlane plane = plane_through(first[0], normal);
  std::vector<RationalPoint> part;
  for (int k = 0; k < 3; k++) part.push_back(RationalPoint::of(second[k]));
  part = clipped(clipped(part, plane), opposite(plane));
  for (int k = 0; k < 3; k++)
    part = clipped(part, plane_through(first[k], cross(normal, between(first[k], first[(k + 1) % 3]))));
  return part;
}

bool brute_apart(const Vec3 *first, const Triangle &first_ids, const Vec3 *second, const Triangle &second_ids) {
  std::vector<Vec3> shared;
  for (std::size_t k = 0; k < 3; k++)
    if (std::count(second_ids.begin(), second_ids.end(), first_ids[k])) shared.push_back(first[k]);
  const std::vector<RationalPoint> part = common_part(first, second);
  if (shared.size() == 3) return false;
  return std::all_of(part.begin(), part.end(), [&](const RationalPoint &p) {
    if (shared.empty()) return false;
    return on_segment(p, shared.front(), shared.back());
  });
}

}  // namespace tetlod::test
