#include "interpolate.hpp"

#include "geometry.hpp"
#include "kd_tree.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

/// A point this far out of a tet, in barycentric weight, is out by rounding.
constexpr double rounding = 1e-6;
constexpr std::size_t tets_in_block = 1 << 13;

Box box_of(const MeshView &mesh, const Tet &t) {
  Box box;
  for (std::int32_t v : t) box.add(mesh.points[std::size_t(v)]);
  return box;
}

Box box_at(const Vec3 &p) { return {p, p}; }

/// The tets whose boxes hold any of the points, in order.
Array<std::int32_t> find_candidates(const MeshView &mesh, Span<const Vec3> points, Job &job) {
  Array<Box> boxes(&job.memory);
  boxes.reserve(points.size());
  for (const Vec3 &p : points) boxes.push_back(box_at(p));
  KdTree tree(job.memory);
  tree.build(std::move(boxes), 8, [&] { job.poll(0); });
  Array<std::uint8_t> holds(mesh.tets.size(), 0, &job.memory);
  job.parallel.for_blocks(mesh.tets.size(), tets_in_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      holds[t] = tree.any_overlap(box_of(mesh, mesh.tets[t]), [](std::int32_t) { return true; });
    job.poll(0.5 * double(end) / double(mesh.tets.size()));
  });
  Array<std::int32_t> candidates(&job.memory);
  for (std::size_t t = 0; t < holds.size(); t++)
    if (holds[t]) candidates.push_back(std::int32_t(t));
  return candidates;
}

/// The mean of the values at the vertices; rounding does not take it beyond them.
template <class Vertices, class Weights>
double weighted_mean(const MeshView &mesh, const Vertices &vertices, const Weights &weights) {
  double sum = 0, total = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t k = 0; k < vertices.size(); k++) {
    const double value = mesh.scalars[std::size_t(vertices[k])];
    const double weight = std::max(weights[int(k)], 0.0);
    sum += weight * value;
    total += weight;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return std::clamp(sum / total, low, high);
}

class TetTree {
 public:
  TetTree(const MeshView &mesh, Array<std::int32_t> &&tets, std::int64_t leaf, Job &job)
      : mesh_(mesh), tets_(std::move(tets)), tree_(job.memory) {
    Array<Box> boxes(&job.memory);
    boxes.reserve(tets_.size());
    for (std::int32_t t : tets_) boxes.push_back(box_of(mesh, mesh.tets[std::size_t(t)]));
    tree_.build(std::move(boxes), leaf, [&] { job.poll(0.5); });
  }

  /// False when no tet holds p.
  bool value_at(const Vec3 &p, double &value) const {
    double best = -rounding;
    return tree_.any_overlap(box_at(p), [&](std::int32_t i) {
      const Tet &t = mesh_.tets[std::size_t(tets_[std::size_t(i)])];
      double w[4];
      if (!barycentric(p, mesh_.points[std::size_t(t[0])], mesh_.points[std::size_t(t[1])],
                       mesh_.points[std::size_t(t[2])], mesh_.points[std::size_t(t[3])], w))
        return false;
      const double least = std::min({w[0], w[1], w[2], w[3]});
      if (least > best) {
        best = least;
        value = weighted_mean(mesh_, t, w);
      }
      return best >= 0;
    }) || best > -rounding;
  }

 private:
  const MeshView &mesh_;
  Array<std::int32_t> tets_;
  KdTree tree_;
};

double value_on_boundary(const MeshView &mesh, Span<const Triangle> boundary, const NearestTriangle &nearest,
                         const Vec3 &p) {
  const NearestPoint at = nearest.nearest(p);
  return weighted_mean(mesh, boundary[std::size_t(at.triangle)], at.weights);
}

}  // namespace

void interpolate(const MeshView &mesh, Span<const Triangle> boundary, Span<const Vec3> points, std::int64_t leaf,
                 Job &job, Array<double> &values) {
  values.assign(points.size(), 0.0);
  if (points.empty()) return;
  const TetTree tets(mesh, find_candidates(mesh, points, job), leaf, job);
  Array<std::uint8_t> outside(points.size(), 0, &job.memory);
  job.parallel.for_blocks(points.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) outside[i] = !tets.value_at(points[i], values[i]);
    job.poll(0.5 + 0.4 * double(end) / double(points.size()));
  });
  if (std::find(outside.begin(), outside.end(), 1) == outside.end()) return;
  const NearestTriangle nearest(mesh.points, boundary, 8, job);
  job.parallel.for_blocks(points.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++)
      if (outside[i]) values[i] = value_on_boundary(mesh, boundary, nearest, points[i]);
    job.poll(0.9);
  });
}

}  // namespace tetlod
