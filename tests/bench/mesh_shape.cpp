#include "mesh_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "box_tree.hpp"
#include "vectors.hpp"

namespace bench {
namespace {

// ---- The boundary ----

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

std::vector<Triangle> sorted_faces(const std::vector<Tet> &tets) {
  std::vector<Triangle> faces;
  faces.reserve(4 * tets.size());
  for (const Tet &t : tets) {
    for (const Triangle &face :
         {Triangle{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}) {
      faces.push_back(sorted(face));
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// visit(first, uses) for each run of equal things.
template <class Thing, class Visit>
void for_runs(const std::vector<Thing> &things, const Visit &visit) {
  for (std::size_t i = 0, j; i < things.size(); i = j) {
    for (j = i + 1; j < things.size() && things[j] == things[i];) j++;
    visit(things[i], j - i);
  }
}

std::int64_t count_nonmanifold_edges(const std::vector<Triangle> &boundary) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(3 * boundary.size());
  for (const Triangle &t : boundary) {
    for (std::size_t k = 0; k < 3; k++) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  std::int64_t bad = 0;
  for_runs(edges, [&bad](const auto &, std::size_t uses) { bad += uses != 2; });
  return bad;
}

// ---- Distances ----

double distance2_to_segment(const Point &p, const Point &a, const Point &b) {
  const Point ab = minus(b, a), ap = minus(p, a);
  const double length2 = dot(ab, ab);
  const double along = length2 > 0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0.0;
  const Point off{ap[0] - along * ab[0], ap[1] - along * ab[1], ap[2] - along * ab[2]};
  return dot(off, off);
}

double distance2_to_triangle(const Point &p, const Point &a, const Point &b, const Point &c) {
  const Point normal = cross(minus(b, a), minus(c, a));
  const double area2 = dot(normal, normal);
  const auto left_of = [&](const Point &s, const Point &t) { return triple(minus(t, s), minus(p, s), normal) >= 0; };
  if (area2 > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a)) {
    const double off = dot(minus(p, a), normal);
    return off * off / area2;
  }
  return std::min({distance2_to_segment(p, a, b), distance2_to_segment(p, b, c), distance2_to_segment(p, c, a)});
}

class NearestTriangle {
 public:
  NearestTriangle(const Mesh &mesh, const std::vector<Triangle> &triangles)
      : mesh_(mesh), triangles_(triangles), tree_(boxes(mesh, triangles)) {}

  double distance(const Point &p) const {
    double best = Box::kInfinity;
    if (!tree_.nodes().empty()) search(0, p, best);
    return std::sqrt(best);
  }

 private:
  static std::vector<Box> boxes(const Mesh &mesh, const std::vector<Triangle> &triangles) {
    std::vector<Box> made;
    for (const Triangle &t : triangles) made.push_back(box_of(mesh.points, t));
    return made;
  }

  double distance2_to(const Triangle &t, const Point &p) const {
    return distance2_to_triangle(p, mesh_.points[std::size_t(t[0])], mesh_.points[std::size_t(t[1])],
                                 mesh_.points[std::size_t(t[2])]);
  }

  void search(std::size_t at, const Point &p, double &best) const {
    const BoxTree::Node &node = tree_.nodes()[at];
    if (node.box.distance2(p) >= best) return;
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; i++) {
        best = std::min(best, distance2_to(triangles_[tree_.order()[i]], p));
      }
      return;
    }
    const auto off = [&](std::size_t child) { return tree_.nodes()[child].box.distance2(p); };
    const bool right_first = off(node.right) < off(at + 1);
    search(right_first ? node.right : at + 1, p, best);
    search(right_first ? at + 1 : node.right, p, best);
  }

  const Mesh &mesh_;
  const std::vector<Triangle> &triangles_;
  BoxTree tree_;
};

double farthest(const Mesh &from, const std::vector<Triangle> &boundary, const NearestTriangle &to) {
  std::vector<bool> seen(from.points.size(), false);
  double most = 0;
  for (const Triangle &t : boundary) {
    Point centroid{};
    for (const std::int32_t corner : t) {
      const Point &p = from.points[std::size_t(corner)];
      for (std::size_t a = 0; a < 3; a++) centroid[a] += p[a] / 3;
      if (!seen[std::size_t(corner)]) most = std::max(most, to.distance(p));
      seen[std::size_t(corner)] = true;
    }
    most = std::max(most, to.distance(centroid));
  }
  return most;
}

}  // namespace

Shape shape_of(const Mesh &mesh) {
  Shape shape{};
  for_runs(sorted_faces(mesh.tets), [&shape](const Triangle &face, std::size_t uses) {
    if (uses == 1) shape.boundary.push_back(face);
    shape.over_shared += uses > 2;
  });
  for (const Tet &tet : mesh.tets) {
    const double volume = six_volumes(mesh, tet) / 6;
    shape.volume += std::fabs(volume);
    shape.not_positive += !(volume > 0);
  }
  shape.nonmanifold_edges = count_nonmanifold_edges(shape.boundary);
  return shape;
}

bool is_valid(const Shape &original, const Shape &result) {
  return result.not_positive == 0 && result.over_shared == 0 && result.nonmanifold_edges <= original.nonmanifold_edges;
}

double hausdorff(const Mesh &original, const Shape &original_shape, const Mesh &result, const Shape &result_shape) {
  const NearestTriangle to_original(original, original_shape.boundary), to_result(result, result_shape.boundary);
  const double there = farthest(original, original_shape.boundary, to_result);
  const double back = farthest(result, result_shape.boundary, to_original);
  return std::max(there, back) / box_of(original.points).diagonal();
}

}  // namespace bench
