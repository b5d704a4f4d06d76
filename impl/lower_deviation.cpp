#include "lower_deviation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "replace_simplices.hpp"
#include "surface_distance.hpp"
#include "tet_frame.hpp"

namespace tetlod {

namespace {

constexpr std::int64_t leaf = 4;
constexpr std::size_t block = 256;
constexpr int sweeps = 6;
/// What a change leaves of a distance, at most; to gain less is not worth it.
constexpr double most_left = 0.8;
/// Of the flattest tet's shape before: no tet gets flatter.
constexpr double flattest_part = 0.2;
/// Of the diagonal: a smaller distance is of rounding.
constexpr double least_distance = 1e-12;
/// Of the original's volume, that the mesh may lack or have too much.
constexpr double most_volume = 0.0099;
/// Of the way to where it would be none, what is tried.
constexpr double parts_of_way[] = {1, 0.6, 0.3};
/// A corner of more weight than that moves; one of less is no end of what is divided.
constexpr double near_corner = 0.6, far_corner = 0.15;

/// Where the boundaries are apart: at an original vertex, or, from `vertices` on, at one of the mesh.
struct Apart {
  double distance;
  std::size_t at;
  bool operator<(const Apart &o) const { return distance != o.distance ? distance > o.distance : at < o.at; }
};

/// Where a vertex is to be, with the values of the original's boundary where that is nearest.
struct Aim {
  Vec3 point, nearest;
  Few<double, most_fields> values;
  std::int32_t origin;  ///< the original vertex that it is, or -1
  double distance() const { return glm::length(point - nearest); }
};

/// What becomes of the tets and triangles that have some vertices in common.
struct Change {
  struct Home {
    std::int32_t sample;
    std::size_t triangle;  ///< of the fresh ones
    double distance;
  };
  explicit Change(Memory &memory)
      : tets(&memory), triangles(&memory), fresh_tets(&memory), fresh_triangles(&memory), homes(&memory) {}
  Array<std::int32_t> tets, triangles;
  Array<Tet> fresh_tets;
  Array<Triangle> fresh_triangles;
  Array<Home> homes;  ///< of the samples that the triangles stood for
  double old_volume6 = 0, fresh_volume6 = 0;
  double least_shape2 = 0;  ///< of the old tets
};

class DeviationLowering {
 public:
  DeviationLowering(const Surface &original, Span<const std::uint8_t> stays, Job &job, TetMesh &mesh,
                    Array<std::int32_t> &origin)
      : original_(original),
        stays_(stays),
        job_(job),
        mesh_(mesh),
        origin_(origin),
        least_(least_distance * box_of(original.points).diagonal()),
        to_original_(original.points, original.triangles, leaf, job),
        of_sample_(original.points.size(), 0.0, &job.memory),
        of_vertex_(mesh.points.size(), 0.0, &job.memory),
        first_(mesh.boundary.size(), -1, &job.memory),
        next_(original.points.size(), -1, &job.memory),
        home_(original.points.size(), -1, &job.memory),
        touched_(&job.memory),
        change_(job.memory),
        volume6_(volume6_of(original.points, original.triangles)),
        excess6_(volume6_of(mesh.points, mesh.boundary) - volume6_) {
    measure_samples();
    measure_vertices();
  }

  double run(std::int64_t most) {
    most_ = std::size_t(most);
    for (int sweep = 0; sweep < sweeps && serve_worst() > 0; sweep++) {
    }
    return std::max(largest_of_samples(), *std::max_element(of_vertex_.begin(), of_vertex_.end()));
  }

 private:
  std::size_t vertices() const { return original_.points.size(); }

  static double volume6_of(Span<const Vec3> points, Span<const Triangle> triangles) {
    double sum = 0;
    for (const Triangle &t : triangles)
      sum += det(points[0], points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]);
    return sum;
  }
  const Vec3 &point(const Tet &t, std::size_t k) const { return mesh_.points[std::size_t(t[k])]; }
  double volume6_of(const Tet &t) const { return det(point(t, 0), point(t, 1), point(t, 2), point(t, 3)); }
  double shape2_of(const Tet &t) const { return shape2(point(t, 0), point(t, 1), point(t, 2), point(t, 3)); }

