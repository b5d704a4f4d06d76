#include "mesh_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nearest_triangle.hpp"
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

double farthest(const Mesh &from, const std::vector<Triangle> &boundary, const NearestTriangle &to) {
  std::vector<bool> seen(from.points.size(), false);
  double most = 0;
  const auto to_surface = [&to](const Point &p) { return std::sqrt(to.nearest(p).distance2); };
  for (const Triangle &t : boundary) {
    Point centroid{};
    for (const std::int32_t corner : t) {
      const Point &p = from.points[std::size_t(corner)];
      for (std::size_t a = 0; a < 3; a++) centroid[a] += p[a] / 3;
      if (!seen[std::size_t(corner)]) most = std::max(most, to_surface(p));
      seen[std::size_t(corner)] = true;
    }
    most = std::max(most, to_surface(centroid));
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
  const NearestTriangle to_original(original.points, original_shape.boundary),
      to_result(result.points, result_shape.boundary);
  const double there = farthest(original, original_shape.boundary, to_result);
  const double back = farthest(result, result_shape.boundary, to_original);
  return std::max(there, back) / box_of(original.points).diagonal();
}

}  // namespace bench
