#include "predicates.hpp"

#include <cfloat>
#include <cmath>
#include <limits>

#include "geometry.hpp"

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-ffast-math: what is exact here would not be, and NaN would not be found"
#endif
static_assert(FLT_EVAL_METHOD == 0, "the predicates need sums and products that are rounded to double (-mfpmath=sse)");

namespace tetlod {

namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;

/// high + low, exactly.
struct TwoDoubles {
  double high, low;
};

TwoDoubles exact_sum(double a, double b) {
  const double sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

TwoDoubles exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// A sum of doubles that do not overlap, smallest first.
class Expansion {
 public:
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; i++) {
      const TwoDoubles sum = exact_sum(value, term_[i]);
      value = sum.high;
      if (sum.low != 0) term_[kept++] = sum.low;
    }
    if (value != 0) term_[kept++] = value;
    size_ = kept;
  }
  int sign() const { return size_ == 0 ? 0 : term_[size_ - 1] > 0 ? 1 : -1; }

 private:
  double term_[200];
  int size_ = 0;
};

void add_product(Expansion &sum, const TwoDoubles &p, const TwoDoubles &q) {
  for (double a : {p.high, p.low})
    for (double b : {q.high, q.low}) {
      if (a == 0 || b == 0) continue;
      const TwoDoubles ab = exact_product(a, b);
      sum.add(ab.low);
      sum.add(ab.high);
    }
}

void add_product(Expansion &sum, const TwoDoubles &p, const TwoDoubles &q, const TwoDoubles &r) {
  for (double a : {p.high, p.low})
    for (double b : {q.high, q.low}) {
      if (a == 0 || b == 0) continue;
      const TwoDoubles ab = exact_product(a, b);
      for (double part : {ab.low, ab.high})
        for (double c : {r.high, r.low}) {
          if (part == 0 || c == 0) continue;
          const TwoDoubles abc = exact_product(part, c);
          sum.add(abc.low);
          sum.add(abc.high);
        }
    }
}

TwoDoubles negated(const TwoDoubles &a) { return {-a.high, -a.low}; }

int exact_orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  TwoDoubles u[3], v[3], w[3];
  for (int k = 0; k < 3; k++) {
    u[k] = exact_sum(b[k], -a[k]);
    v[k] = exact_sum(c[k], -a[k]);
    w[k] = exact_sum(d[k], -a[k]);
  }
  Expansion sum;
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    add_product(sum, u[i], v[j], w[k]);
    add_product(sum, negated(u[j]), v[i], w[k]);
  }
  return sum.sign();
}

int exact_turn(const Vec3 &a, const Vec3 &b, const Vec3 &c, int i, int j) {
  Expansion sum;
  add_product(sum, exact_sum(b[i], -a[i]), exact_sum(c[j], -a[j]));
  add_product(sum, negated(exact_sum(b[j], -a[j])), exact_sum(c[i], -a[i]));
  return sum.sign();
}

/// A triangle with the ids of its corners, and the two coordinates in which it shows most.
struct Corners {
  const Vec3 *point;
  const Triangle *id;
  Vec3 normal;
  int i, j;

  Corners(const Vec3 *points, const Triangle &ids)
      : point(points), id(&ids), normal(area_vector(points[0], points[1], points[2])) {
    const Vec3 n = glm::abs(normal);
    const int drop = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    i = (drop + 1) % 3;
    j = (drop + 2) % 3;
  }
  bool has(std::int32_t vertex) const { return (*id)[0] == vertex || (*id)[1] == vertex || (*id)[2] == vertex; }
  std::int32_t corner(int k) const { return (*id)[std::size_t(k)]; }
  int side(const Vec3 &p) const { return orientation(point[0], point[1], point[2], p); }
  int turn_at(int k, const Vec3 &p) const { return turn(point[k], point[(k + 1) % 3], p, i, j); }
  int winding() const { return turn(point[0], point[1], point[2], i, j); }
};

/// In the triangle's plane: a line through one of its edges, or through the segment, has them on different sides.
bool segment_misses_in_plane(const Vec3 &p, const Vec3 &q, const Corners &t) {
  const int winding = t.winding();
  if (winding == 0) return false;
  for (int k = 0; k < 3; k++)
    if (t.turn_at(k, p) == -winding && t.turn_at(k, q) == -winding) return true;
  const int s0 = turn(p, q, t.point[0], t.i, t.j);
  return s0 != 0 && turn(p, q, t.point[1], t.i, t.j) == s0 && turn(p, q, t.point[2], t.i, t.j) == s0;
}

bool segment_misses(const Vec3 &p, const Vec3 &q, const Corners &t) {
  const int p_side = t.side(p), q_side = t.side(q);
  if (p_side == 0 && q_side == 0) return segment_misses_in_plane(p, q, t);
  if (p_side == q_side) return true;
  const int s0 = orientation(p, q, t.point[0], t.point[1]), s1 = orientation(p, q, t.point[1], t.point[2]);
  if (s0 * s1 < 0) return true;
  const int s2 = orientation(p, q, t.point[2], t.point[0]);
  return s0 * s2 < 0 || s1 * s2 < 0;
}

/// A segment from the triangle's corner k meets it nowhere else.
bool segment_leaves(int k, const Vec3 &end, const Corners &t) {
  if (t.side(end) != 0) return true;
  const int winding = t.winding();
  return winding != 0 && (t.turn_at(k, end) == -winding || t.turn_at((k + 2) % 3, end) == -winding);
}

