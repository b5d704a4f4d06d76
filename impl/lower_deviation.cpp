#include "lower_deviation.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "boundary_distances.hpp"
#include "came_from.hpp"
#include "contact_guard.hpp"
#include "nearest_in_star.hpp"
#include "remesh_checks.hpp"
#include "replace_simplices.hpp"
#include "tet_frame.hpp"

namespace tetlod {

namespace {

constexpr int sweeps = 6;
/// What a change leaves of a distance, at most; to gain less is not worth it.
constexpr double most_left = 0.9;
/// Of the way to where it would be none, what is tried.
constexpr double parts_of_way[] = {1, 0.6, 0.3};
/// A corner of more weight than that moves; one of less is no end of what is divided.
constexpr double near_corner = 0.6, far_corner = 0.15;

/// What becomes of the tets and triangles that have some vertices in common.
struct Change {
  explicit Change(Memory &memory) : tets(&memory), triangles(&memory), fresh_tets(&memory), fresh_triangles(&memory) {}
  Array<std::int32_t> tets, triangles;
  Array<Tet> fresh_tets;
  Array<Triangle> fresh_triangles;
  double old_volume6 = 0, fresh_volume6 = 0;
  double least_shape2 = 0;  ///< of the old tets
};

class DeviationLowering {
 public:
  DeviationLowering(const BoundaryMoves &by, Job &job, TetMesh &mesh, Array<std::int32_t> &origin)
      : original_(by.original),
        stays_(by.stays),
        job_(job),
        mesh_(mesh),
        origin_(origin),
        distances_(original_, by.to_original, mesh, origin, job),
        touched_(&job.memory),
        change_(job.memory),
        volume6_(6 * enclosed_volume(original_.points, original_.triangles).value),
        excess6_(6 * enclosed_volume(mesh.points, mesh.boundary).value - volume6_) {
    if (by.are_guarded) guard_.emplace(mesh.points, mesh.boundary, job);
  }

  double run(double least, std::int64_t most) {
    least_ = least;
    most_ = std::size_t(most);
    for (int sweep = 0; sweep < sweeps && serve_worst() > 0; sweep++) {
    }
    return distances_.largest();
  }

