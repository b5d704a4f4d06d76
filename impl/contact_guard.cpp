#include "contact_guard.hpp"

#include <algorithm>

#include "predicates.hpp"

namespace tetlod {

namespace {

constexpr std::int64_t leaf = 4;
/// Looking at so many triangles that came later takes about as long as the tree.
constexpr std::size_t most_late = 1024;

}  // namespace

ContactGuard::ContactGuard(const Array<Vec3> &points, const Array<Triangle> &triangles, Job &job)
    : points_(points), triangles_(triangles), job_(job), tree_(job.memory) {
  build();
}

void ContactGuard::build() {
  const auto box = [&](std::size_t t) { return box_of(points_, triangles_[t]); };
  tree_.build(boxes_of(triangles_.size(), job_, box), leaf, job_);
  in_tree_ = std::int32_t(triangles_.size());
}

bool ContactGuard::is_met(Span<const std::int32_t> old, Span<const Triangle> fresh) const {
  for (std::size_t i = 0; i < fresh.size(); i++) {
    for (std::size_t j = 0; j < i; j++)
      if (!are_apart(fresh[i], fresh[j])) return true;
    if (meets_one_that_stays(fresh[i], old)) return true;
  }
  return false;
}

bool ContactGuard::meets_one_that_stays(const Triangle &fresh, Span<const std::int32_t> old) const {
  const Box box = box_of(points_, fresh);
  const auto meets = [&](std::int32_t t) {
    return std::find(old.begin(), old.end(), t) == old.end() && !are_apart(fresh, triangles_[std::size_t(t)]);
  };
  if (tree_.any_overlap(box, meets)) return true;
  for (auto t = in_tree_; t < std::int32_t(triangles_.size()); t++)
    if (overlap(box, box_of(points_, triangles_[std::size_t(t)])) && meets(t)) return true;
  return false;
}

bool ContactGuard::are_apart(const Triangle &a, const Triangle &b) const {
  const auto corner = [&](const Triangle &t, std::size_t k) { return points_[std::size_t(t[k])]; };
  const Vec3 of_a[3] = {corner(a, 0), corner(a, 1), corner(a, 2)};
  const Vec3 of_b[3] = {corner(b, 0), corner(b, 1), corner(b, 2)};
  return triangles_apart(of_a, a, of_b, b);
}

void ContactGuard::take(Span<const std::int32_t> changed) {
  for (std::int32_t t : changed)
    if (t < in_tree_) tree_.refit(t, box_of(points_, triangles_[std::size_t(t)]));
  if (triangles_.size() > std::size_t(in_tree_) + most_late) build();
}

}  // namespace tetlod
