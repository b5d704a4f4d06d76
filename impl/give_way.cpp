#include "give_way.hpp"

#include <algorithm>
#include <cmath>

namespace tetlod {

namespace {

/// Of the bound, kept clear of: an error that is to be the bound would be beyond it.
constexpr double rounding = 1e-6;
/// Of the probe, at a corner; with less, the values there would have to change by much.
constexpr double least_weight = 0.1;

/// What may be added to a value.
struct Step {
  double low, high;

  /// So that r, with that times the weight, is between -limit and limit.
  void hold(double r, double weight, double limit) {
    constexpr double none = 1e-12;
    if (std::abs(weight) < none) return;
    const double a = (-limit - r) / weight, b = (limit - r) / weight;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
};

/// The steps of the values of one vertex that are admissible.
template <std::size_t m>
class Steps {
 public:
  Steps(const AdaptiveMesh<m> &mesh, std::int32_t v, const ValueRange<m> &range, double bound) : mesh_(mesh), v_(v) {
    const Values<m> &values = mesh.values[std::size_t(v)];
    for (std::size_t i = 0; i < m; i++) {
      steps_[i] = {range.low[i] - values[i], range.high[i] - values[i]};
      limits_[i] = (1 - rounding) * bound / mesh.scales.relative[i];
    }
  }

  /// Differences of the largest doubles are none.
  bool exist() const {
    return std::all_of(steps_.begin(), steps_.end(), [](const Step &step) {
      return step.low <= step.high && std::isfinite(step.low) && std::isfinite(step.high);
    });
  }

  /// The bound at a probe of tet t.
  void hold(std::int32_t t, std::int32_t probe) {
    hold(t, mesh_.frame(t), corner_in(t), probe, [](double limit, double) { return limit; });
  }

  /// The bound at all vertices in tet t; errors beyond it may stay as they are.
  void hold(std::int32_t t) {
    const TetFrame frame = mesh_.frame(t);
    const std::size_t corner = corner_in(t);
    mesh_.for_probes(t, [&](std::int32_t p) {
      if (std::size_t(p) < mesh_.vertex_probes)
        hold(t, frame, corner, p, [](double limit, double r) { return std::max(limit, std::abs(r)); });
    });
  }

  Values<m> least() const {
    Values<m> least;
    for (std::size_t i = 0; i < m; i++) least[i] = std::clamp(0.0, steps_[i].low, steps_[i].high);
    return least;
  }

 private:
  std::size_t corner_in(std::int32_t t) const {
    const Tet &tet = mesh_.tets[std::size_t(t)];
    return std::size_t(std::find(tet.begin(), tet.end(), v_) - tet.begin());
  }

  template <class LimitOf>
  void hold(std::int32_t t, const TetFrame &frame, std::size_t corner, std::int32_t probe, const LimitOf &limit_of) {
    const Probe<m> &at = mesh_.probes[std::size_t(probe)];
    double w[4];
    frame.weights(at.point, w);
    const Values<m> r = mesh_.residual(mesh_.tets[std::size_t(t)], w, at);
    for (std::size_t i = 0; i < m; i++) steps_[i].hold(r[i], w[corner], limit_of(limits_[i], r[i]));
  }

  const AdaptiveMesh<m> &mesh_;
  std::int32_t v_;
  Values<m> limits_;  // of the errors
  std::array<Step, m> steps_;
};

/// Not what the host keeps; and where the solid touches itself, tets of a vertex are not all found.
template <std::size_t m>
bool may_change(const AdaptiveMesh<m> &mesh, std::int32_t v) {
  return (mesh.kept[std::size_t(v)] & ~held) == 0 && mesh.fixed[std::size_t(v)] != touching;
}

}  // namespace

template <std::size_t m>
bool give_way(std::int32_t t, std::int32_t probe, double bound, const ValueRange<m> &range, AdaptiveMesh<m> &mesh) {
  double w[4];
  mesh.frame(t).weights(mesh.probes[std::size_t(probe)].point, w);
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return w[a] != w[b] ? w[a] > w[b] : a < b; });
  Array<std::int32_t> around(&mesh.memory());
  for (std::size_t k : order) {
    const std::int32_t v = mesh.tets[std::size_t(t)][k];
    if (w[k] < least_weight || !may_change(mesh, v)) continue;
    Steps<m> steps(mesh, v, range, bound);
    steps.hold(t, probe);
    if (!steps.exist()) continue;
    const auto hold = [&](std::int32_t at) {
      steps.hold(at);
      return steps.exist();
    };
    if (!mesh.star(v, around, hold)) continue;
    const Values<m> least = steps.least();
    Values<m> &values = mesh.values[std::size_t(v)];
    for (std::size_t i = 0; i < m; i++) values[i] += least[i];
    values = range.clamp(values);  // a sum may round beyond it
    for (std::int32_t at : around) mesh.measure(at);
    return true;
  }
  return false;
}

template bool give_way(std::int32_t, std::int32_t, double, const ValueRange<1> &, AdaptiveMesh<1> &);
template bool give_way(std::int32_t, std::int32_t, double, const ValueRange<2> &, AdaptiveMesh<2> &);
template bool give_way(std::int32_t, std::int32_t, double, const ValueRange<3> &, AdaptiveMesh<3> &);
template bool give_way(std::int32_t, std::int32_t, double, const ValueRange<4> &, AdaptiveMesh<4> &);

}  // namespace tetlod
