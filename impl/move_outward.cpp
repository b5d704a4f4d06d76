#include "move_outward.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "boundary_distances.hpp"
#include "came_from.hpp"
#include "cholesky.hpp"
#include "contact_guard.hpp"
#include "remesh_checks.hpp"
#include "star_lists.hpp"
#include "tet_frame.hpp"

namespace tetlod {

namespace {

constexpr std::size_t many = 1024;
/// Of what holds a vertex, so that nothing moves it along what is plane.
constexpr double pull = 1e-2;
/// Of the way, what is tried.
constexpr double parts_of_way[] = {1, 0.75, 0.5, 0.25};
/// What a move may leave of a field's change, as a part of the range: where the field bends or jumps, a vertex that
/// serves it goes nowhere.
constexpr double most_uneven = 0.002;

/// What original vertices say of where a vertex of the mesh should be.
struct Evidence {
  Triangular<3> a{};
  Vector<3> b{};
  Vec3 outward{0};

  /// As far along a unit vector, of some weight.
  void add(double weight, const Vec3 &direction, double distance) {
    for (std::size_t i = 0; i < 3; i++) {
      for (std::size_t j = 0; j <= i; j++) a[entry_of(i, j)] += weight * direction[int(i)] * direction[int(j)];
      b[i] += weight * distance * direction[int(i)];
    }
  }
  /// None where that is inward.
  Vec3 step() const {
    Triangular<3> pulled = a;
    for (std::size_t i = 0; i < 3; i++) pulled[entry_of(i, i)] += pull / 3 * trace<3>(a);
    const Cholesky<3> solver(pulled, 0);
    if (!solver.regular()) return Vec3(0);
    const Vector<3> x = solver.solve(b);
    const Vec3 step(x[0], x[1], x[2]);
    return glm::dot(step, outward) > 0 ? step : Vec3(0);
  }
};

std::array<double, most_fields> ranges_of(Span<const double> values, std::size_t fields) {
  std::array<double, most_fields> ranges{};
  for (std::size_t k = 0; k < fields; k++) {
    double low = values[k], high = low;
    for (std::size_t i = k; i < values.size(); i += fields) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    ranges[k] = high - low;
  }
  return ranges;
}

/// The triangles of the mesh's boundary while their corners move.
class GuardOfCorners {
 public:
  GuardOfCorners(const TetMesh &mesh, Job &job)
      : triangles_(mesh.boundary),
        contacts_(mesh.points, mesh.boundary, job),
        lists_(Span<const Triangle>(mesh.boundary), mesh.points.size(), job),
        fresh_(&job.memory) {}

  /// Whether those of vertex v, where it is now, meet others.
  bool is_met(std::int32_t v) {
    fresh_.clear();
    for (std::int32_t t : lists_.of(v)) fresh_.push_back(triangles_[std::size_t(t)]);
    return contacts_.is_met(lists_.of(v), fresh_);
  }
  void take(std::int32_t v) { contacts_.take(lists_.of(v)); }

 private:
  const Array<Triangle> &triangles_;
  ContactGuard contacts_;
  StarLists lists_;
  Array<Triangle> fresh_;
};

class OutwardMoves {
 public:
  OutwardMoves(const BoundaryMoves &by, Job &job, TetMesh &mesh)
      : by_(by),
        original_(by.original),
        job_(job),
        mesh_(mesh),
        of_rounding_(distance_of_rounding(original_)),
        room6_((1 + most_volume) * 6 * enclosed_volume(original_.points, original_.triangles).value -
               6 * enclosed_volume(mesh.points, mesh.boundary).value),
        ranges_(ranges_of(mesh.scalars, original_.fields)),
        evidence_(mesh.points.size(), Evidence(), &job.memory) {
    gather();
    if (by.are_guarded) guard_.emplace(mesh, job);
  }

  void make(Array<std::int32_t> &origin) {
    const StarLists tets(Span<const Tet>(mesh_.tets), mesh_.points.size(), job_);
    for (std::size_t v = 0; v < evidence_.size(); v++) {
      if (v % many == 0) job_.poll(1);
      const Vec3 step = evidence_[v].step();
      if (!(glm::length(step) > of_rounding_) || stays_there(v, origin, by_.stays)) continue;
      if (move(std::int32_t(v), step, tets.of(std::int32_t(v)))) origin[v] = moved_away(origin[v]);
    }
  }

