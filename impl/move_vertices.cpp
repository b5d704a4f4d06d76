#include "move_vertices.hpp"

#include <cmath>

#include "flip_tets.hpp"

namespace tetlod {

namespace {

/// Stars with less than this part of the mean error a star are left alone.
constexpr double quiet = 0.05;
constexpr double damping = 1e-3;
constexpr double lengths[] = {1, 0.4, 0.15};

/// x of the symmetric positive definite a x = b; false where it is not.
bool solve_cholesky(double a[4][4], double b[4]) {
  for (int i = 0; i < 4; i++) {
    for (int j = 0; j <= i; j++) {
      double sum = a[i][j];
      for (int k = 0; k < j; k++) sum -= a[i][k] * a[j][k];
      if (i == j) {
        if (!(sum > 0)) return false;
        a[i][i] = std::sqrt(sum);
      } else {
        a[i][j] = sum / a[j][j];
      }
    }
  }
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < i; k++) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (int i = 3; i >= 0; i--) {
    for (int k = i + 1; k < 4; k++) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return std::isfinite(b[0] + b[1] + b[2] + b[3]);
}

class Mover {
 public:
  Mover(Job &job, AdaptiveMesh &mesh)
      : job_(job), mesh_(mesh), star_(&job.memory), frames_(&job.memory), homes_(&job.memory) {}

  std::int64_t sweep(std::size_t first) {
    const double least = quiet * 4 * mesh_.total_error() / double(mesh_.points.size());
    std::int64_t moved = 0;
    for (std::size_t v = first; v < mesh_.points.size(); v++) {
      if (v % 64 == 0) job_.poll(double(v) / double(mesh_.points.size()));
      if (!mesh_.fixed[v] && !mesh_.kept[v]) moved += improve(std::int32_t(v), least);
    }
    return moved;
  }

 private:
  struct Home {
    std::int32_t probe;
    std::size_t tet;  // in star_
  };

  bool improve(std::int32_t v, double least) {
    mesh_.star(v, star_);
    double old_error = 0;
    for (std::int32_t t : star_) old_error += mesh_.error[std::size_t(t)];
    if (!(old_error > least)) return false;
    double step[4];
    if (!gauss_newton(v, step)) return false;
    const Vec3 old_point = mesh_.points[std::size_t(v)];
    const double old_value = mesh_.values[std::size_t(v)];
    for (double length : lengths) {
      mesh_.points[std::size_t(v)] = old_point + length * Vec3(step[0], step[1], step[2]);
      mesh_.values[std::size_t(v)] = std::clamp(old_value + length * step[3], low_, high_);
      if (is_positive() && error_here() < 0.999 * old_error) {
        settle();
        return true;
      }
    }
    mesh_.points[std::size_t(v)] = old_point;
    mesh_.values[std::size_t(v)] = old_value;
    return false;
  }

  /// A corner that moves by d takes its linear function along: the residual at p changes by w (value - gradient . d).
  bool gauss_newton(std::int32_t v, double step[4]) {
    double a[4][4] = {}, size2 = 0;
    for (int i = 0; i < 4; i++) step[i] = 0;
    low_ = high_ = mesh_.values[std::size_t(v)];
    for (std::int32_t t : star_) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      const TetFrame frame = mesh_.frame(t);
      const auto corner = std::size_t(std::find(tet.begin(), tet.end(), v) - tet.begin());
      const Vec3 g = frame.gradient(mesh_.value(t, 0), mesh_.value(t, 1), mesh_.value(t, 2), mesh_.value(t, 3));
      const double j[4] = {-g.x, -g.y, -g.z, 1};
      for (std::int32_t u : tet) size2 += length2(mesh_.points[std::size_t(u)] - mesh_.points[std::size_t(v)]);
      mesh_.for_probes(t, [&](std::int32_t p) {
        const Probe &probe = mesh_.probes[std::size_t(p)];
        double w[4];
        frame.weights(probe.point, w);
        const double r = mesh_.residual(tet, w, probe), weight = w[corner];
        for (int m = 0; m < 4; m++) {
          for (int n = 0; n <= m; n++) a[m][n] += weight * weight * j[m] * j[n];
          step[m] -= weight * r * j[m];
        }
        low_ = std::min(low_, probe.value);
        high_ = std::max(high_, probe.value);
      });
    }
    size2 /= 3 * double(star_.size());
    // A step of the star's size costs as much as a residual of the field's change over the star.
    const double change2 = (a[0][0] + a[1][1] + a[2][2]) * size2 / std::max(a[3][3], 1e-300);
    if (!(a[3][3] > 0)) return false;
    for (int m = 0; m < 3; m++) a[m][m] += damping * a[3][3] * std::max(change2, 1e-300) / size2;
    a[3][3] *= 1 + damping;
    if (!solve_cholesky(a, step)) return false;
    const double far2 = (step[0] * step[0] + step[1] * step[1] + step[2] * step[2]) / (0.25 * size2);
    if (far2 > 1)
      for (int m = 0; m < 4; m++) step[m] /= std::sqrt(far2);
    return true;
  }

  bool is_positive() const {
    return std::all_of(star_.begin(), star_.end(),
                       [&](std::int32_t t) { return is_sound(mesh_, mesh_.tets[std::size_t(t)], least_shape); });
  }

  /// Of the star as it is now; most probes stay in their tets.
  double error_here() {
    frames_.clear();
    homes_.clear();
    for (std::int32_t t : star_) frames_.push_back(mesh_.frame(t));
    double sum = 0;
    for (std::size_t i = 0; i < star_.size(); i++)
      mesh_.for_probes(star_[i], [&](std::int32_t p) {
        const Vec3 &at = mesh_.probes[std::size_t(p)].point;
        double w[4], best = frames_[i].weights(at, w);
        std::size_t home = i;
        for (std::size_t k = 0; k < star_.size() && best < 0; k++) {
          double other[4];
          const double least = frames_[k].weights(at, other);
          if (least <= best) continue;
          best = least;
          home = k;
          std::copy(other, other + 4, w);
        }
        const double r = mesh_.residual(mesh_.tets[std::size_t(star_[home])], w, mesh_.probes[std::size_t(p)]);
        sum += r * r;
        homes_.push_back({p, home});
      });
    return sum;
  }

  void settle() {
    for (std::int32_t t : star_) mesh_.first_probe[std::size_t(t)] = -1;
    for (std::size_t i = homes_.size(); i-- > 0;) mesh_.put_probe(homes_[i].probe, star_[homes_[i].tet]);
    for (std::int32_t t : star_) mesh_.measure(t);
  }

  Job &job_;
  AdaptiveMesh &mesh_;
  double low_ = 0, high_ = 0;
  Array<std::int32_t> star_;
  Array<TetFrame> frames_;
  Array<Home> homes_;
};

}  // namespace

std::int64_t move_vertices(std::size_t first, Job &job, AdaptiveMesh &mesh) { return Mover(job, mesh).sweep(first); }

}  // namespace tetlod
