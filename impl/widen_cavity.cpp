#include "widen_cavity.hpp"

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// Tets that give way beside those around the edge; where it takes more, the collapse is a bad one.
constexpr std::size_t most_beyond = 12;
/// Of the tets at the edge, what a collapse has to save.
constexpr double least_saved = 0.5;

/// Of one tet of the cavity alone.
struct OuterFace {
  Triangle vertices;  // clockwise, seen from inside
  std::int32_t tet;
  bool is_seen;
};

class GrowingCavity {
 public:
  GrowingCavity(const SolidComplex &mesh, const SolidBlocks &blocks, const Vec3 &place, SolidEdge &edge)
      : mesh_(mesh), blocks_(blocks), place_(place), edge_(edge) {}

  /// With the tets around the edge. False where there are too many.
  bool begin() {
    edge_.cavity.clear();
    edge_.fresh.clear();
    if (edge_.tets_around() + most_beyond > largest_cavity) return false;
    for (std::int32_t t : edge_.edge_tets) edge_.cavity.push(t);
    add_star(edge_.stays_tets, edge_.stays);
    add_star(edge_.gone_tets, edge_.gone);
    return true;
  }

  /// Until all is seen.
  bool grow() {
    const auto is_unseen = [](const OuterFace &face) { return !face.is_seen; };
    for (;;) {
      const auto unseen = std::find_if(outer_.begin(), outer_.end(), is_unseen);
      if (unseen == outer_.end()) return true;
      if (!take_beyond(*unseen)) return false;
    }
  }

  /// With the cones over what is seen.
  bool fill() {
    const double saved = double(edge_.cavity.size()) - double(outer_.size());
    if (saved < least_saved * double(edge_.edge_tets.size())) return false;
    for (const OuterFace &face : outer_) {
      const Triangle &f = face.vertices;
      edge_.fresh.push({edge_.stays, f[0], f[1], f[2]});
    }
    return keeps_vertices();
  }

 private:
  void add_star(Span<const std::int32_t> tets, std::int32_t end) {
    for (std::int32_t t : tets) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      edge_.cavity.push(t);
      add_outer(face_opposite(tet, std::size_t(std::find(tet.begin(), tet.end(), end) - tet.begin())), t);
    }
  }

  void add_outer(const Triangle &vertices, std::int32_t tet) { outer_.push({vertices, tet, is_seen(vertices)}); }

  bool is_seen(const Triangle &face) const {
    const Vec3 &a = mesh_.point(face[0]), &b = mesh_.point(face[1]), &c = mesh_.point(face[2]);
    return det(place_, a, b, c) > 0 && shape2(place_, a, b, c) >= mesh_.measures.least_shape2;
  }

  /// The tet beyond joins the cavity, if it is not in it: faces between tets of the cavity are outer ones no more.
  bool take_beyond(const OuterFace &face) {
    const Triangle vertices = face.vertices;
    const std::int32_t t = tet_beyond(face);
    if (t < 0) return false;
    remove(vertices);
    if (edge_.cavity.has(t)) return remove(vertices);
    const Tet &tet = mesh_.tets[std::size_t(t)];
    if (taken_++ == most_beyond || !blocks_.holds(tet, edge_.stays)) return false;
    edge_.cavity.push(t);
    for (std::size_t k = 0; k < 4; k++) {
      const Triangle other = face_opposite(tet, k);
      if (!has_all(other, vertices) && !remove(other)) add_outer(other, t);
    }
    return true;
  }

  std::int32_t tet_beyond(const OuterFace &face) const {
    for (std::int32_t t : mesh_.tets_of.of(face.vertices[0]))
      if (t != face.tet && mesh_.has_tet(t) && has_all(mesh_.tets[std::size_t(t)], face.vertices)) return t;
    return -1;
  }

  /// False: there is no such outer face.
  bool remove(const Triangle &vertices) {
    const auto is_same = [&](const OuterFace &face) { return has_all(face.vertices, vertices); };
    const auto found = std::find_if(outer_.begin(), outer_.end(), is_same);
    if (found == outer_.end()) return false;
    for (std::int32_t v : vertices) covered_.push(v);
    *found = outer_[outer_.size() - 1];
    outer_.pop();
    return true;
  }

  /// A vertex whose faces have all become inner ones would go.
  bool keeps_vertices() const {
    return std::all_of(covered_.begin(), covered_.end(), [&](std::int32_t v) {
      return std::any_of(edge_.fresh.begin(), edge_.fresh.end(), [&](const Tet &t) { return has(t, v); });
    });
  }

  const SolidComplex &mesh_;
  const SolidBlocks &blocks_;
  const Vec3 place_;
  SolidEdge &edge_;
  Few<OuterFace, largest_cavity + 2 * most_beyond> outer_;
  Few<std::int32_t, 3 * (largest_cavity + 3 * most_beyond)> covered_;  // vertices of faces that became inner ones
  std::size_t taken_ = 0;
};

}  // namespace

bool widen_cavity(const SolidComplex &mesh, const SolidBlocks &blocks, const Vec3 &place, SolidEdge &edge) {
  GrowingCavity cavity(mesh, blocks, place, edge);
  if (cavity.begin() && cavity.grow() && cavity.fill()) return true;
  edge.fresh.clear();
  return false;
}

}  // namespace tetlod
