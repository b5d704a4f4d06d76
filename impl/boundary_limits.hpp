// What limits a collapse of the boundary beyond its own star: where the surface is in space.
#pragma once
#include <optional>

#include "crossing_guard.hpp"
#include "deviation.hpp"

namespace tetlod {

class BoundaryLimits {
 public:
  /// No collapse takes a sample farther from the original, see DeviationLimit.
  void limit_deviation(const Surface &original, const TriangleTree &nearest, double limit, Job &job) {
    deviation_.emplace(original, nearest, limit, job);
  }
  /// No collapse takes the surface through itself, see CrossingGuard.
  void guard_crossings(const Array<Vec3> &points, const Array<Triangle> &triangles, Span<const std::int32_t> id,
                       Job &job) {
    guard_.emplace(points, triangles, id, job);
  }

  bool guards_crossings() const { return guard_.has_value(); }

  bool empty() const { return !deviation_ && !guard_; }
  bool are_passed(const Star &star) {
    return (deviation_ && deviation_->is_passed(star)) || (guard_ && guard_->is_passed(star));
  }
  /// The collapse that was looked at last is made.
  void move_on(const Star &star) {
    if (deviation_) deviation_->move_on(star);
    if (guard_) guard_->move_on(star);
  }

 private:
  std::optional<DeviationLimit> deviation_;
  std::optional<CrossingGuard> guard_;
};

}  // namespace tetlod