 private:
  const Vec3 &point(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  double value(std::int32_t v, std::size_t field) const {
    return mesh_.scalars[std::size_t(v) * original_.fields + field];
  }

  void gather() {
    Array<std::int32_t> home(&job_.memory);
    Array<double> distance(&job_.memory);
    find_homes(original_.points, mesh_, job_, home, distance);
    farthest_ = *std::max_element(distance.begin(), distance.end());
    for (std::size_t i = 0; i < home.size(); i++) {
      if (i % many == 0) job_.poll(1);
      if (home[i] >= 0) add(original_.points[i], mesh_.boundary[std::size_t(home[i])]);
    }
  }

  void add(const Vec3 &p, const Triangle &home) {
    const TriangleInSpace triangle(mesh_.points, home);
    const Vec3 across = area_vector(triangle.a, triangle.b, triangle.c);
    const double area = glm::length(across);
    if (!(area > 0)) return;
    const Vec3 weights = triangle.weights_nearest_to(p), way = p - triangle.at(weights);
    const double distance = glm::length(way);
    const bool is_off = distance > of_rounding_;
    for (std::size_t k = 0; k < 3; k++) {
      Evidence &of_corner = evidence_[std::size_t(home[k])];
      of_corner.add(weights[int(k)], is_off ? way / distance : across / area, is_off ? distance : 0);
      of_corner.outward += weights[int(k)] / area * across;
    }
  }

  /// As far as the tets about it, the field, the distance, the volume and other triangles let it.
  bool move(std::int32_t v, const Vec3 &step, Span<const std::int32_t> star) {
    Vec3 &place = mesh_.points[std::size_t(v)];
    const Vec3 before = place;
    const Tets old = look_at(star);
    const double uneven = unevenness(step, star);
    const double least2 = std::max(flattest_part * flattest_part * old.flattest2, least_shape * least_shape);
    for (double part : parts_of_way) {
      if (!(part * uneven <= most_uneven)) continue;
      place = before + part * step;
      const Tets fresh = look_at(star);
      if (!(fresh.flattest2 > least2) || fresh.volume6 - old.volume6 > room6_) continue;
      if (by_.to_original.nearest(place).distance > farthest_ || (guard_ && guard_->is_met(v))) continue;
      if (guard_) guard_->take(v);
      room6_ -= fresh.volume6 - old.volume6;
      return true;
    }
    place = before;
    return false;
  }

  /// How differently the fields change along a step in the tets about a vertex, as a part of their ranges: no value at
  /// its end makes that good.
  double unevenness(const Vec3 &step, Span<const std::int32_t> star) const {
    double most = 0;
    for (std::size_t k = 0; k < original_.fields; k++) most = std::max(most, unevenness(k, step, star) / ranges_[k]);
    return most;
  }

  /// Of one: the root of the mean square from the mean, by volume.
  double unevenness(std::size_t field, const Vec3 &step, Span<const std::int32_t> star) const {
    double volume = 0, sum = 0, squares = 0;
    for (std::int32_t t : star) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      const Vec3 &a = point(tet[0]), &b = point(tet[1]), &c = point(tet[2]), &d = point(tet[3]);
      const double volume6 = det(a, b, c, d);
      if (!(volume6 > 0)) continue;
      const Vec3 gradient =
          TetFrame(a, b, c, d)
              .gradient(value(tet[0], field), value(tet[1], field), value(tet[2], field), value(tet[3], field));
      const double change = glm::dot(gradient, step);
      volume += volume6;
      sum += volume6 * change;
      squares += volume6 * change * change;
    }
    return std::sqrt(std::max(0.0, squares / volume - sum / volume * (sum / volume)));
  }

  struct Tets {
    double flattest2 = std::numeric_limits<double>::infinity();  // nothing where one is not positive
    double volume6 = 0;
  };

  Tets look_at(Span<const std::int32_t> star) const {
    Tets tets;
    for (std::int32_t t : star) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      const Vec3 &a = point(tet[0]), &b = point(tet[1]), &c = point(tet[2]), &d = point(tet[3]);
      const double volume6 = det(a, b, c, d);
      tets.volume6 += volume6;
      tets.flattest2 = std::min(tets.flattest2, volume6 > 0 ? shape2(a, b, c, d) : 0);
    }
    return tets;
  }

  const BoundaryMoves &by_;
  const Surface &original_;
  Job &job_;
  TetMesh &mesh_;
  double of_rounding_, room6_;              // room6_: six times the volume that may be gained
  double farthest_ = 0;                     // of an original vertex, from the mesh
  std::array<double, most_fields> ranges_;  // of the mesh's fields
  Array<Evidence> evidence_;                // of each vertex of the mesh
  std::optional<GuardOfCorners> guard_;
};

}  // namespace

void move_outward(const BoundaryMoves &by, Job &job, TetMesh &mesh, Array<std::int32_t> &origin) {
  OutwardMoves(by, job, mesh).make(origin);
}

}  // namespace tetlod