/// The edges of `a` meet `b` in common vertices at most; not for triangles with a common edge.
bool edges_miss(const Corners &a, const Corners &b) {
  for (int k = 0; k < 3; k++) {
    const int from = k, to = (k + 1) % 3;
    const bool from_common = b.has(a.corner(from)), to_common = b.has(a.corner(to));
    if (!from_common && !to_common) {
      if (!segment_misses(a.point[from], a.point[to], b)) return false;
      continue;
    }
    const std::int32_t common = a.corner(from_common ? from : to);
    const int at = b.corner(0) == common ? 0 : b.corner(1) == common ? 1 : 2;
    if (!segment_leaves(at, a.point[from_common ? to : from], b)) return false;
  }
  return true;
}

/// From p, of the plane with this normal, q is on the outer side, and so clearly that rounding has no say.
bool clearly_outside(const Vec3 &normal, const Vec3 &p, const Vec3 &q) {
  constexpr double least_sine = 1e-9;
  const double height = glm::dot(normal, q - p);
  return height > 0 && height * height > least_sine * least_sine * length2(normal) * length2(q - p);
}

/// A plane upright on an edge of `a` has `a` on one side and all of `b` but common vertices on the other: rounding
/// cannot reach that far, and most pairs are decided here, those in one plane, too.
bool upright_plane_separates(const Corners &a, const Corners &b) {
  for (int k = 0; k < 3; k++) {
    const int next = (k + 1) % 3;
    const Vec3 outward = glm::cross(a.point[next] - a.point[k], a.normal);
    bool separates = !b.has(a.corner((k + 2) % 3));
    for (int m = 0; m < 3 && separates; m++) {
      if (a.has(b.corner(m))) continue;
      separates =
          clearly_outside(outward, a.point[k], b.point[m]) && clearly_outside(outward, a.point[next], b.point[m]);
    }
    if (separates) return true;
  }
  return false;
}

/// All of `b` but common vertices is on one side of the plane of `a`, so clearly that rounding has no say: of surfaces
/// that run side by side that decides soonest.
bool plane_clearly_separates(const Corners &a, const Corners &b) {
  Vec3 upward = a.normal;
  bool separates = true, any = false;
  for (int k = 0; k < 3 && separates; k++) {
    if (a.has(b.corner(k))) continue;
    if (!any && glm::dot(upward, b.point[k] - a.point[0]) < 0) upward = -upward;
    any = true;
    separates = clearly_outside(upward, a.point[0], b.point[k]);
  }
  return separates;
}

/// The same exactly.
bool plane_separates(const Corners &a, const Corners &b) {
  int side = 0;
  for (int k = 0; k < 3; k++) {
    if (a.has(b.corner(k))) continue;
    const int here = a.side(b.point[k]);
    if (here == 0 || here == -side) return false;
    side = here;
  }
  return true;
}

/// Two triangles at a common edge: out of plane, or on different sides of it.
bool hinge_is_open(const Corners &a, const Corners &b) {
  for (int k = 0; k < 3; k++) {
    if (a.has(b.corner(k))) continue;
    if (a.side(b.point[k]) != 0) return true;
    for (int m = 0; m < 3; m++)  // the edge of `a` that has both common vertices
      if (b.has(a.corner(m)) && b.has(a.corner((m + 1) % 3)))
        return a.winding() != 0 && a.turn_at(m, b.point[k]) == -a.winding();
  }
  return false;
}

}  // namespace

int orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  constexpr double bound = (7 + 56 * unit) * unit;
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double xy = u.x * v.y, yx = u.y * v.x, yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z;
  const double value = (yz - zy) * w.x + (zx - xz) * w.y + (xy - yx) * w.z;
  const double size = (std::abs(yz) + std::abs(zy)) * std::abs(w.x) + (std::abs(zx) + std::abs(xz)) * std::abs(w.y) +
                      (std::abs(xy) + std::abs(yx)) * std::abs(w.z);
  const double doubt = bound * size;
  if (value > doubt) return 1;
  if (value < -doubt) return -1;
  return size == 0 ? 0 : exact_orientation(a, b, c, d);
}

int turn(const Vec3 &a, const Vec3 &b, const Vec3 &c, int i, int j) {
  constexpr double bound = (3 + 16 * unit) * unit;
  const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]);
  const double value = left - right, size = std::abs(left) + std::abs(right), doubt = bound * size;
  if (value > doubt) return 1;
  if (value < -doubt) return -1;
  return size == 0 ? 0 : exact_turn(a, b, c, i, j);
}

bool triangles_apart(const Vec3 *first, const Triangle &first_ids, const Vec3 *second, const Triangle &second_ids) {
  const Corners a(first, first_ids), b(second, second_ids);
  int common = 0;
  for (std::int32_t id : first_ids) common += b.has(id);
  if (common == 3) return false;
  if (plane_clearly_separates(a, b) || plane_clearly_separates(b, a)) return true;
  if (upright_plane_separates(a, b) || (common < 2 && upright_plane_separates(b, a))) return true;
  if (common == 2) return hinge_is_open(a, b);
  return plane_separates(a, b) || plane_separates(b, a) || (edges_miss(a, b) && edges_miss(b, a));
}

}  // namespace tetlod
