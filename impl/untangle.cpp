#include "untangle.hpp"

#include <algorithm>
#include <cmath>

#include "face_sweep.hpp"
#include "geometry.hpp"
#include "numbered_tets.hpp"
#include "star_lists.hpp"

namespace tetlod {

namespace {

/// Of the diagonal: so far off a boundary would be taken for another.
constexpr double farthest = 0.02;
/// What a vertex of the boundary moves, of one inside.
constexpr double inertia = 0.1;
/// Of the volume that is usual around it, what a tet that was turned over gets, and what none is flattened below; and
/// what one that was flatter gets, so that it does not turn.
constexpr double least_volume = 0.02, hardly_any = 1e-6;
constexpr int most_rounds = 100;
/// Of the tets that are turned over: where more are, it is not a mesh that was bent too far.
constexpr double most_turned = 0.1;

/// The number of an edge: of all that are run through as often either way the sum is none.
std::uint64_t number_of_edge(std::int32_t from, std::int32_t to) {
  const auto [low, high] = std::minmax(from, to);
  std::uint64_t number = (std::uint64_t(low) << 32 | std::uint32_t(high)) * 0x9e3779b97f4a7c15u;
  number = (number ^ number >> 29) * 0xbf58476d1ce4e5b9u;
  number ^= number >> 32;
  return from < to ? number : -number;
}

/// They agree which side is out.
bool are_oriented(Span<const Triangle> triangles, Job &job) {
  const auto add = [&](std::uint64_t &sum, std::size_t i) {
    const auto [a, b, c] = triangles[i];
    sum += number_of_edge(a, b) + number_of_edge(b, c) + number_of_edge(c, a);
  };
  const Array<std::uint64_t> sums = parts_of(triangles.size(), std::uint64_t(0), job, add);
  std::uint64_t sum = 0;
  for (const std::uint64_t of_part : sums) sum += of_part;
  return sum == 0;
}

/// Of the face's vertices, as they are seen from outside a positive tet, in ascending order.
bool is_even(const Tet &t, std::size_t corner) {
  const auto v = [&](int k) { return t[std::size_t(tet_face[corner][k])]; };
  return ((v(0) < v(1)) != (v(1) < v(2))) != (v(0) < v(2));
}

double volume6(Span<const Vec3> points, const Tet &t) {
  const auto at = [&](std::size_t k) -> const Vec3 & { return points[std::size_t(t[k])]; };
  return det(at(0), at(1), at(2), at(3));
}

/// Tets as their neighbours wind them: an even order of the corners is upright where most of the volume is.
class Uprights {
 public:
  Uprights(const MeshView &mesh, Job &job)
      : mesh_(mesh), job_(job), neighbours_(4 * mesh.tets.size(), -1, &job.memory), winding_(&job.memory) {
    for_each_face(mesh, {}, job, [&](const FaceUse *first, const FaceUse *last) {
      if (last - first == 2) {
        neighbours_[first[0].use] = std::int32_t(first[1].use);
        neighbours_[first[1].use] = std::int32_t(first[0].use);
      }
    });
  }

  /// Empty: there is no such order.
  Array<Tet> find() {
    Array<Tet> tets(mesh_.tets.begin(), mesh_.tets.end(), &job_.memory);
    winding_.assign(tets.size(), 0);
    for (std::size_t t = 0; t < tets.size(); t++) {
      if (winding_[t] != 0) continue;
      if (!wind_from(std::int32_t(t))) return Array<Tet>(&job_.memory);
      for (const std::int32_t of : part_)
        if (winding_[std::size_t(of)] < 0) std::swap(tets[std::size_t(of)][0], tets[std::size_t(of)][1]);
    }
    return tets;
  }

 private:
  /// All that hang together with it by faces.
  bool wind_from(std::int32_t first) {
    double volume = 0;
    part_.assign(1, first);
    winding_[std::size_t(first)] = 1;
    for (std::size_t i = 0; i < part_.size(); i++) {
      job_.poll_at(i, 0.9);
      const auto t = std::size_t(part_[i]);
      volume += winding_[t] * volume6(mesh_.points, mesh_.tets[t]);
      for (std::size_t k = 0; k < 4; k++)
        if (!wind_across(t, k)) return false;
    }
    if (volume < 0)
      for (const std::int32_t t : part_) winding_[std::size_t(t)] = std::int8_t(-winding_[std::size_t(t)]);
    return true;
  }

  bool wind_across(std::size_t t, std::size_t corner) {
    const std::int32_t beyond = neighbours_[4 * t + corner];
    if (beyond < 0) return true;
    const auto other = std::size_t(beyond / 4);
    const bool agree = is_even(mesh_.tets[t], corner) != is_even(mesh_.tets[other], std::size_t(beyond % 4));
    const auto winding = std::int8_t(agree ? winding_[t] : -winding_[t]);
    if (winding_[other] == 0) {
      winding_[other] = winding;
      part_.push_back(std::int32_t(other));
    }
    return winding_[other] == winding;
  }

  const MeshView &mesh_;
  Job &job_;
  Array<std::int32_t> neighbours_;  // of each face of each tet, that face of another, as FaceUse counts them
  Array<std::int8_t> winding_;      // 0: not known
  Array<std::int32_t> part_{&job_.memory};
};

class Untangling {
 public:
  Untangling(const Original &original, const Boundary &boundary, Array<Tet> &&upright, Job &job)
      : job_(job),
        before_(original.view.points),
        tets_(std::move(upright)),
        points_(before_.begin(), before_.end(), &job.memory),
        mobility_(points_.size(), 1.0, &job.memory),
        star_(Span<const Tet>(tets_), points_.size(), job),
        is_near_(tets_.size(), 0, &job.memory),
        moved_(points_.size(), 0, &job.memory) {
    for (const Triangle &triangle : boundary.triangles)
      for (const std::int32_t v : triangle) mobility_[std::size_t(v)] = inertia;
    for (std::size_t v = 0; v < original.flags.size(); v++)
      if (original.flags[v] != 0) mobility_[v] = 0;
  }

