#include "untangle.hpp"

#include <algorithm>
#include <cmath>

#include "face_sweep.hpp"
#include "geometry.hpp"
#include "random_place.hpp"
#include "star_lists.hpp"
#include "status.hpp"
#include "tet_checks.hpp"

namespace tetlod {

namespace {

/// Of the diagonal: so far off a boundary would be taken for another.
constexpr double farthest = 0.02;
/// What a vertex of the boundary moves, of one inside, in so many rounds; in later ones, which would come to no end, as
/// much.
constexpr double inertia = 0.1;
constexpr int rounds_with_inertia = 10;
/// Of the volume that is usual around it, what a tet that was turned over gets, and what none is flattened below; and
/// what one that was flatter gets, so that it does not turn.
constexpr double least_volume = 0.02, hardly_any = 1e-6;
constexpr int most_rounds = 100;
/// Of the tets that are turned over: where more are, it is not a mesh that was bent too far.
constexpr double most_turned = 0.1;

/// The number of an edge: of all that are run through as often either way the sum is none.
std::uint64_t number_of_edge(std::int32_t from, std::int32_t to) {
  const auto [low, high] = std::minmax(from, to);
  const std::uint64_t number = scrambled(std::uint64_t(low) << 32 | std::uint32_t(high));
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
  const auto [a, b, c] = face_opposite(t, corner);
  return ((a < b) != (b < c)) != (a < c);
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
      volume += winding_[t] * six_volume(mesh_.points, mesh_.tets[t]);
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
  /// of_boundary: what its vertices move at first; 0: they stay.
  Untangling(const Original &original, const Boundary &boundary, Array<Tet> &&upright, double of_boundary, Job &job)
      : job_(job),
        before_(original.view.points),
        tets_(std::move(upright)),
        points_(before_.begin(), before_.end(), &job.memory),
        mobility_(points_.size(), 1.0, &job.memory),
        star_(Span<const Tet>(tets_), points_.size(), job),
        least_(tets_.size(), unknown, &job.memory),
        is_due_(tets_.size(), 0, &job.memory),
        moved_in_(points_.size(), 0, &job.memory) {
    for (const Triangle &triangle : boundary.triangles)
      for (const std::int32_t v : triangle) mobility_[std::size_t(v)] = of_boundary;
    for (std::size_t v = 0; v < original.flags.size(); v++)
      if (original.flags[v] != 0) mobility_[v] = 0;
  }

  /// False: that comes to no end.
  bool run() {
    if (!find_turned()) return false;
    for (round_ = 1; !due_.empty(); round_++)
      if (round_ > most_rounds || !straighten_those_due()) return false;
    return true;
  }

  Moves moves() const {
    Moves moves(&job_.memory);
    for (std::size_t v = 0; v < points_.size(); v++) {
      job_.poll_at(v, 0.9);
      const bool is_moved = moved_in_[v] > 0 && points_[v] != before_[v];  // those of no tet may be no numbers
      if (is_moved) moves.push_back({std::int32_t(v), points_[v]});
    }
    return moves;
  }

 private:
  static constexpr double unknown = -1;

  /// False: there are very many.
  bool find_turned() {
    const auto most = std::size_t(most_turned * double(tets_.size()));
    for (std::size_t t = 0; t < tets_.size() && due_.size() <= most; t++) {
      job_.poll_at(t, 0.9);
      if (six_volume(before_, tets_[t]) < 0) due_.push_back(std::int32_t(t));
    }
    return due_.size() <= most;
  }

  /// One after another, so that each sees what became of those before. Due afterwards are those of moved vertices.
  bool straighten_those_due() {
    for (std::size_t i = 0; i < due_.size(); i++) {
      job_.poll_at(i, 0.9);
      is_due_[std::size_t(due_[i])] = 0;
      if (!straighten(due_[i])) return false;
    }
    due_.clear();
    std::size_t seen = 0;
    for (const std::int32_t v : shaken_)
      for (const std::int32_t t : star_.of(v)) {
        job_.poll_at(seen++, 0.9);
        if (!is_due_[std::size_t(t)]) due_.push_back(t);
        is_due_[std::size_t(t)] = 1;
      }
    shaken_.clear();
    return true;
  }

  /// Gives a tet that has less than half of the volume that it is to have that volume, by the least moves, as far as it
  /// changes with them in proportion. False: nothing of it may be moved.
  bool straighten(std::int32_t tet) {
    const Tet &t = tets_[std::size_t(tet)];
    const double least = least_of(tet), missing = least - six_volume(points_, t);
    if (missing <= 0.5 * least) return true;
    Vec3 change[4];  // of the volume, by a move
    double all = 0;
    for (std::size_t k = 0; k < 4; k++) {
      change[k] = -area_vector(points_, face_opposite(t, k));
      all += mobility(t[k]) * length2(change[k]);
    }
    if (!(all > 0)) return false;
    for (std::size_t k = 0; k < 4; k++) move(t[k], missing / all * change[k]);
    return true;
  }

  double mobility(std::int32_t v) const {
    const double mobility = mobility_[std::size_t(v)];
    return mobility > 0 && round_ > rounds_with_inertia ? 1 : mobility;
  }

  void move(std::int32_t v, const Vec3 &by) {
    if (mobility(v) == 0) return;
    points_[std::size_t(v)] += mobility(v) * by;
    if (moved_in_[std::size_t(v)] != round_) shaken_.push_back(v);
    moved_in_[std::size_t(v)] = round_;
  }

  /// Six times the volume that it is to have.
  double least_of(std::int32_t t) {
    double &least = least_[std::size_t(t)];
    if (least == unknown) {
      const double own = six_volume(before_, tets_[std::size_t(t)]), usual = usual_around(t);
      least = own < 0 ? least_volume * usual : std::clamp(own, hardly_any * usual, least_volume * usual);
    }
    return least;
  }

  /// The median, of some: of what vertices of very many tets have.
  double usual_around(std::int32_t t) {
    constexpr std::size_t some = 64;
    around_.clear();
    for (const std::int32_t v : tets_[std::size_t(t)]) {
      const Span<const std::int32_t> star = star_.of(v);
      for (std::size_t i = 0; i < std::min(star.size(), some); i++)
        around_.push_back(std::abs(six_volume(before_, tets_[std::size_t(star[i])])));
    }
    const auto middle = around_.begin() + std::ptrdiff_t(around_.size() / 2);
    std::nth_element(around_.begin(), middle, around_.end());
    return *middle;
  }

  Job &job_;
  Span<const Vec3> before_;
  Array<Tet> tets_;  // upright ones are positive
  Array<Vec3> points_;
  Array<double> mobility_;
  StarLists star_;
  Array<double> least_;
  Array<std::uint8_t> is_due_;
  Array<int> moved_in_;  // of each vertex, the last round in which it was; 0: in none
  int round_ = 0;
  Array<std::int32_t> due_{&job_.memory}, shaken_{&job_.memory};  // tets; vertices, in this round
  Array<double> around_{&job_.memory};
};

bool are_short(const Moves &moves, const Original &original) {
  return std::all_of(moves.begin(), moves.end(), [&](const Move &move) {
    return glm::distance(move.to, original.view.points[std::size_t(move.vertex)]) <= farthest * original.box.diagonal();
  });
}

}  // namespace

Moves find_moves(const Original &original, const Boundary &boundary, Job &job) {
  Moves moves(&job.memory);
  const bool agree = are_oriented(boundary.triangles, job);
  const auto are_side_by_side = [&] {
    return check_volume(original.view.points, original.view.tets, boundary.triangles, 0.9, job).empty();
  };
  if (agree && are_side_by_side()) return moves;
  Array<Tet> upright = Uprights(original.view, job).find();
  if (upright.empty()) return moves;
  Untangling untangling(original, boundary, std::move(upright), agree ? 0 : inertia, job);
  if (!untangling.run()) return moves;
  moves = untangling.moves();
  if (!are_short(moves, original)) moves.clear();
  return moves;
}

void make_moves(const Moves &moves, Job &job, Boundary &boundary, Original &original) {
  if (moves.empty()) return;
  Array<Vec3> points(original.view.points.begin(), original.view.points.end(), &job.memory);
  for (const Move &move : moves) points[std::size_t(move.vertex)] = move.to;
  MeshView moved = original.view;
  moved.points = points;
  Boundary of_moved(job.memory);
  extract_boundary(moved, job, of_moved);
  if (!of_moved.excluded.empty() || !are_oriented(of_moved.triangles, job)) return;
  boundary.triangles = std::move(of_moved.triangles);
  boundary.tet_of = std::move(of_moved.tet_of);
  original.moves.upright.assign(moves.begin(), moves.end());
  original.moved = std::move(points);
  original.view.submitted = original.view.points;
  original.view.points = original.moved;
  double farthest = 0;
  for (const Triangle &triangle : boundary.triangles)
    for (const std::int32_t v : triangle)
      farthest =
          std::max(farthest, glm::distance(original.moved[std::size_t(v)], original.view.submitted[std::size_t(v)]));
  original.boundary_moved_by += farthest;
}

void refuse_moves(const Original &original, const Options &options) {
  const double moved_by = original.boundary_moved_by / original.box.diagonal();
  if (options.max_deviation == 0 || options.max_deviation > moved_by) return;
  fail(Status::mesh_intersecting,
       "tets are turned over at the boundary, of which vertices would have to be moved by %s of the diagonal "
       "(max-deviation: %s)",
       number(moved_by).c_str(), number(options.max_deviation).c_str());
}

}  // namespace tetlod
