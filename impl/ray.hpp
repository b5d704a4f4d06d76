// A ray that comes along an axis to a point, and the triangles of a surface on its way: exact, and never through an
// edge.
#pragma once
#include "job.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Where the ray ends, seen from a triangle: it went past it, did not reach it, ends at it, or went through it, to its
/// inner or its outer side.
enum class RayEnd { beside, before, at, entered, left };

/// Of the ray to p along that axis, and the triangle a, b, c, whose outer side is where it is counter-clockwise.
RayEnd end_of_ray(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &p, int axis = 0);

/// How much deeper in material the ray is behind the triangle.
inline int depth_gained(RayEnd end) { return int(end == RayEnd::entered) - int(end == RayEnd::left); }

/// The ray from the side of the box to p.
inline Box ray_to(const Vec3 &p, const Box &from, int axis = 0) {
  Box ray{p, p};
  ray.low[axis] = from.low[axis];
  return ray;
}

/// The axis along which rays meet the fewest of these boxes, on the average: of parts in a row not that of the row.
/// Empty boxes do not count.
int axis_of_rays(Span<const Box> boxes, Job &job);

}  // namespace tetlod