  void measure_samples() {
    const TriangleTree to_mesh(mesh_.points, mesh_.boundary, leaf, job_);
    job_.parallel.for_blocks(vertices(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; i++) {
        const NearestPoint nearest = to_mesh.nearest(original_.points[i]);
        of_sample_[i] = nearest.distance;
        home_[i] = nearest.triangle;
      }
      job_.poll(1);
    });
    for (std::size_t i = 0; i < vertices(); i++)
      if (home_[i] >= 0) next_[i] = std::exchange(first_[std::size_t(home_[i])], std::int32_t(i));
  }

  /// Those that stayed where they were may be nearer to what has changed: the largest are looked at again.
  double largest_of_samples() {
    const auto is_less = [](const Apart &a, const Apart &b) { return b < a; };
    const TriangleTree to_mesh(mesh_.points, mesh_.boundary, leaf, job_);
    Array<Apart> largest(&job_.memory);
    for (std::size_t i = 0; i < of_sample_.size(); i++) largest.push_back({of_sample_[i], i});
    std::make_heap(largest.begin(), largest.end(), is_less);
    for (std::size_t turn = 1;; turn++) {
      if (turn % 256 == 0) job_.poll(1);
      std::pop_heap(largest.begin(), largest.end(), is_less);
      Apart &last = largest.back();
      const double distance = to_mesh.nearest(original_.points[last.at]).distance;
      if (!(distance < last.distance)) return last.distance;
      last.distance = distance;
      std::push_heap(largest.begin(), largest.end(), is_less);
    }
  }

