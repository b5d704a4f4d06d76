// The quadric of a vertex in space and the values of the fields that steer, kept about the vertex itself, where nothing
// cancels. A tet stands for the squared differences between values and its own linear functions, continued to the
// place; a boundary triangle for the squared distance from its plane [Garland and Zhou 2005, with errors upright].
#pragma once
#include "cholesky.hpp"
#include "geometry.hpp"

namespace tetlod {

/// Two numbers, for which the processor does each step at once.
typedef double Pair __attribute__((vector_size(16)));
constexpr Pair both(double x) { return Pair{x, x}; }

/// a + t d.
template <std::size_t n>
Vector<n> along(Vector<n> a, double t, const Vector<n> &d) {
  for (std::size_t i = 0; i < n; i++) a[i] += t * d[i];
  return a;
}

template <std::size_t n>
Vector<n> minus(const Vector<n> &a, const Vector<n> &b) {
  return along(a, -1, b);
}

template <std::size_t n>
Vec3 point_of(const Vector<n> &place) {
  return {place[0], place[1], place[2]};
}

/// d^T a d + 2 g . d at the distance d from where it is kept, beside what it is there.
template <std::size_t n>
struct LocalQuadric {
  Triangular<n> a{};
  Vector<n> g{};

  /// What it is at two distances d.
  Pair rise(const std::array<Pair, n> &d) const {
    Pair sum = both(0);
    for (std::size_t i = 0; i < n; i++) {
      Pair of_row = both(g[i]) + both(0.5 * a[entry_of(i, i)]) * d[i];
      for (std::size_t j = 0; j < i; j++) of_row += both(a[entry_of(i, j)]) * d[j];
      sum += of_row * d[i];
    }
    return sum + sum;
  }
  double rise(const Vector<n> &d) const { return 2 * dot<n>(g, d) + dot<n>(times<n>(a, d), d); }
  /// weight times (normal . d)^2.
  void add_square(const Vector<n> &normal, double weight) { add(square_of(normal, weight)); }
  /// weight times the squared distance from a plane; nothing, where its normal is none.
  void add_plane(const Vec3 &normal, double weight) {
    const double length = glm::length(normal);
    if (length > 0) add_square({normal.x / length, normal.y / length, normal.z / length}, weight);
  }
  static Triangular<n> square_of(const Vector<n> &normal, double weight) {
    Triangular<n> square;
    for (std::size_t i = 0; i < n; i++)
      for (std::size_t j = 0; j <= i; j++) square[entry_of(i, j)] = weight * normal[i] * normal[j];
    return square;
  }
  void add(const Triangular<n> &square) {
    for (std::size_t i = 0; i < a.size(); i++) a[i] += square[i];
  }
  /// The same function, kept at the distance d.
  LocalQuadric moved(const Vector<n> &d) const { return {a, along(g, 1, times<n>(a, d))}; }
  void add(const LocalQuadric &o) {
    add(o.a);
    g = along(g, 1, o.g);
  }
};

/// Where the sum of two quadrics is least along the edge between their vertices.
struct BestOfEdge {
  double t = 0;     ///< from the first vertex, 0, to the second, 1
  double cost = 0;  ///< by how much the sum is more there than at the vertices
};

/// d: from the first vertex to the second. first_stays: t is 0.
template <std::size_t n>
BestOfEdge best_of_edge(const LocalQuadric<n> &first, const LocalQuadric<n> &second, const Vector<n> &d,
                        bool first_stays) {
  double first_bend = 0, second_bend = 0;
  for (std::size_t i = 0; i < n; i++)
    for (std::size_t j = 0; j <= i; j++) {
      const double product = (i == j ? 1 : 2) * d[i] * d[j];
      first_bend += product * first.a[entry_of(i, j)];
      second_bend += product * second.a[entry_of(i, j)];
    }
  const double at_first = second_bend - 2 * dot<n>(second.g, d);
  if (first_stays) return {0, at_first};
  const double at_second = first_bend + 2 * dot<n>(first.g, d);
  const double bend = first_bend + second_bend, slope = at_second - at_first - bend;
  const double t = bend > 0 ? std::clamp(-0.5 * slope / bend, 0.0, 1.0) : 0.5;
  return {t, at_first + t * (slope + t * bend)};
}

/// A step with normal . step = offset, in space; or any.
struct StepConstraint {
  Vec3 normal{0};
  double offset = 0;
  bool holds = false;
  bool is_flat = false;  ///< whether it keeps the new vertex on one plane, with all around

  double missed_by(const Vec3 &step) const { return std::abs(offset - glm::dot(normal, step)); }
};

/// The step from where q is kept to its least, with a small pull back where it says nothing. False: rounding leaves no
/// answer.
template <std::size_t n>
bool step_to_least(const LocalQuadric<n> &q, const StepConstraint &constraint, Vector<n> &step) {
  constexpr double pull = 1e-3, least_pull = 1e-9;
  Triangular<n> a = q.a;
  double of_place = least_pull * a[entry_of(3, 3)];
  for (std::size_t i = 0; i < 3; i++) of_place += pull / 3 * a[entry_of(i, i)];
  for (std::size_t i = 0; i < 3; i++) a[entry_of(i, i)] += of_place;
  for (std::size_t i = 3; i < n; i++) a[entry_of(i, i)] *= 1 + pull;
  const Cholesky<n> solver(a, 0);
  if (!solver.regular()) return false;
  step = solver.solve(along(Vector<n>{}, -1, q.g));
  if (constraint.holds) {
    const Vector<n> normal{constraint.normal.x, constraint.normal.y, constraint.normal.z};
    const Vector<n> across = solver.solve(normal);
    step = along(step, (constraint.offset - dot<n>(normal, step)) / dot<n>(normal, across), across);
  }
  return std::all_of(step.begin(), step.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace tetlod
