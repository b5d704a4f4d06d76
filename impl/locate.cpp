#include "locate.hpp"

#include "geometry.hpp"
#include "kd_tree.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

constexpr std::size_t points_in_block = 1 << 8;

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

/// Of the tets looked at that hold a point the one that holds it best, the lowest of those.
struct Hit {
  std::int32_t tet = -1;            ///< -1: none does
  double depth = -out_by_rounding;  ///< the least weight; 1 at a vertex, which nothing holds better than its own tets

  bool is_last() const { return depth >= 1; }
};

/// Tets stream past a k-d tree of the points. Meshes number neighbouring tets alike, so a run of tets asks the tree
/// once, and is halved where that finds too many points.
class PointTree {
 public:
  PointTree(const MeshView &mesh, Span<const Vec3> points, Span<const std::int32_t> solid, Job &job)
      : mesh_(mesh), points_(points), solid_(solid), tree_(job.memory) {
    tree_.build(boxes_of(points.size(), job, [&](std::size_t i) { return box_at(points[i]); }), 8, job);
  }

  /// The tets from `first` on have these boxes. hits: of each point.
  void find(std::size_t first, Span<const Box> boxes, Array<Hit> &hits) const {
    Box whole;
    for (const Box &box : boxes) whole.add(box);
    std::array<std::int32_t, enough> near;
    std::size_t found = 0;
    const bool too_many = tree_.any_overlap(whole, [&](std::int32_t i) {
      if (hits[std::size_t(i)].is_last()) return false;
      if (found == enough) return true;
      near[found++] = i;
      return false;
    });
    if (!too_many) {
      for (std::size_t i = 0; i < found; i++) look_into(first, boxes, std::size_t(near[i]), hits);
    } else if (const std::size_t half = boxes.size() / 2; half > 0) {
      find(first, {boxes.data(), half}, hits);
      find(first + half, {boxes.data() + half, boxes.size() - half}, hits);
    } else {
      tree_.any_overlap(whole, [&](std::int32_t i) {
        look_into(first, boxes, std::size_t(i), hits);
        return false;
      });
    }
  }

 private:
  static constexpr std::size_t enough = 8;

  void look_into(std::size_t first, Span<const Box> boxes, std::size_t point, Array<Hit> &hits) const {
    const Box at = box_at(points_[point]);
    Hit &best = hits[point];
    for (std::size_t k = 0; k < boxes.size() && !best.is_last(); k++)
      if (overlap(boxes[k], at) && may_hold(first + k, point)) look_into(first + k, points_[point], best);
  }

  bool may_hold(std::size_t t, std::size_t point) const {
    return solid_.empty() || may_be_one(solid_[point], solid_of(mesh_.solid, mesh_.tets[t]));
  }

  void look_into(std::size_t t, const Vec3 &p, Hit &best) const {
    std::array<double, 4> w;
    if (!find_weights(mesh_, mesh_.tets[t], p, w)) return;
    const auto [least, most] = std::minmax({w[0], w[1], w[2], w[3]});
    if (!(least > -out_by_rounding)) return;
    const double depth = least == 0 && most == 1 ? 1 : std::min(least, most_of(t));
    if (depth > best.depth) best = {std::int32_t(t), depth};
  }

  double most_of(std::size_t t) const {
    const auto edge = [&](std::size_t k) { return corner(t, k) - corner(t, 0); };
    const double volume6 = det(corner(t, 0), corner(t, 1), corner(t, 2), corner(t, 3));
    return is_flat(edge(1), edge(2), edge(3), volume6) ? barely_outside : 1;
  }
  const Vec3 &corner(std::size_t t, std::size_t k) const { return mesh_.points[std::size_t(mesh_.tets[t][k])]; }

  const MeshView &mesh_;
  Span<const Vec3> points_;
  Span<const std::int32_t> solid_;
  KdTree tree_;
};

/// Without the rounding that makes a weight negative or the sum another than 1.
void settle(std::array<double, 4> &weights) {
  double total = 0;
  for (double &w : weights) total += w = std::max(w, 0.0);
  for (double &w : weights) w /= total;
}

void find_on_boundary(const NearestPoint &at, Place &place) {
  place.triangle = at.triangle;
  place.weights = {at.weights.x, at.weights.y, at.weights.z, 0};
  settle(place.weights);
}

}  // namespace

/// Each part of the tets has hits of its own.
Array<std::int32_t> find_tets(const MeshView &mesh, Span<const Vec3> points, Span<const std::int32_t> solid,
                              std::int64_t leaf, Job &job) {
  constexpr std::size_t most_parts = 16, most_boxes = 1 << 12;  // for memory's sake
  const PointTree tree(mesh, points, solid, job);
  const std::size_t run = std::min(std::size_t(leaf), most_boxes);
  const std::size_t size = mesh.tets.size() / std::min(std::size_t(job.parallel.threads()), most_parts) + 1;
  Array<Array<Hit>> hits(mesh.tets.size() / size + 1, &job.memory);
  job.parallel.for_blocks(mesh.tets.size(), size, [&](std::size_t begin, std::size_t end) {
    hits[begin / size].resize(points.size());
    Array<Box> boxes(&job.memory);
    for (std::size_t t = begin; t < end; t += boxes.size()) {
      boxes.clear();
      for (std::size_t k = t; k < std::min(end, t + run); k++) boxes.push_back(box_of(mesh.points, mesh.tets[k]));
      tree.find(t, {boxes.data(), boxes.size()}, hits[begin / size]);
      job.poll(0.5 * double(t) / double(mesh.tets.size()));  // parts begin in order: never backwards
    }
  });
  Array<std::int32_t> tets(points.size(), -1, &job.memory);
  Array<double> depth(points.size(), -out_by_rounding, &job.memory);
  for (const Array<Hit> &part : hits)
    for (std::size_t i = 0; i < part.size(); i++)
      if (part[i].depth > depth[i]) {
        depth[i] = part[i].depth;
        tets[i] = part[i].tet;
      }
  return tets;
}

void locate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points,
            Span<const std::int32_t> solid, std::int64_t leaf, Job &job, Array<Place> &places) {
  places.assign(points.size(), Place());
  if (points.empty()) return;
  const Array<std::int32_t> tets = find_tets(mesh, points, solid, leaf, job);
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
  const TriangleTree tree(mesh.points, boundary, job);
  const auto nearest_to = [&](std::size_t i) {
    if (solid.empty()) return tree.nearest(points[i]);
    return tree.nearest_among(points[i], [&](std::int32_t t) {
      return may_be_one(solid[i], solid_of(mesh.solid, boundary[std::size_t(t)]));
    });
  };
  job.parallel.for_blocks(points.size(), points_in_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      if (places[i].tet < 0) find_on_boundary(nearest_to(i), places[i]);
    job.poll(0.9);
  });
}

}  // namespace tetlod
