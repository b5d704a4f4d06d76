// The solids of a surface: which can be remeshed each for itself.
#pragma once
#include <cstdint>
#include <utility>

#include "disjoint_sets.hpp"
#include "job.hpp"
#include "kd_tree.hpp"
#include "mesh.hpp"
#include "remesh_checks.hpp"
#include "remesh_frame.hpp"

namespace tetlod {

/// A solid is a shell, triangles connected through vertices, with material in it, and the shells of the cavities in
/// that material. What lies in a cavity is a solid of its own; what only touches at a vertex is one shell. Where shells
/// overlap or are too flat to tell, all is one solid.
class Solids {
 public:
  /// `surface` has passed check_surface(), and lives as long as this.
  Solids(const Surface &surface, const SurfaceFacts &facts, Job &job);

  std::int32_t count() const { return count_; }
  /// Of a point of the surface.
  std::int32_t of_point(std::size_t point) const;
  /// Shells that a ray meets, and whether it comes in (1) or goes out (-1): room for holding(), which one thread uses.
  using Crossings = Array<std::pair<std::int32_t, std::int32_t>>;
  /// The solid in whose material p lies; -1: none, or p lies on a shell. Where only one solid can be meant, it is not
  /// looked at more closely. To be asked where there are several.
  std::int32_t holding(const Vec3 &p, Crossings &room) const;

 private:
  struct Shell {
    std::int32_t lowest = -1;  // its point that is the first by x, then y, then z
    double volume = 0;         // below zero: of a cavity
    Box box;
    bool crowded = false;  // another's box meets this one's
    std::int32_t solid = 0;
  };

  void find_shells(Job &job);
  bool measure_shells(Job &job);
  void find_crowded(Job &job);
  bool nest_shells(Job &job, DisjointSets &solids);
  std::int32_t shell_around(const Vec3 &p, std::int32_t own, Crossings &room) const;
  bool meet_shells(const Vec3 &p, std::int32_t own, Crossings &room) const;
  std::int32_t shell_of(const Triangle &t) const { return shell_of_point_[std::size_t(t[0])]; }

  const Surface &surface_;
  Frame frame_;
  Array<Vec3> points_;  // near 1, where determinants neither over- nor underflow
  Array<std::int32_t> shell_of_point_;
  Array<Shell> shells_;
  KdTree boxes_;      // of the shells
  KdTree triangles_;  // of the crowded shells: a ray into no other's box leaves those as often as it comes into them
  int axis_of_rays_ = 0;
  std::int32_t count_ = 1;
};

}  // namespace tetlod
