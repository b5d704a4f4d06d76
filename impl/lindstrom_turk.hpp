// 3.2  Placement and cost of an edge collapse after Lindstrom and Turk, "Fast and Memory Efficient Polygonal
// Simplification" (1998), as the paper combines them: volume preservation as a constraint, volume and shape
// optimization coupled under it, shape optimization alone where that has no answer.
//
// Every triangle t of the collapse gives a tet with the new vertex x, of six times the volume n_t . x - d_t, where n_t
// is twice the area vector and d_t = n_t . p. So the sums below are all that placement needs, and they are kept per
// vertex: an edge costs a few additions however many triangles surround it.
#pragma once

#include "geometry.hpp"

namespace tetlod {

struct TrianglePlane {
  Vec3 normal{0};     // n_t
  double offset = 0;  // d_t
};

inline TrianglePlane plane_of(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const Vec3 normal = area_vector(a, b, c);
  return {normal, glm::dot(normal, a)};
}

/// Sums over the triangles around a vertex.
struct VolumeSums {
  Vec3 normal{0};                                         // of n
  double offset = 0;                                      // of d
  Vec3 weighted{0};                                       // of d n
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  // of n n^T

  void add(const TrianglePlane &p, double sign = 1) {
    const Vec3 n = p.normal, s = sign * n;
    normal += s;
    offset += sign * p.offset;
    weighted += p.offset * s;
    xx += s.x * n.x;
    yy += s.y * n.y;
    zz += s.z * n.z;
    xy += s.x * n.y;
    yz += s.y * n.z;
    zx += s.z * n.x;
  }
  void add(const VolumeSums &o) {
    normal += o.normal;
    offset += o.offset;
    weighted += o.weighted;
    xx += o.xx;
    yy += o.yy;
    zz += o.zz;
    xy += o.xy;
    yz += o.yz;
    zx += o.zx;
  }
};

/// Sums over the vertices of a link.
struct LinkSums {
  double count = 0;
  Vec3 position{0};
  double squares = 0;

  void add(const Vec3 &p, double sign = 1) {
    count += sign;
    position += sign * p;
    squares += sign * length2(p);
  }
  void add(const LinkSums &o) {
    count += o.count;
    position += o.position;
    squares += o.squares;
  }
  /// f_s(e, v): the squared lengths of the edges from x to the link.
  double shape(const Vec3 &x) const { return squares - 2 * glm::dot(position, x) + count * length2(x); }
};

/// A symmetric positive definite 3 x 3 system by Cholesky; false when it is singular within rounding.
class SymmetricSolver {
 public:
  SymmetricSolver(const VolumeSums &s, double diagonal) {
    const double xx = s.xx + diagonal, yy = s.yy + diagonal, zz = s.zz + diagonal;
    const double least = 1e-10 * (xx + yy + zz);
    d0_ = xx;
    if (!(d0_ > least)) return;
    l10_ = s.xy / d0_;
    l20_ = s.zx / d0_;
    d1_ = yy - l10_ * s.xy;
    if (!(d1_ > least)) return;
    l21_ = (s.yz - l20_ * s.xy) / d1_;
    d2_ = zz - l20_ * s.zx - l21_ * l21_ * d1_;
    regular_ = d2_ > least;
  }
  bool regular() const { return regular_; }
  Vec3 solve(const Vec3 &b) const {
    const double y0 = b.x, y1 = b.y - l10_ * y0, y2 = b.z - l20_ * y0 - l21_ * y1;
    const double z = y2 / d2_, y = y1 / d1_ - l21_ * z, x = y0 / d0_ - l10_ * y - l20_ * z;
    return {x, y, z};
  }

 private:
  double d0_ = 0, d1_ = 0, d2_ = 0, l10_ = 0, l20_ = 0, l21_ = 0;
  bool regular_ = false;
};

/// The volume of the solid stays the same exactly on the plane normal . x = offset; it says little where the normals
/// cancel out.
inline bool volume_is_constrained(const VolumeSums &s) { return length2(s.normal) > 1e-6 * (s.xx + s.yy + s.zz); }

/// A vertex that may not move takes the place of both: the surface moves by more than a tenth of the edge.
inline bool changes_volume(const VolumeSums &s, const Vec3 &x, double length2_e) {
  const double change = glm::dot(s.normal, x) - s.offset;
  return change * change > 0.01 * length2_e * (s.xx + s.yy + s.zz);
}

inline Vec3 optimize_shape(const VolumeSums &volume, const LinkSums &link) {
  const Vec3 centre = link.position / link.count;
  if (!volume_is_constrained(volume)) return centre;
  return centre + volume.normal * ((volume.offset - glm::dot(volume.normal, centre)) / length2(volume.normal));
}

/// Where the edge of squared length `length2_e` collapses to. Volumes are of the third power of a length and shape of
/// the first, so w_s(e) = lambda L(e)^2 is taken with volumes measured in units of L(e), which makes the result the
/// same at every scale.
inline Vec3 place_vertex(const VolumeSums &volume, const LinkSums &link, double length2_e, double lambda) {
  const double weight = lambda * length2_e * length2_e;
  const SymmetricSolver solver(volume, weight * link.count);
  if (!solver.regular()) return optimize_shape(volume, link);
  const Vec3 free = solver.solve(volume.weighted + weight * link.position);
  if (!volume_is_constrained(volume)) return free;
  const Vec3 pull = solver.solve(volume.normal);
  return free + pull * ((volume.offset - glm::dot(volume.normal, free)) / glm::dot(volume.normal, pull));
}

/// f_c(e, v) = f_s(e, v) L(e)^2
inline double collapse_cost(const LinkSums &link, const Vec3 &x, double length2_e) { return link.shape(x) * length2_e; }

}  // namespace tetlod