  /// Those that are original vertices are not off.
  void measure_vertices() {
    Array<std::uint8_t> moved(mesh_.points.size(), 0, &job_.memory);
    for (const Triangle &t : mesh_.boundary)
      for (std::int32_t v : t) moved[std::size_t(v)] = origin_[std::size_t(v)] < 0;
    job_.parallel.for_blocks(moved.size(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; v++)
        if (moved[v]) of_vertex_[v] = to_original_.nearest(mesh_.points[v]).distance;
      job_.poll(1);
    });
  }

  /// The largest distances, as many as may be served in a sweep.
  Array<Apart> find_worst() const {
    constexpr std::size_t moves = 16;
    Array<Apart> worst(&job_.memory);
    for (std::size_t i = 0; i < of_sample_.size(); i++)
      if (of_sample_[i] > least_) worst.push_back({of_sample_[i], i});
    for (std::size_t v = 0; v < of_vertex_.size(); v++)
      if (of_vertex_[v] > least_) worst.push_back({of_vertex_[v], vertices() + v});
    const std::size_t room = most_ - std::min(most_, mesh_.tets.size()),
                      count = std::min(worst.size(), moves + room / 2);
    std::partial_sort(worst.begin(), worst.begin() + std::ptrdiff_t(count), worst.end());
    worst.resize(count);
    return worst;
  }

  /// How many could be.
  std::int64_t serve_worst() {
    const Array<Apart> worst = find_worst();
    if (worst.empty()) return 0;
    const StarLists tets(Span<const Tet>(mesh_.tets), mesh_.points.size(), job_),
        triangles(Span<const Triangle>(mesh_.boundary), mesh_.points.size(), job_);
    tets_ = &tets;
    triangles_ = &triangles;
    touched_.assign(mesh_.points.size(), 0);
    std::int64_t served = 0;
    for (const Apart &apart : worst) served += serve(apart);
    return served;
  }

  bool serve(const Apart &apart) {
    const double limit = most_left * apart.distance;
    if (apart.at < vertices()) return of_sample_[apart.at] == apart.distance && serve_sample(apart.at, limit);
    const std::size_t v = apart.at - vertices();
    return of_vertex_[v] == apart.distance && serve_vertex(std::int32_t(v), limit);
  }

  /// Takes the nearest of the mesh's boundary to an original vertex, or else one of the corners there as far.
  bool serve_sample(std::size_t sample, double limit) {
    if (home_[sample] < 0) return false;
    const Vec3 to = original_.points[sample];
    const Triangle home = mesh_.boundary[std::size_t(home_[sample])];
    const Vec3 w = weights_in(home, to), from = at_weights(home, w);
    FewVertices ends;
    for (std::size_t k = 0; k < 3; k++)
      if (w[int(k)] >= far_corner) ends.push(home[k]);
    for (double part : parts_of_way) {
      const Aim aim = part < 1 ? aim_near(from + part * (to - from)) : aim_at(sample);
      for (std::size_t k = 0; k < 3; k++)
        if (w[int(k)] > near_corner && move(home[k], aim, limit)) return true;
      if (ends.size() > 1 && divide(ends, aim, limit)) return true;
    }
    for (double part : parts_of_way)
      for (std::int32_t v : ends)
        if (move(v, aim_near(mesh_.points[std::size_t(v)] + part * (to - from)), limit)) return true;
    return false;
  }

  /// Takes a vertex of the mesh's boundary to the original's.
  bool serve_vertex(std::int32_t v, double limit) {
    const Vec3 from = mesh_.points[std::size_t(v)], to = aim_near(from).nearest;
    return std::any_of(std::begin(parts_of_way), std::end(parts_of_way),
                       [&](double part) { return move(v, aim_near(from + part * (to - from)), limit); });
  }

  Aim aim_at(std::size_t sample) const {
    const Vec3 &p = original_.points[sample];
    Aim aim{p, p, {}, original_.origin[sample]};
    for (std::size_t field = 0; field < original_.fields; field++)
      aim.values.push(original_.scalars[sample * original_.fields + field]);
    return aim;
  }

  Aim aim_near(const Vec3 &p) const {
    const NearestPoint nearest = to_original_.nearest(p);
    const Triangle &t = original_.triangles[std::size_t(nearest.triangle)];
    Aim aim{p, Vec3(0), {}, -1};
    for (int k = 0; k < 3; k++) aim.nearest += nearest.weights[k] * original_.points[std::size_t(t[std::size_t(k)])];
    for (std::size_t field = 0; field < original_.fields; field++) aim.values.push(value_at(t, nearest.weights, field));
    return aim;
  }

  /// Not beyond those at the corners by rounding.
  double value_at(const Triangle &t, const Vec3 &weights, std::size_t field) const {
    const auto of = [&](std::size_t k) { return original_.scalars[std::size_t(t[k]) * original_.fields + field]; };
    const auto [low, high] = std::minmax({of(0), of(1), of(2)});
    return std::min(high, std::max(low, weights[0] * of(0) + weights[1] * of(1) + weights[2] * of(2)));
  }

  // ---- Triangles of the mesh

  const Vec3 &corner(const Triangle &t, int k) const { return mesh_.points[std::size_t(t[std::size_t(k)])]; }
  Vec3 weights_in(const Triangle &t, const Vec3 &p) const {
    return nearest_in_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
  }
  Vec3 at_weights(const Triangle &t, const Vec3 &w) const {
    return w.x * corner(t, 0) + w.y * corner(t, 1) + w.z * corner(t, 2);
  }

  // ---- A change

  bool is_kept(std::int32_t v) const {
    const std::int32_t at = origin_[std::size_t(v)];
    return at >= 0 && !stays_.empty() && stays_[std::size_t(at)];
  }

  bool move(std::int32_t v, const Aim &aim, double limit) {
    FewVertices alone;
    alone.push(v);
    if (!may_change(alone)) return false;
    look_around(alone, v);
    const Vec3 before = std::exchange(mesh_.points[std::size_t(v)], aim.point);
    if (!suits(aim, limit)) {
      mesh_.points[std::size_t(v)] = before;
      return false;
    }
    std::copy(aim.values.begin(), aim.values.end(),
              mesh_.scalars.begin() + std::ptrdiff_t(std::size_t(v) * original_.fields));
    origin_[std::size_t(v)] = aim.origin;
    of_vertex_[std::size_t(v)] = aim.distance();
    make();
    return true;
  }

  /// An edge or a triangle gets a vertex.
  bool divide(const FewVertices &ends, const Aim &aim, double limit) {
    if (!may_change(ends)) return false;
    look_around(ends, std::int32_t(mesh_.points.size()));
    if (mesh_.tets.size() + change_.fresh_tets.size() - change_.tets.size() > most_) return false;
    mesh_.points.push_back(aim.point);
    if (!suits(aim, limit)) {
      mesh_.points.pop_back();
      return false;
    }
    mesh_.scalars.insert(mesh_.scalars.end(), aim.values.begin(), aim.values.end());
    origin_.push_back(aim.origin);
    of_vertex_.push_back(aim.distance());
    touched_.push_back(1);
    make();
    return true;
  }

  bool may_change(const FewVertices &vertices) const {
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](std::int32_t v) { return touched_[std::size_t(v)] || is_kept(v); });
  }

  /// What becomes of all that has the vertices when `by` comes in the place of each.
  void look_around(const FewVertices &vertices, std::int32_t by) {
    find_with(vertices, *tets_, mesh_.tets, change_.tets);
    find_with(vertices, *triangles_, mesh_.boundary, change_.triangles);
    replace_each(change_.tets, vertices, by, mesh_.tets, change_.fresh_tets);
    replace_each(change_.triangles, vertices, by, mesh_.boundary, change_.fresh_triangles);
    change_.old_volume6 = change_.fresh_volume6 = 0;
    change_.least_shape2 = std::numeric_limits<double>::infinity();
    for (std::int32_t t : change_.tets) {
      change_.old_volume6 += volume6_of(mesh_.tets[std::size_t(t)]);
      change_.least_shape2 = std::min(change_.least_shape2, shape2_of(mesh_.tets[std::size_t(t)]));
    }
  }

  /// Whether the tets are sound, and nothing that is concerned is farther off than the limit.
  bool suits(const Aim &aim, double limit) {
    job_.poll(1);
    const double least = flattest_part * flattest_part * change_.least_shape2;
    const auto sound = [&](const Tet &t) {
      return volume6_of(t) > 0 && shape2_of(t) > std::max(least, least_shape * least_shape);
    };
    const auto near = [&](const Triangle &t) {
      const Vec3 middle = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
      return to_original_.nearest(middle).distance <= limit;
    };
    return aim.distance() <= limit && std::all_of(change_.fresh_tets.begin(), change_.fresh_tets.end(), sound) &&
           keeps_volume() && finds_homes(limit) &&
           std::all_of(change_.fresh_triangles.begin(), change_.fresh_triangles.end(), near);
  }

  bool keeps_volume() {
    for (const Tet &t : change_.fresh_tets) change_.fresh_volume6 += volume6_of(t);
    const double excess6 = excess6_ + change_.fresh_volume6 - change_.old_volume6;
    return std::abs(excess6) <= std::max(std::abs(excess6_), most_volume * volume6_);
  }

  /// For the samples that the old triangles stood for.
  bool finds_homes(double limit) {
    change_.homes.clear();
    for (std::int32_t old : change_.triangles)
      for (std::int32_t s = first_[std::size_t(old)]; s >= 0; s = next_[std::size_t(s)]) {
        const Change::Home home = home_of(s);
        if (!(home.distance <= limit)) return false;
        change_.homes.push_back(home);
      }
    return true;
  }

  Change::Home home_of(std::int32_t sample) const {
    const Vec3 &p = original_.points[std::size_t(sample)];
    Change::Home home{sample, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < change_.fresh_triangles.size(); i++) {
      const Triangle &t = change_.fresh_triangles[i];
      const double distance = glm::length(at_weights(t, weights_in(t, p)) - p);
      if (distance < home.distance) home = {sample, i, distance};
    }
    return home;
  }

  void make() {
    excess6_ += change_.fresh_volume6 - change_.old_volume6;
    for (const Tet &t : change_.fresh_tets)
      for (std::int32_t v : t) touched_[std::size_t(v)] = 1;
    const std::size_t olds = change_.triangles.size(), end = mesh_.boundary.size();
    put(change_.tets, change_.fresh_tets, mesh_.tets);
    put(change_.triangles, change_.fresh_triangles, mesh_.boundary);
    first_.resize(mesh_.boundary.size(), -1);
    for (std::int32_t old : change_.triangles) first_[std::size_t(old)] = -1;
    for (const Change::Home &home : change_.homes) {
      const std::size_t i = home.triangle, at = i < olds ? std::size_t(change_.triangles[i]) : end + i - olds;
      const auto s = std::size_t(home.sample);
      of_sample_[s] = home.distance;
      home_[s] = std::int32_t(at);
      next_[s] = std::exchange(first_[at], home.sample);
    }
  }

  const Surface &original_;
  Span<const std::uint8_t> stays_;
  Job &job_;
  TetMesh &mesh_;
  Array<std::int32_t> &origin_;
  double least_;
  TriangleTree to_original_;
  Array<double> of_sample_, of_vertex_;      // distances, of the original's vertices and the mesh's
  Array<std::int32_t> first_, next_, home_;  // lists of the original's vertices, by nearest triangle
  std::size_t most_ = 0;
  const StarLists *tets_ = nullptr, *triangles_ = nullptr;  // as the sweep began
  Array<std::uint8_t> touched_;                             // vertices whose tets changed since
  Change change_;
  double volume6_, excess6_;  // of the original; what the mesh has more
};

}  // namespace

double lower_deviation(const Surface &original, Span<const std::uint8_t> stays, std::int64_t most, Job &job,
                       TetMesh &mesh, Array<std::int32_t> &origin) {
  return DeviationLowering(original, stays, job, mesh, origin).run(most);
}

}  // namespace tetlod
