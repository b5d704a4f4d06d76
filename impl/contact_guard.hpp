// The triangles of a surface while some of them change: which change would take it through itself.
#pragma once
#include "kd_tree.hpp"

namespace tetlod {

class ContactGuard {
 public:
  /// The arrays are looked at as they are whenever a change is; they must live as long, and stay in place.
  ContactGuard(const Array<Vec3> &points, const Array<Triangle> &triangles, Job &job);

  /// Whether one of the fresh triangles, in the places of old ones, would meet another of them, or one that stays,
  /// beside the corners that the two have in common.
  bool is_met(Span<const std::int32_t> old, Span<const Triangle> fresh) const;
  /// The change was made: triangles in the places of these are others, and further ones come last.
  void take(Span<const std::int32_t> changed);

 private:
  void build();
  bool meets_one_that_stays(const Triangle &fresh, Span<const std::int32_t> old) const;
  bool are_apart(const Triangle &a, const Triangle &b) const;

  const Array<Vec3> &points_;
  const Array<Triangle> &triangles_;
  Job &job_;
  std::int32_t in_tree_ = 0;  // those that came later are few
  KdTree tree_;
};

}  // namespace tetlod