  /// False: that comes to no end.
  bool run() {
    for (std::size_t t = 0; t < tets_.size(); t++) {
      job_.poll_at(t, 0.9);
      if (volume6(before_, tets_[t]) < 0) add(std::int32_t(t));
    }
    if (double(near_.size()) > most_turned * double(tets_.size())) return false;
    for (int round = 0; round < most_rounds; round++) {
      if (!any_straightened()) return true;
      add_stars();
    }
    return false;
  }

  Array<Vec3> &points() { return points_; }
  std::int64_t moved() const { return std::count(moved_.begin(), moved_.end(), 1); }
  /// The farthest move, of all or on the boundary.
  double distance(bool on_boundary) const {
    double most = 0;
    for (std::size_t v = 0; v < points_.size(); v++)
      if (moved_[v] && (!on_boundary || mobility_[v] == inertia))
        most = std::max(most, glm::distance(points_[v], before_[v]));
    return most;
  }

 private:
  struct Near {
    std::int32_t tet;
    double least;  // six times the volume that it is to have
  };

  void add(std::int32_t t) {
    if (is_near_[std::size_t(t)]) return;
    is_near_[std::size_t(t)] = 1;
    near_.push_back({t, least_volume_of(t)});
  }

  double least_volume_of(std::int32_t t) {
    const double own = volume6(before_, tets_[std::size_t(t)]), usual = usual_volume_around(t);
    return own < 0 ? least_volume * usual : std::clamp(own, hardly_any * usual, least_volume * usual);
  }

  /// The median.
  double usual_volume_around(std::int32_t t) {
    around_.clear();
    for (const std::int32_t v : tets_[std::size_t(t)])
      for (const std::int32_t other : star_.of(v))
        around_.push_back(std::abs(volume6(before_, tets_[std::size_t(other)])));
    const auto middle = around_.begin() + std::ptrdiff_t(around_.size() / 2);
    std::nth_element(around_.begin(), middle, around_.end());
    return *middle;
  }

  /// One after another, so that each sees what became of those before.
  bool any_straightened() {
    bool any = false;
    for (std::size_t i = 0; i < near_.size(); i++) {
      job_.poll_at(i, 0.9);
      any |= straighten(near_[i]);
    }
    return any;
  }

  /// Gives a tet that is flatter than half of what it is to have that volume, by the least moves, as its volume changes
  /// with them at first.
  bool straighten(const Near &near) {
    const Tet &t = tets_[std::size_t(near.tet)];
    const auto at = [&](std::size_t k) -> Vec3 & { return points_[std::size_t(t[k])]; };
    const double missing = near.least - volume6(points_, t);
    if (missing <= 0.5 * near.least) return false;
    Vec3 change[4];  // of the volume, by a move
    for (std::size_t k = 0; k < 4; k++) {
      const int *face = tet_face[k];
      change[k] = -area_vector(at(std::size_t(face[0])), at(std::size_t(face[1])), at(std::size_t(face[2])));
    }
    double all = 0;
    for (std::size_t k = 0; k < 4; k++) all += mobility_[std::size_t(t[k])] * length2(change[k]);
    if (!(all > 0)) return true;
    for (std::size_t k = 0; k < 4; k++) {
      const auto v = std::size_t(t[k]);
      if (mobility_[v] == 0) continue;
      at(k) += missing * mobility_[v] / all * change[k];
      moved_[v] = 1;
      shaken_.push_back(t[k]);
    }
    return true;
  }

  /// Of the vertices that were moved.
  void add_stars() {
    for (const std::int32_t v : shaken_)
      for (const std::int32_t t : star_.of(v)) add(t);
    shaken_.clear();
  }

  Job &job_;
  Span<const Vec3> before_;
  Array<Tet> tets_;  // upright ones are positive
  Array<Vec3> points_;
  Array<double> mobility_;
  StarLists star_;
  Array<std::uint8_t> is_near_, moved_;
  Array<Near> near_{&job_.memory};
  Array<std::int32_t> shaken_{&job_.memory};
  Array<double> around_{&job_.memory};
};

}  // namespace

void untangle(Job &job, Boundary &boundary, Original &original) {
  if (are_oriented(boundary.triangles, job)) return;
  Array<Tet> upright = Uprights(original.view, job).find();
  if (upright.empty()) return;
  Untangling untangling(original, boundary, std::move(upright), job);
  if (!untangling.run() || untangling.distance(false) > farthest * original.box.diagonal()) return;
  NumberedTets tets(original.view, original.tet_number, job.memory);
  tets.points = untangling.points();
  if (!tets.find_boundary(job) || !are_oriented(tets.boundary.triangles, job)) return;
  tets.boundary.flat_tets += boundary.flat_tets;
  tets.boundary.duplicate_tets += boundary.duplicate_tets;
  boundary = std::move(tets.boundary);
  original.moved_points = untangling.moved();
  original.boundary_moved_by = untangling.distance(true);
  original.view.submitted = original.view.points;
  original.moved = std::move(untangling.points());
  original.view.points = original.moved;
}

}  // namespace tetlod
