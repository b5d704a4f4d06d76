#include "ray.hpp"

#include "predicates.hpp"
#include "whole_arrays.hpp"

namespace tetlod {

namespace {

/// In the plane of the axes i and j: 1 when p is left of the line from a to b, -1 right of it. p is taken to be a
/// little further along i, and much less along j, so that it is on no line; 0 when a and b fall together.
int side(const Vec3 &a, const Vec3 &b, const Vec3 &p, int i, int j) {
  if (const int exact = turn(a, b, p, i, j)) return exact;
  if (a[j] != b[j]) return a[j] > b[j] ? 1 : -1;
  return int(a[i] < b[i]) - int(a[i] > b[i]);
}

/// Boxes, and what is seen of them along each axis, one beside another.
struct Seen {
  Box whole;
  Vec3 areas{0};

  void add(const Box &box) {
    if (!(box.low.x <= box.high.x)) return;
    whole.add(box);
    areas += areas_of(box);
  }
  void add(const Seen &other) {
    whole.add(other.whole);
    areas += other.areas;
  }
  static Vec3 areas_of(const Box &box) {
    const Vec3 extent = box.high - box.low;
    return {extent.y * extent.z, extent.z * extent.x, extent.x * extent.y};
  }
};

}  // namespace

RayEnd end_of_ray(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &p, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const int facing = side(a, b, p, i, j);
  if (facing == 0 || side(b, c, p, i, j) != facing || side(c, a, p, i, j) != facing) return RayEnd::beside;
  const int above = orientation(a, b, c, p);
  if (above == 0) return RayEnd::at;
  if (above != facing) return RayEnd::before;
  return facing < 0 ? RayEnd::entered : RayEnd::left;
}

int axis_of_rays(Span<const Box> boxes, Job &job) {
  Seen all;
  const auto add = [&](Seen &part, std::size_t i) { part.add(boxes[i]); };
  for (const Seen &part : parts_of(boxes.size(), Seen(), job, add)) all.add(part);
  const Vec3 met = all.areas / Seen::areas_of(all.whole);
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (met[k] < met[axis]) axis = k;
  return axis;
}

}  // namespace tetlod
