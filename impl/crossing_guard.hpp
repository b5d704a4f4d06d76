// The triangles of a surface while its edges collapse: which collapse would take it through itself.
#pragma once
#include "collapse_rules.hpp"
#include "contacts.hpp"
#include "kd_tree.hpp"

namespace tetlod {

class CrossingGuard {
 public:
  /// The arrays are looked at as they are whenever a collapse is; they must live as long, and stay in place.
  /// Triangles whose first corner is -1 are none. id: of each point: those that are the same in the uncut surface have
  /// the same; empty: none are. may_meet: of original vertices; origin: of each point, the one that it was.
  CrossingGuard(const Array<Vec3> &points, const Array<Triangle> &triangles, Span<const std::int32_t> id, Job &job,
                const MayMeet &may_meet = {}, Span<const std::int32_t> origin = {});

  /// Whether a spoke would reach another triangle of the surface or another spoke, or the star pass over a part of it.
  bool is_passed(const Star &star) const;
  /// The collapse was made.
  void move_on(const Star &star);

 private:
  struct Other;
  std::int32_t id_of(std::int32_t v) const { return id_.empty() ? v : id_[std::size_t(v)]; }
  bool passes_over(const Star &star, const Box &of_both, const Other &other) const;

  const Array<Vec3> &points_;
  const Array<Triangle> &triangles_;
  Span<const std::int32_t> id_;
  Job &job_;
  Array<std::int32_t> component_;  // of each triangle, if some may meet
  MayMeet may_meet_;
  KdTree tree_;
  std::size_t left_, in_tree_;  // triangles, now and when the tree was built
};

}  // namespace tetlod
