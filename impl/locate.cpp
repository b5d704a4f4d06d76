#include "locate.hpp"

#include <algorithm>
#include <tuple>

#include "geometry.hpp"
#include "kd_tree.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

constexpr std::size_t tets_in_block = 1 << 12, points_in_block = 1 << 8;

Box box_at(const Vec3 &p) { return {p, p}; }

/// Barycentric weights of p in a tet; false for a tet without volume, unless p is its vertex.
bool find_weights(const MeshView &mesh, const Tet &t, const Vec3 &p, std::array<double, 4> &weights) {
  const auto corner = [&](std::size_t k) -> const Vec3 & { return mesh.points[std::size_t(t[k])]; };
  for (std::size_t k = 0; k < 4; k++)
    if (corner(k) == p) {
      weights = {};
      weights[k] = 1;
      return true;
    }
  return barycentric(p, corner(0), corner(1), corner(2), corner(3), weights.data());
}

/// A tet that holds a point.
struct Hit {
  std::int32_t point, tet;
  double depth;  ///< the least weight; 1 at a vertex, which nothing holds better than its own tets
};

/// Tets stream past a k-d tree of the points. Meshes number neighbouring tets alike, so a run of tets asks the tree
/// once, and is halved where that finds too many points.
class PointTree {
 public:
  PointTree(const MeshView &mesh, Span<const Vec3> points, Job &job) : mesh_(mesh), points_(points), tree_(job.memory) {
    Array<Box> boxes(&job.memory);
    boxes.reserve(points.size());
    for (const Vec3 &p : points) boxes.push_back(box_at(p));
    tree_.build(std::move(boxes), 8, job);
  }

  /// The hits of the tets from `first` on that have these boxes.
  void find(std::size_t first, Span<const Box> boxes, Array<Hit> &hits) const {
    Box whole;
    for (const Box &box : boxes) whole.add(box);
    std::array<std::int32_t, enough> near;
    std::size_t found = 0;
    const bool too_many = tree_.any_overlap(whole, [&](std::int32_t i) {
      if (found == enough) return true;
      near[found++] = i;
      return false;
    });
    if (!too_many) {
      for (std::size_t k = 0; found && k < boxes.size(); k++) test(first + k, boxes[k], {near.data(), found}, hits);
    } else if (const std::size_t half = boxes.size() / 2; half > 0) {
      find(first, {boxes.data(), half}, hits);
      find(first + half, {boxes.data() + half, boxes.size() - half}, hits);
    } else {
      tree_.any_overlap(whole, [&](std::int32_t i) {
        add_hit(first, i, hits);
        return false;
      });
    }
  }

 private:
  static constexpr std::size_t enough = 8;

  void test(std::size_t t, const Box &box, Span<const std::int32_t> near, Array<Hit> &hits) const {
    for (std::int32_t i : near)
      if (overlap(box, box_at(points_[std::size_t(i)]))) add_hit(t, i, hits);
  }

  void add_hit(std::size_t t, std::int32_t i, Array<Hit> &hits) const {
    std::array<double, 4> w;
    if (!find_weights(mesh_, mesh_.tets[t], points_[std::size_t(i)], w)) return;
    const auto [least, most] = std::minmax({w[0], w[1], w[2], w[3]});
    const bool vertex = least == 0 && most == 1;
    if (least > -out_by_rounding) hits.push_back({i, std::int32_t(t), vertex ? 1 : std::min(least, most_of(t))});
  }

  double most_of(std::size_t t) const {
    const auto edge = [&](std::size_t k) { return corner(t, k) - corner(t, 0); };
    const double volume6 = det(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3));
    return is_flat(edge(1), edge(2), edge(3), volume6) ? barely_outside : 1;
  }
  const Vec3 &corner(std::size_t t, std::size_t k) const { return mesh_.points[std::size_t(mesh_.tets[t][k])]; }

  const MeshView &mesh_;
  Span<const Vec3> points_;
  KdTree tree_;
};

/// Of each point the best one alone, the lowest of those: a vertex is held by all of its tets.
void keep_best(Array<Hit> &hits) {
  std::sort(hits.begin(), hits.end(), [](const Hit &a, const Hit &b) {
    return std::make_tuple(a.point, -a.depth, a.tet) < std::make_tuple(b.point, -b.depth, b.tet);
  });
  const auto same_point = [](const Hit &a, const Hit &b) { return a.point == b.point; };
  hits.erase(std::unique(hits.begin(), hits.end(), same_point), hits.end());
}

/// Of each point the tet that holds it best, the lowest of those; -1: none.
Array<std::int32_t> find_tets(const MeshView &mesh, Span<const Vec3> points, std::int64_t leaf, Job &job) {
  const PointTree tree(mesh, points, job);
  const std::size_t run = std::min(std::size_t(leaf), tets_in_block);
  Array<Array<Hit>> hits((mesh.tets.size() + tets_in_block - 1) / tets_in_block, &job.memory);
  job.parallel.for_blocks(mesh.tets.size(), tets_in_block, [&](std::size_t begin, std::size_t end) {
    Array<Box> boxes(&job.memory);
    boxes.reserve(end - begin);
    for (std::size_t t = begin; t < end; t++) boxes.push_back(box_of(mesh.points, mesh.tets[t]));
    Array<Hit> all(&job.memory);
    for (std::size_t k = 0; k < boxes.size(); k += run)
      tree.find(begin + k, {boxes.data() + k, std::min(run, boxes.size() - k)}, all);
    keep_best(all);
    hits[begin / tets_in_block].assign(all.begin(), all.end());
    job.poll(0.5 * double(end) / double(mesh.tets.size()));
  });
  Array<std::int32_t> tets(points.size(), -1, &job.memory);
  Array<double> depth(points.size(), -out_by_rounding, &job.memory);
  for (const Array<Hit> &block : hits)
    for (const Hit &hit : block)
      if (const auto i = std::size_t(hit.point); hit.depth > depth[i]) {
        depth[i] = hit.depth;
        tets[i] = hit.tet;
      }
  return tets;
}

/// Without the rounding that makes a weight negative or the sum another than 1.
void settle(std::array<double, 4> &weights) {
  double total = 0;
  for (double &w : weights) total += w = std::max(w, 0.0);
  for (double &w : weights) w /= total;
}

void find_on_boundary(const TriangleTree &boundary, const Vec3 &p, Place &place) {
  const NearestPoint at = boundary.nearest(p);
  place.triangle = at.triangle;
  place.weights = {at.weights.x, at.weights.y, at.weights.z, 0};
  settle(place.weights);
}

}  // namespace

void locate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points, std::int64_t leaf, Job &job,
            Array<Place> &places) {
  places.assign(points.size(), Place());
  if (points.empty()) return;
  const Array<std::int32_t> tets = find_tets(mesh, points, leaf, job);
  job.parallel.for_blocks(points.size(), points_in_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      places[i].tet = tets[i];
      if (tets[i] < 0) continue;
      find_weights(mesh, mesh.tets[std::size_t(tets[i])], points[i], places[i].weights);
      settle(places[i].weights);
    }
    job.poll(0.5 + 0.4 * double(end) / double(points.size()));
  });
  if (std::all_of(places.begin(), places.end(), [](const Place &place) { return place.tet >= 0; })) return;
  const TriangleTree nearest(mesh.points, boundary, job);
  job.parallel.for_blocks(points.size(), points_in_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      if (places[i].tet < 0) find_on_boundary(nearest, points[i], places[i]);
    job.poll(0.9);
  });
}

}  // namespace tetlod
