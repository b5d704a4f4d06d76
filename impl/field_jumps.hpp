// Where the fields that steer jump between two points of a mesh at one place: of two parts, or two sides of a crack.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "job.hpp"
#include "pipeline.hpp"

namespace tetlod {

class FieldJumps {
 public:
  FieldJumps(const Input &input, Span<const std::uint8_t> used, Job &job) : input_(input), asked_(&job.memory) {
    for (std::size_t k = 0; k < input.steering_fields(); k++) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t v = 0; v < used.size(); v++) {
        job.poll_at(v, 0.9);
        if (!used[v] || !std::isfinite(value(k, v))) continue;
        low = std::min(low, value(k, v));
        high = std::max(high, value(k, v));
      }
      most_[k] = share * (high - low);
    }
  }

  /// By more than a hundredth of the range.
  bool jumps(std::int32_t v, std::int32_t u) const {
    for (std::size_t k = 0; k < input_.steering_fields(); k++) {
      const double by = std::abs(value(k, std::size_t(v)) - value(k, std::size_t(u)));
      if (std::isfinite(by) && by > most_[k]) return true;
    }
    return false;
  }
  /// The same, and it is kept that somebody has asked.
  bool ask(std::int32_t v, std::int32_t u) {
    asked_.push_back({v, u, jumps(v, u)});
    return asked_.back().jumps;
  }
  Jumps asked() && { return std::move(asked_); }

 private:
  static constexpr double share = 0.01;
  /// 0 where there are too few, which others refuse.
  double value(std::size_t k, std::size_t v) const {
    const StridedArray &values = k == 0 ? input_.scalars : input_.steering[k - 1].values;
    return std::int64_t(v) < values.tuples ? values.real(std::int64_t(v), 0) : 0;
  }
  const Input &input_;
  std::array<double, most_fields> most_{};
  Jumps asked_;
};

/// Whether they are what they were with other values.
inline bool are_same_jumps(Span<const MayJump> asked, const Input &input, Span<const std::uint8_t> used, Job &job) {
  if (asked.empty()) return true;
  const FieldJumps fields(input, used, job);
  return std::all_of(asked.begin(), asked.end(),
                     [&](const MayJump &at) { return fields.jumps(at.one, at.other) == at.jumps; });
}

}  // namespace tetlod
