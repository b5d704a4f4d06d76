#include "vertices_on_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "lies_on.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

/// Nearer to a corner or an edge, for their length, or a height, vertices are too near to be inside.
constexpr double least = 1e-3;
/// Whose boxes meet that of one: more are not looked at.
constexpr int most_others = 2000;

class VerticesOnTriangles {
 public:
  VerticesOnTriangles(Span<const Vec3> points, Span<const Triangle> triangles, Job &job)
      : points_(points),
        triangles_(triangles),
        job_(job),
        tree_(points, triangles, job),
        rounding_(rounding_of_six_digits(points, triangles)) {}

  Array<VertexOnTriangle> find() const {
    job_.poll(0.9);  // of what is cancelled parts of the tree are missing
    constexpr VertexOnTriangle none{-1, -1, -1};
    Array<VertexOnTriangle> found(triangles_.size(), none, &job_.memory);
    job_.parallel.for_blocks(found.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; t++) found[t] = middlemost_on(std::int32_t(t));
      job_.poll(0.9);
    });
    const auto is_none = [](const VertexOnTriangle &on) { return on.vertex < 0; };
    found.erase(std::remove_if(found.begin(), found.end(), is_none), found.end());
    return found;
  }

 private:
  struct Place {
    int opposite;   // of VertexOnTriangle
    double to_rim;  // along the edge, or inside, in weight
  };

  const Vec3 &at(std::int32_t v) const { return points_[std::size_t(v)]; }
  Vec3 normal(const Triangle &t) const { return area_vector(points_, t); }

  VertexOnTriangle middlemost_on(std::int32_t t) const {
    const Triangle &triangle = triangles_[std::size_t(t)];
    const Vec3 outward = normal(triangle);
    VertexOnTriangle middlemost{-1, t, -1};
    double most = least;
    bool has_common_corner = false;
    int looked_at = 0;
    tree_.any_near(t, [&](std::int32_t other) {
      const Triangle &corners = triangles_[std::size_t(other)];
      if (!are_back_to_back(outward, normal(corners))) return ++looked_at > most_others;
      for (const std::int32_t v : corners) {
        if (has(triangle, v)) {
          has_common_corner = true;
          continue;
        }
        const Place place = place_on(triangle, outward, at(v));
        const bool is_first_on_edge = place.opposite >= 0 && middlemost.opposite < 0;
        const bool is_only_inside = place.opposite < 0 && middlemost.opposite >= 0;
        if (is_only_inside || place.to_rim <= (is_first_on_edge ? least : most)) continue;
        middlemost = {v, t, place.opposite};
        most = place.to_rim;
      }
      return ++looked_at > most_others;
    });
    return has_common_corner ? middlemost : VertexOnTriangle{-1, t, -1};
  }

  /// Nowhere: no farther than nothing from the rim.
  Place place_on(const Triangle &t, const Vec3 &outward, const Vec3 &p) const {
    double inside = 1;
    for (int k = 0; k < 3; k++) {
      const Vec3 &from = at(t[std::size_t(k + 1) % 3]), &to = at(t[std::size_t(k + 2) % 3]);
      const double to_rim = along_edge(p - from, to - from);
      if (to_rim > 0) return {k, to_rim};
      inside = std::min(inside, glm::dot(area_vector(p, from, to), outward) / length2(outward));
    }
    return {-1, lies_in_plane(t, outward, p) ? inside : 0};
  }

  /// How far from its ends, in its length; 0: not on it.
  double along_edge(const Vec3 &way, const Vec3 &edge) const {
    const double share = glm::dot(way, edge) / length2(edge);
    return lies_on(way, edge, rounding_) ? std::min(share, 1 - share) : 0;
  }

  bool lies_in_plane(const Triangle &t, const Vec3 &outward, const Vec3 &p) const {
    const double off = glm::dot(outward, p - at(t[0])), off2 = off * off, area2 = length2(outward);
    double nearest2 = length2(p - at(t[0]));
    for (const std::int32_t v : t) nearest2 = std::min(nearest2, length2(p - at(v)));
    return off2 <= rounding_ * rounding_ * area2 && off2 <= least * least * nearest2 * area2;
  }

  Span<const Vec3> points_;
  Span<const Triangle> triangles_;
  Job &job_;
  TriangleTree tree_;
  double rounding_;
};

}  // namespace

Array<VertexOnTriangle> find_vertices_on_triangles(Span<const Vec3> points, Span<const Triangle> triangles, Job &job) {
  return VerticesOnTriangles(points, triangles, job).find();
}

}  // namespace tetlod
