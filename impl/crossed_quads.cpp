#include "crossed_quads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "predicates.hpp"

namespace tetlod {

namespace {

class CrossedQuads {
 public:
  CrossedQuads(const MeshView &mesh, Span<const Triangle> triangles, Span<const std::int32_t> tet_of, Job &job)
      : mesh_(mesh),
        triangles_(triangles),
        tet_of_(tet_of),
        job_(job),
        taken_(triangles.size(), 0, &job.memory),
        found_(&job.memory) {}

  Array<CrossedQuad> find() {
    for (std::size_t i = 0; i < triangles_.size(); i++) {
      job_.poll_at(i, 0.9);
      find_from(i);
    }
    return std::move(found_);
  }

 private:
  Triangle sorted(std::size_t i) const {
    Triangle t = triangles_[i];
    std::sort(t.begin(), t.end());
    return t;
  }

  /// From triangle i on; as many as there are: there is none.
  std::size_t find_triangle(std::size_t i, const Triangle &corners) const {
    std::size_t last = triangles_.size();
    while (i < last) {
      const std::size_t middle = i + (last - i) / 2;
      if (sorted(middle) < corners)
        i = middle + 1;
      else
        last = middle;
    }
    return i < triangles_.size() && sorted(i) == corners ? i : triangles_.size();
  }

  /// Those whose three lowest corners are those of triangle i. Where very many triangles are at an edge there are none.
  void find_from(std::size_t i) {
    constexpr std::size_t most_at_edge = 64;
    const Triangle lowest = sorted(i);
    for (std::size_t j = i + 1; j < std::min(triangles_.size(), i + most_at_edge); j++) {
      const Triangle next = sorted(j);
      if (next[0] != lowest[0] || next[1] != lowest[1]) return;
      const auto [a, b, c, d] = std::tuple(lowest[0], lowest[1], lowest[2], next[2]);
      const std::size_t without_b = find_triangle(j, {a, c, d});
      if (without_b == triangles_.size()) continue;
      const std::size_t without_a = find_triangle(without_b, {b, c, d});
      if (without_a == triangles_.size()) continue;
      const CrossedQuad quad{{a, b, c, d}, {without_a, without_b, j, i}};
      if (is_crossed(quad)) take(quad);
    }
  }

  void take(const CrossedQuad &quad) {
    for (const std::size_t t : quad.triangles) taken_[t] = 1;
    found_.push_back(quad);
  }

  const Vec3 &at(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }

  bool is_crossed(const CrossedQuad &quad) const {
    return has_next_to_no_volume(quad.corners) &&
           std::none_of(quad.triangles.begin(), quad.triangles.end(), [&](std::size_t t) {
             return taken_[t] || is_inside(quad.corners, mesh_.tets[std::size_t(tet_of_[t])]);
           });
  }

  bool has_next_to_no_volume(const Tet &t) const {
    constexpr double most = 0.1;
    Vec3 sides[3];
    double longest = 0;
    for (std::size_t k = 0; k < 3; k++) {
      sides[k] = at(t[k + 1]) - at(t[0]);
      for (int i = 0; i < 3; i++) longest = std::max(longest, std::abs(sides[k][i]));
    }
    return std::abs(glm::dot(glm::cross(sides[0] / longest, sides[1] / longest), sides[2] / longest)) <= most;
  }

  /// Then the quad is a thin solid. The tet has three of its corners.
  bool is_inside(const Tet &corners, const Tet &tet) const {
    const auto is_another = [&](std::int32_t v) { return !std::binary_search(corners.begin(), corners.end(), v); };
    const auto apex = std::find_if(tet.begin(), tet.end(), is_another);
    if (apex == tet.end()) return true;  // it is that tet
    const int side = side_of(corners);
    for (std::size_t k = 0; k < 4; k++) {
      Tet replaced = corners;
      replaced[k] = *apex;
      if (side == 0 || side_of(replaced) != side) return false;
    }
    return true;
  }

  int side_of(const Tet &t) const { return orientation(at(t[0]), at(t[1]), at(t[2]), at(t[3])); }

  const MeshView &mesh_;
  Span<const Triangle> triangles_;
  Span<const std::int32_t> tet_of_;
  Job &job_;
  Array<std::uint8_t> taken_;  // of each triangle, whether a quad has it
  Array<CrossedQuad> found_;
};

}  // namespace

Array<CrossedQuad> find_crossed_quads(const MeshView &mesh, Span<const Triangle> triangles,
                                      Span<const std::int32_t> tet_of, Job &job) {
  return CrossedQuads(mesh, triangles, tet_of, job).find();
}

}  // namespace tetlod
