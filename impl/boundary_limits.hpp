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
                       Job &job, const MayMeet &may_meet = {}, Span<const std::int32_t> origin = {}) {
    guard_.emplace(points, triangles, id, job, may_meet, origin);
  }

  bool guards_crossings() const { return guard_.has_value(); }

  bool empty() const { return !deviation_ && !guard_; }
  /// of_star: for move_on. Of stars that have no triangle in common at the same time, as long as no crossings are
  /// guarded.
  bool are_passed(const Star &star, SamplesOfStar &of_star) {
    return (deviation_ && deviation_->is_passed(star, of_star)) || (guard_ && guard_->is_passed(star));
  }
  /// The collapse is made.
  void move_on(const Star &star, const SamplesOfStar &of_star) {
    if (deviation_) deviation_->move_on(star, of_star);
    if (guard_) guard_->move_on(star);
  }

 private:
  std::optional<DeviationLimit> deviation_;
  std::optional<CrossingGuard> guard_;
};

}  // namespace tetlod
