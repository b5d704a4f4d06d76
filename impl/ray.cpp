#include "ray.hpp"

#include "predicates.hpp"

namespace tetlod {

namespace {

/// In the plane of y and z: 1 when p is left of the line from a to b, -1 right of it. p is taken to be a little further
/// along y, and much less along z, so that it is on no line; 0 when a and b fall together.
int side(const Vec3 &a, const Vec3 &b, const Vec3 &p) {
  if (const int exact = turn(a, b, p, 1, 2)) return exact;
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  return int(a.y < b.y) - int(a.y > b.y);
}

}  // namespace

RayEnd end_of_ray(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &p) {
  const int facing = side(a, b, p);
  if (facing == 0 || side(b, c, p) != facing || side(c, a, p) != facing) return RayEnd::beside;
  const int above = orientation(a, b, c, p);
  if (above == 0) return RayEnd::at;
  if (above != facing) return RayEnd::before;
  return facing < 0 ? RayEnd::entered : RayEnd::left;
}

}  // namespace tetlod
