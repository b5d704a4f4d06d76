#include "hanging_vertices.hpp"

#include <algorithm>

#include "first_culprit.hpp"
#include "lies_on.hpp"

namespace tetlod {

namespace {

class HangingVertices {
 public:
  HangingVertices(const MeshView &mesh, const TriangleCorners &corners, Job &job)
      : mesh_(mesh),
        corners_(corners),
        job_(job),
        rounding_(rounding_of_six_digits(mesh.points, corners.triangles())) {}

  Array<HangingVertex> find() const {
    Array<HangingVertex> found(&job_.memory);
    look_at_vertices(0, mesh_.points.size(), [&](const HangingVertex &hanging) { found.push_back(hanging); });
    return found;
  }

  bool any() const {
    FirstCulprit culprit;
    job_.parallel.for_blocks(mesh_.points.size(), block, [&](std::size_t begin, std::size_t end) {
      if (culprit.any()) return;
      look_at_vertices(begin, end, [&](const HangingVertex &hanging) { culprit.report(std::size_t(hanging.vertex)); });
    });
    return culprit.any();
  }

 private:
  static constexpr std::size_t block = 1024;

  /// visit(hanging): each with an edge to an end of its edge.
  template <class Visit>
  void look_at_vertices(std::size_t begin, std::size_t end, const Visit &visit) const {
    for (std::size_t v = begin; v < end; v++) {
      if (v % 256 == 0) job_.poll(0.9);  // at some there is much to look at
      const Span<const Corner> at = corners_.of(std::int32_t(v));
      for (std::size_t i = 1; i < at.size(); i++)
        for (std::size_t j = 0; j < i; j++) look_at(std::int32_t(v), at[i], at[j], visit);
    }
  }

  Vec3 way(std::int32_t from, std::int32_t to) const {
    return mesh_.points[std::size_t(to)] - mesh_.points[std::size_t(from)];
  }

  /// At two edges of vertex v.
  template <class Visit>
  void look_at(std::int32_t v, const Corner &one, const Corner &other, const Visit &visit) const {
    std::int32_t near = one.next, far = other.next;
    if (near == far || near == other.last || far == one.last) return;  // of one triangle
    if (length2(way(v, near)) > length2(way(v, far))) std::swap(near, far);
    const HangingVertex hanging{near, v, far};
    if (lies_on(way(v, near), way(v, far), rounding_) &&
        (lie_on_one_another(hanging, false) || lie_on_one_another(hanging, true)))
      visit(hanging);
  }

  /// Whether triangles do on one side of the edges: what is outside of the one solid is inside of the other.
  bool lie_on_one_another(const HangingVertex &h, bool side) const {
    const Span<const Corner> corners = corners_.of(h.from);
    for (const Corner &coarse : corners)
      for (const Corner &fine : corners)
        if ((side ? coarse.last : coarse.next) == h.to && (side ? fine.next : fine.last) == h.vertex &&
            are_back_to_back(normal(coarse.triangle), normal(fine.triangle)))
          return true;
    return false;
  }

  Vec3 normal(std::int32_t triangle) const {
    const Triangle &t = corners_.triangles()[std::size_t(triangle)];
    return glm::cross(way(t[0], t[1]), way(t[0], t[2]));
  }

  const MeshView &mesh_;
  const TriangleCorners &corners_;
  Job &job_;
  double rounding_;
};

}  // namespace

Array<HangingVertex> find_hanging_vertices(const MeshView &mesh, const TriangleCorners &corners, Job &job) {
  return HangingVertices(mesh, corners, job).find();
}

bool any_hanging_vertices(const MeshView &mesh, const TriangleCorners &corners, Job &job) {
  return HangingVertices(mesh, corners, job).any();
}

}  // namespace tetlod
