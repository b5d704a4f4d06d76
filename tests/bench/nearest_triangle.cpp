#include "nearest_triangle.hpp"

#include <algorithm>

#include "vectors.hpp"

namespace bench {
namespace {

std::vector<Box> boxes_of(const std::vector<Point> &points, const std::vector<Triangle> &triangles) {
  std::vector<Box> made;
  made.reserve(triangles.size());
  for (const Triangle &t : triangles) made.push_back(box_of(points, t));
  return made;
}

using Weights = std::array<double, 3>;

struct Candidate {
  Weights weights;
  double distance2;
};

// The nearest point between corners i and j.
Candidate on_edge(const Point &p, const std::array<Point, 3> &corner, std::size_t i, std::size_t j) {
  const Point edge = minus(corner[j], corner[i]), to_p = minus(p, corner[i]);
  const double length2 = dot(edge, edge);
  const double along = length2 > 0 ? std::clamp(dot(to_p, edge) / length2, 0.0, 1.0) : 0.0;
  const Point off{to_p[0] - along * edge[0], to_p[1] - along * edge[1], to_p[2] - along * edge[2]};
  Candidate found{{}, dot(off, off)};
  found.weights[i] = 1 - along;
  found.weights[j] = along;
  return found;
}

Candidate on_triangle(const Point &p, const std::array<Point, 3> &corner) {
  const Point normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
  const double area2 = dot(normal, normal);
  const auto share = [&](std::size_t i, std::size_t j) {
    return dot(cross(minus(corner[j], corner[i]), minus(p, corner[i])), normal) / area2;
  };
  if (area2 > 0) {
    const Weights weights{share(1, 2), share(2, 0), share(0, 1)};
    if (*std::min_element(weights.begin(), weights.end()) >= 0) {
      const double off = dot(minus(p, corner[0]), normal);
      return {weights, off * off / area2};
    }
  }
  const Candidate edges[3] = {on_edge(p, corner, 0, 1), on_edge(p, corner, 1, 2), on_edge(p, corner, 2, 0)};
  return *std::min_element(edges, edges + 3,
                           [](const Candidate &a, const Candidate &b) { return a.distance2 < b.distance2; });
}

}  // namespace

NearestTriangle::NearestTriangle(const std::vector<Point> &points, const std::vector<Triangle> &triangles)
    : points_(points), triangles_(triangles), tree_(boxes_of(points, triangles)) {}

NearestPoint NearestTriangle::nearest(const Point &p) const {
  NearestPoint best;
  if (!tree_.nodes().empty()) search(0, p, best);
  return best;
}

void NearestTriangle::search(std::size_t at, const Point &p, NearestPoint &best) const {
  const BoxTree::Node &node = tree_.nodes()[at];
  if (node.box.distance2(p) >= best.distance2) return;
  if (node.right == 0) {
    for (std::size_t i = node.begin; i < node.end; i++) {
      const Triangle &t = triangles_[tree_.order()[i]];
      const Candidate found =
          on_triangle(p, {points_[std::size_t(t[0])], points_[std::size_t(t[1])], points_[std::size_t(t[2])]});
      if (found.distance2 < best.distance2) best = {t, found.weights, found.distance2};
    }
    return;
  }
  const auto off = [&](std::size_t child) { return tree_.nodes()[child].box.distance2(p); };
  const bool right_first = off(node.right) < off(at + 1);
  search(right_first ? node.right : at + 1, p, best);
  search(right_first ? at + 1 : node.right, p, best);
}

}  // namespace bench
