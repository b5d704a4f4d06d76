// 3.2  What makes the collapse of a boundary edge inadmissible, apart from topology: one rule, one function.
#pragma once
#include <cstdint>

#include "geometry.hpp"
#include "mesh.hpp"

namespace tetlod {

/// Links of more vertices than this are left alone: nothing of use comes from such a collapse.
constexpr std::size_t longest_ring = 64;

/// The collapse of an edge to `centre`. Ring vertices are in order around it, counter-clockwise seen from outside;
/// spoke i is the triangle (centre, ring i, ring i + 1).
struct Star {
  explicit Star(Memory &memory)
      : ring(&memory),
        ring_id(&memory),
        old_normal(&memory),
        outer_normal(&memory),
        old_faces(&memory),
        normal(&memory),
        spoke_box(&memory) {}

  Vec3 centre{0};
  std::int32_t centre_id = 0;  ///< id that no ring vertex has
  double old_quality = 1;      ///< the worst triangle before
  Array<Vec3> ring;
  Array<std::int32_t> ring_id;    ///< points that are the same in the uncut surface have the same id
  Array<Vec3> old_normal;         ///< area vector of the triangle that spoke i replaces
  Array<Vec3> outer_normal;       ///< area vector of the triangle on the other side of ring edge i
  Array<std::int32_t> old_faces;  ///< all triangles that go: the two at the edge, then those that become spokes
  Array<Vec3> normal;             ///< area vector of spoke i, made by find_spokes
  Array<Box> spoke_box;           ///< of spoke i, likewise

  std::size_t size() const { return ring.size(); }
  /// The triangle that is spoke i afterwards: the first two of old_faces disappear.
  std::int32_t spoke_face(std::size_t i) const { return old_faces[i + 2]; }
  std::size_t after(std::size_t i) const { return i + 1 == ring.size() ? 0 : i + 1; }
  void clear();
  void find_spokes();  ///< normal and spoke_box, from the rest
};

/// The ring passes twice through one point of the uncut surface: two edges of the star would be one. The link
/// condition, where the surface is not cut.
bool pinches_ring(const Star &star);
/// It lies out of the box of all that is around the edge, by more than this part of the box's diagonal: where normals
/// nearly cancel out, as at the rim of a plate, a place that keeps the volume may be far away.
bool strays(const Star &star, const Vec3 &end, const Vec3 &other_end, double most);
/// A triangle's normal turns further than is likely on a smooth surface, or flips.
bool turns_too_far(const Star &star);
/// Two neighbouring triangles become a fold: the surface nearly lies back on itself.
bool folds(const Star &star);
/// It folds, and the sine of half the sharpest angle is less than this part of what it was.
bool sharpens(const Star &star, double kept);
/// A triangle gets worse than a sliver, and keeps less than this part of the quality of the worst that there was.
bool makes_sliver(const Star &star, double kept = 1);

}  // namespace tetlod