 private:
  const Vec3 &point(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  double shape2_of(const Tet &t) const { return shape2(point(t[0]), point(t[1]), point(t[2]), point(t[3])); }

  /// Of the largest distances, as many as may be served in a sweep; returns how many could be.
  std::int64_t serve_worst() {
    constexpr std::size_t moves = 16;
    const std::size_t room = most_ - std::min(most_, mesh_.tets.size());
    const Array<Apart> worst = distances_.worst(least_, moves + room / 2);
    if (worst.empty()) return 0;
    const StarLists tets(Span<const Tet>(mesh_.tets), mesh_.points.size(), job_),
        triangles(Span<const Triangle>(mesh_.boundary), mesh_.points.size(), job_);
    tets_ = &tets;
    triangles_ = &triangles;
    touched_.assign(mesh_.points.size(), 0);
    std::int64_t served = 0;
    for (const Apart &apart : worst) served += distances_.is_still(apart) && serve(apart);
    return served;
  }

  bool serve(const Apart &apart) {
    const Goal goal{most_left * apart.distance, apart.where == Apart::at_sample ? std::int64_t(apart.at) : -1};
    if (apart.where == Apart::at_sample) return serve_sample(apart.at, goal);
    if (apart.where == Apart::at_middle) return serve_middle(mesh_.boundary[apart.at], goal);
    return serve_vertex(std::int32_t(apart.at), goal);
  }

  /// Takes the nearest of the mesh's boundary to an original vertex, or else one of the corners there as far.
  bool serve_sample(std::size_t sample, const Goal &goal) {
    if (distances_.home(sample) < 0) return false;
    const Triangle home = mesh_.boundary[std::size_t(distances_.home(sample))];
    const TriangleInSpace triangle(mesh_.points, home);
    const Vec3 to = original_.points[sample], w = triangle.weights_nearest_to(to), from = triangle.at(w);
    FewVertices ends;
    for (std::size_t k = 0; k < 3; k++)
      if (w[int(k)] >= far_corner) ends.push(home[k]);
    for (double part : parts_of_way) {
      const Aim aim = part < 1 ? distances_.aim_near(from + part * (to - from)) : distances_.aim_at(sample);
      for (std::size_t k = 0; k < 3; k++)
        if (w[int(k)] > near_corner && move(home[k], aim, goal)) return true;
      if (ends.size() > 1 && divide(ends, aim, goal)) return true;
    }
    return move_one(ends, to - from, goal);
  }

  /// Takes the middle of a triangle to the original's boundary, or else one of the corners as far.
  bool serve_middle(const Triangle t, const Goal &goal) {
    const Vec3 from = TriangleInSpace(mesh_.points, t).middle(), way = distances_.aim_near(from).nearest - from;
    FewVertices ends;
    for (std::int32_t v : t) ends.push(v);
    for (double part : parts_of_way)
      if (divide(ends, distances_.aim_near(from + part * way), goal)) return true;
    return move_one(ends, way, goal);
  }

  /// Takes a vertex of the mesh's boundary to the original's.
  bool serve_vertex(std::int32_t v, const Goal &goal) {
    FewVertices alone;
    alone.push(v);
    return move_one(alone, distances_.aim_near(point(v)).nearest - point(v), goal);
  }

  /// One of the vertices goes that way, or a part of it; where tets that would turn over are in the way, as near to
  /// there as they let it.
  bool move_one(const FewVertices &vertices, const Vec3 &way, const Goal &goal) {
    for (double part : parts_of_way)
      for (std::int32_t v : vertices)
        if (move(v, distances_.aim_near(point(v) + part * way), goal)) return true;
    for (double part : parts_of_way)
      for (std::int32_t v : vertices)
        if (move_within(v, point(v) + part * way, goal)) return true;
    return false;
  }

  // ---- A change

  bool may_change(const FewVertices &vertices) const {
    return std::none_of(vertices.begin(), vertices.end(), [&](std::int32_t v) {
      return touched_[std::size_t(v)] || stays_there(std::size_t(v), origin_, stays_);
    });
  }

  bool may_move(std::int32_t v) {
    FewVertices alone;
    alone.push(v);
    if (!may_change(alone)) return false;
    look_around(alone, v);
    return true;
  }

  bool move(std::int32_t v, const Aim &aim, const Goal &goal) {
    if (!may_move(v)) return false;
    const Vec3 before = std::exchange(mesh_.points[std::size_t(v)], aim.point);
    if (!suits(aim, goal)) {
      mesh_.points[std::size_t(v)] = before;
      return false;
    }
    std::copy(aim.values.begin(), aim.values.end(),
              mesh_.scalars.begin() + std::ptrdiff_t(std::size_t(v) * original_.fields));
    origin_[std::size_t(v)] = aim.origin < 0 ? moved_away(origin_[std::size_t(v)]) : aim.origin;
    make(v, aim);
    return true;
  }

  bool move_within(std::int32_t v, Vec3 to, const Goal &goal) {
    return may_move(v) && nearest_in_star(change_.fresh_tets, v, mesh_.points, to) &&
           move(v, distances_.aim_near(to), goal);
  }

  /// An edge or a triangle gets a vertex.
  bool divide(const FewVertices &ends, const Aim &aim, const Goal &goal) {
    if (!may_change(ends)) return false;
    const auto v = std::int32_t(mesh_.points.size());
    look_around(ends, v);
    if (mesh_.tets.size() + change_.fresh_tets.size() - change_.tets.size() > most_) return false;
    mesh_.points.push_back(aim.point);
    if (!suits(aim, goal)) {
      mesh_.points.pop_back();
      return false;
    }
    mesh_.scalars.insert(mesh_.scalars.end(), aim.values.begin(), aim.values.end());
    origin_.push_back(aim.origin < 0 ? moved_away(origin_[std::size_t(ends[0])]) : aim.origin);
    touched_.push_back(1);
    make(v, aim);
    return true;
  }

  /// What becomes of all that has the vertices when `by` comes in the place of each.
  void look_around(const FewVertices &vertices, std::int32_t by) {
    find_with(vertices, *tets_, mesh_.tets, change_.tets);
    find_with(vertices, *triangles_, mesh_.boundary, change_.triangles);
    replace_each(change_.tets, vertices, by, mesh_.tets, change_.fresh_tets);
    replace_each(change_.triangles, vertices, by, mesh_.boundary, change_.fresh_triangles);
    change_.old_volume6 = 0;
    change_.least_shape2 = std::numeric_limits<double>::infinity();
    for (std::int32_t t : change_.tets) {
      change_.old_volume6 += six_volume(mesh_.points, mesh_.tets[std::size_t(t)]);
      change_.least_shape2 = std::min(change_.least_shape2, shape2_of(mesh_.tets[std::size_t(t)]));
    }
  }

  /// Whether the tets are sound, and the goal is reached.
  bool suits(const Aim &aim, const Goal &goal) {
    job_.poll(1);
    return aim.distance() <= goal.limit && are_sound() && keeps_volume() &&
           distances_.suit(change_.triangles, change_.fresh_triangles, goal) &&
           !(guard_ && guard_->is_met(change_.triangles, change_.fresh_triangles));
  }

  bool are_sound() const {
    const double least = std::max(flattest_part * flattest_part * change_.least_shape2, least_shape * least_shape);
    return std::all_of(change_.fresh_tets.begin(), change_.fresh_tets.end(),
                       [&](const Tet &t) { return six_volume(mesh_.points, t) > 0 && shape2_of(t) > least; });
  }

  bool keeps_volume() {
    change_.fresh_volume6 = 0;
    for (const Tet &t : change_.fresh_tets) change_.fresh_volume6 += six_volume(mesh_.points, t);
    const double excess6 = excess6_ + change_.fresh_volume6 - change_.old_volume6;
    return std::abs(excess6) <= std::max(std::abs(excess6_), most_volume * volume6_);
  }

  void make(std::int32_t v, const Aim &aim) {
    excess6_ += change_.fresh_volume6 - change_.old_volume6;
    for (const Tet &t : change_.fresh_tets)
      for (std::int32_t corner : t) touched_[std::size_t(corner)] = 1;
    put(change_.tets, change_.fresh_tets, mesh_.tets);
    put(change_.triangles, change_.fresh_triangles, mesh_.boundary);
    if (guard_) guard_->take(change_.triangles);
    distances_.take(change_.triangles);
    distances_.take(v, aim);
  }

  const Surface &original_;
  Span<const std::uint8_t> stays_;
  Job &job_;
  TetMesh &mesh_;
  Array<std::int32_t> &origin_;
  BoundaryDistances distances_;
  std::optional<ContactGuard> guard_;
  double least_ = 0;                                        // distance that is served
  std::size_t most_ = 0;                                    // tets
  const StarLists *tets_ = nullptr, *triangles_ = nullptr;  // as the sweep began
  Array<std::uint8_t> touched_;                             // vertices whose tets changed since
  Change change_;
  double volume6_, excess6_;  // of the original; what the mesh has more
};

}  // namespace

double lower_deviation(const BoundaryMoves &by, double least, std::int64_t most, Job &job, TetMesh &mesh,
                       Array<std::int32_t> &origin) {
  return DeviationLowering(by, job, mesh, origin).run(least, most);
}

}  // namespace tetlod
