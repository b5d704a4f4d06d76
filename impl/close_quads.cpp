#include "close_quads.hpp"

#include <algorithm>
#include <utility>

#include "crossed_quads.hpp"
#include "flat_tets.hpp"

namespace tetlod {

namespace {

/// After some there are no more to turn, but where tets overlap.
constexpr int most_rounds = 50;

class ClosingQuads {
 public:
  ClosingQuads(NumberedTets &&solid, Job &job)
      : job_(job),
        triangles_(std::move(solid.boundary.triangles)),
        tet_of_(std::move(solid.boundary.tet_of)),
        mesh_(std::move(solid), job),
        at_gap_(mesh_.view().points.size(), 0, &job.memory) {}

  /// One side comes to have the edges of the other, as long as a quad has two of these; then both come to be Delaunay.
  void close(NumberedTets &solid, bool is_divided) {
    bool has_gaps = is_divided, are_alike = false;
    for (int round = 0; round < most_rounds; round++) {
      const TriangleCorners corners(mesh_.view().points.size(), triangles_, job_);
      bool any = add_flat_tets(crossed_quads(corners, are_alike));
      has_gaps = has_gaps || any;
      are_alike = are_alike || !any;
      any = any || (has_gaps && add_flat_tets(find_slanted_quads(mesh_.view(), corners, tet_of_, job_)));
      if (!any) break;
      mesh_.give_way();
      mesh_.find_outward_boundary(triangles_, tet_of_);
    }
    mesh_.settle();
    mesh_.give(solid);
  }

 private:
  Array<CrossedQuad> crossed_quads(const TriangleCorners &corners, bool closed_only) {
    Array<CrossedQuad> quads = find_crossed_quads(mesh_.view(), corners, tet_of_, at_gap_, job_);
    const auto goes = [&](const CrossedQuad &quad) { return closed_only && !quad.is_closed(); };
    quads.erase(std::remove_if(quads.begin(), quads.end(), goes), quads.end());
    return quads;
  }

  /// Whether some are.
  bool add_flat_tets(Span<const CrossedQuad> quads) {
    const std::size_t before = mesh_.count();
    const Array<Triangle> inner = mesh_.inner_faces();
    const auto is_inner = [&](const Tet &tet, int k) {
      return std::binary_search(inner.begin(), inner.end(), sorted_face(tet, k));
    };
    for (const CrossedQuad &quad : quads) {
      if (!quad.is_closed() && (is_inner(quad.tet, 0) || is_inner(quad.tet, 1))) continue;  // of two tets already
      if (are_of_one_tet(quad.one) || (quad.is_closed() && are_of_one_tet(quad.other))) continue;
      mesh_.add(quad.tet, tet_of_[std::size_t(quad.one[0])]);
    }
    return mesh_.count() > before;
  }

  /// Which has all four vertices already.
  bool are_of_one_tet(const std::array<std::int32_t, 2> &triangles) const {
    return tet_of_[std::size_t(triangles[0])] == tet_of_[std::size_t(triangles[1])];
  }

  Job &job_;
  Array<Triangle> triangles_;   // of the boundary
  Array<std::int32_t> tet_of_;  // of each
  FlatTets mesh_;
  Array<std::uint8_t> at_gap_;  // of each vertex
};

}  // namespace

void close_crossed_quads(bool is_divided, Job &job, NumberedTets &solid) {
  ClosingQuads(std::move(solid), job).close(solid, is_divided);
}

}  // namespace tetlod
