#include "flat_layers.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "crossed_quads.hpp"
#include "triangle_corners.hpp"

namespace tetlod {

namespace {

/// Few quads are left after a few rounds, but where tets overlap.
constexpr int most_rounds = 20;

class FlatLayers {
 public:
  FlatLayers(NumberedTets &solid, Job &job)
      : solid_(solid),
        job_(job),
        triangles_(solid.boundary.triangles, &job.memory),
        tet_of_(solid.boundary.tet_of, &job.memory) {}

  /// One side comes to have the edges of the other, as long as a quad has two of these; then both come to be Delaunay.
  void add() {
    bool are_alike = false;
    for (int round = 0; round < most_rounds; round++) {
      const TriangleCorners corners(solid_.points.size(), triangles_, job_);
      Array<CrossedQuad> quads = find_crossed_quads(solid_.view(), corners, tet_of_, job_);
      are_alike = are_alike || quads.empty();
      if (are_alike) keep_closed(quads);
      if (quads.empty()) quads = find_slanted_quads(solid_.view(), corners, tet_of_, job_);
      const std::size_t before = solid_.tets.size();
      for (const CrossedQuad &quad : quads)
        if (!is_tet_turned_back(quad)) add(quad);
      if (solid_.tets.size() == before) break;
      cover_twins();
      drop_covered();
    }
  }
  bool cover_all() const { return triangles_.empty(); }

 private:
  void add(const CrossedQuad &quad) {
    const auto [x, y, u, v] = quad.tet;
    const auto tet = std::int32_t(solid_.tets.size());
    solid_.number.push_back(solid_.number[std::size_t(tet_of_[std::size_t(quad.one[0])])]);
    solid_.tets.push_back(quad.tet);
    for (const std::int32_t t : quad.one) cover(t);
    if (quad.is_closed())
      for (const std::int32_t t : quad.other) cover(t);
    else
      for (const Triangle &t : {Triangle{v, y, u}, Triangle{u, x, v}}) {
        triangles_.push_back(t);
        tet_of_.push_back(tet);
      }
  }

  static void keep_closed(Array<CrossedQuad> &quads) {
    quads.erase(std::remove_if(quads.begin(), quads.end(), [](const CrossedQuad &quad) { return !quad.is_closed(); }),
                quads.end());
  }

  /// Both triangles are of one tet, which has all four vertices already.
  bool is_tet_turned_back(const CrossedQuad &quad) const {
    const auto of_one_tet = [&](const std::array<std::int32_t, 2> &pair) {
      return tet_of_[std::size_t(pair[0])] == tet_of_[std::size_t(pair[1])];
    };
    return of_one_tet(quad.one) || (quad.is_closed() && of_one_tet(quad.other));
  }

  void cover(std::int32_t t) { tet_of_[std::size_t(t)] = -1; }

  /// Triangles that both sides have.
  void cover_twins() {
    Array<std::pair<Triangle, std::int32_t>> sorted(&job_.memory);
    for (std::size_t t = 0; t < triangles_.size(); t++) {
      if (tet_of_[t] < 0) continue;
      sorted.push_back({triangles_[t], std::int32_t(t)});
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end(), PollingLess(job_, 0.9, std::less<std::pair<Triangle, std::int32_t>>()));
    for (std::size_t i = 1; i < sorted.size(); i++)
      if (sorted[i].first == sorted[i - 1].first) {
        cover(sorted[i].second);
        cover(sorted[i - 1].second);
      }
  }
  void drop_covered() {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); t++) {
      if (tet_of_[t] < 0) continue;
      triangles_[kept] = triangles_[t];
      tet_of_[kept++] = tet_of_[t];
    }
    triangles_.resize(kept);
    tet_of_.resize(kept);
  }

  NumberedTets &solid_;
  Job &job_;
  Array<Triangle> triangles_;   // of the boundary with the tets
  Array<std::int32_t> tet_of_;  // -1: covered
};

}  // namespace

bool add_flat_layers(Job &job, NumberedTets &solid) {
  FlatLayers layers(solid, job);
  layers.add();
  return !layers.cover_all();
}

}  // namespace tetlod
