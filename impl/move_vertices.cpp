#include "move_vertices.hpp"

#include <cmath>

#include "solver4.hpp"
#include "sweep.hpp"

namespace tetlod {

namespace {

/// Stars with less than this part of the mean error a star are left alone.
constexpr double quiet = 0.05;
constexpr double damping = 1e-3;
constexpr double lengths[] = {1, 0.4, 0.15};
/// A star must not keep more of its error, and what is expected to gain less than this is not tried.
constexpr double least_part = 0.999, least_gain = 0.005;

/// Where a probe will be.
struct Home {
  std::int32_t probe, tet;
};

struct Move {
  using allocator_type = std::pmr::polymorphic_allocator<Home>;
  explicit Move(allocator_type memory) : homes(memory) {}

  std::int32_t vertex = -1;
  Vec3 point{0};
  double value = 0;
  Cavity old;                    ///< its star
  double error[largest_cavity];  ///< of its tets afterwards
  Array<Home> homes;
};

/// The tets around a vertex as they would be with it at another point, with another value.
class MovedStar {
 public:
  MovedStar(const AdaptiveMesh &mesh, const Move &move) : mesh_(mesh), star_(move.old) {
    for (std::size_t i = 0; i < star_.size() && positive_; i++) {
      const Tet &tet = mesh.tets[std::size_t(star_[i])];
      const auto corner = std::size_t(std::find(tet.begin(), tet.end(), move.vertex) - tet.begin());
      Vec3 p[4];
      for (std::size_t k = 0; k < 4; k++) {
        p[k] = k == corner ? move.point : mesh.points[std::size_t(tet[k])];
        values_[i][k] = k == corner ? move.value : mesh.values[std::size_t(tet[k])];
      }
      positive_ = is_sound(p[0], p[1], p[2], p[3], least_shape);
      frames_[i] = TetFrame(p[0], p[1], p[2], p[3]);
    }
  }

  bool is_positive() const { return positive_; }

  /// Whether the sum of squares is less than `limit`; the errors and homes are written to `move` then. Most probes stay
  /// in their tets.
  bool is_less(double limit, Move &move) const {
    move.homes.clear();
    std::fill(move.error, move.error + star_.size(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < star_.size(); i++)
      for (std::int32_t p = mesh_.first_probe[std::size_t(star_[i])]; p >= 0; p = mesh_.next_probe[std::size_t(p)]) {
        double w[4];
        const std::size_t home = home_among(frames_, star_.size(), i, mesh_.probes[std::size_t(p)].point, w);
        double r = -mesh_.probes[std::size_t(p)].value;
        for (int k = 0; k < 4; k++) r += w[k] * values_[home][k];
        sum += r * r;
        if (!(sum < limit)) return false;
        move.error[home] += r * r;
        move.homes.push_back({p, star_[home]});
      }
    return true;
  }

 private:
  const AdaptiveMesh &mesh_;
  const Cavity &star_;
  bool positive_ = true;
  TetFrame frames_[largest_cavity];
  double values_[largest_cavity][4];
};

/// Looks for the moves that pay; of the mesh as it is.
class MoveFinder {
 public:
  MoveFinder(const TetsOfVertices &tets, double least, const AdaptiveMesh &mesh)
      : tets_(tets), least_(least), mesh_(mesh) {}

  bool find(std::int32_t v, Move &move) const {
    move.old.clear();
    for (std::int32_t t : tets_.of(v))
      if (!move.old.push(t)) return false;
    const double old_error = mesh_.error_of(move.old);
    Step step;
    if (!(old_error > least_) || !gauss_newton(v, move.old, step)) return false;
    if (!(step.gain > least_gain * old_error)) return false;
    move.vertex = v;
    for (double length : lengths) {
      move.point = mesh_.points[std::size_t(v)] + length * Vec3(step.by[0], step.by[1], step.by[2]);
      move.value = std::clamp(mesh_.values[std::size_t(v)] + length * step.by[3], step.low, step.high);
      const MovedStar moved(mesh_, move);
      if (moved.is_positive() && moved.is_less(least_part * old_error, move)) return true;
    }
    return false;
  }

 private:
  struct Step {
    Vec4 by{};
    double gain = 0;   ///< to expect
    double low, high;  ///< of the values around
  };

  /// A corner that moves by d takes its linear function along: the residual at p changes by w (value - gradient . d).
  bool gauss_newton(std::int32_t v, const Cavity &star, Step &step) const {
    double size2 = 0;
    std::array<double, 10> a{};  // the lower triangle
    Vec4 down{};
    step.low = step.high = mesh_.values[std::size_t(v)];
    for (std::int32_t t : star) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      const TetFrame frame = mesh_.frame(t);
      const auto corner = std::size_t(std::find(tet.begin(), tet.end(), v) - tet.begin());
      const Vec3 g = frame.gradient(mesh_.value(t, 0), mesh_.value(t, 1), mesh_.value(t, 2), mesh_.value(t, 3));
      const double j[4] = {-g.x, -g.y, -g.z, 1};
      for (std::int32_t u : tet) size2 += length2(mesh_.points[std::size_t(u)] - mesh_.points[std::size_t(v)]);
      double ww = 0, wr = 0;
      mesh_.for_probes(t, [&](std::int32_t p) {
        const Probe &probe = mesh_.probes[std::size_t(p)];
        double w[4];
        frame.weights(probe.point, w);
        ww += w[corner] * w[corner];
        wr += w[corner] * mesh_.residual(tet, w, probe);
        step.low = std::min(step.low, probe.value);
        step.high = std::max(step.high, probe.value);
      });
      for (std::size_t m = 0, entry = 0; m < 4; m++) {
        for (std::size_t n = 0; n <= m; n++) a[entry++] += ww * j[m] * j[n];
        down[m] -= wr * j[m];
      }
    }
    size2 /= 3 * double(star.size());
    // A step of the star's size costs as much as a residual of the field's change over the star.
    double &of_value = a[9];
    const double change2 = (a[0] + a[2] + a[5]) * size2 / std::max(of_value, 1e-300);
    if (!(of_value > 0)) return false;
    for (std::size_t m : {0, 2, 5}) a[m] += damping * of_value * std::max(change2, 1e-300) / size2;
    of_value *= 1 + damping;
    const Solver4 solver(a, 0);
    if (!solver.regular()) return false;
    step.by = solver.solve(down);
    step.gain = 0;
    for (std::size_t m = 0; m < 4; m++) step.gain += down[m] * step.by[m];
    if (!std::isfinite(step.gain)) return false;
    const double far2 = (step.by[0] * step.by[0] + step.by[1] * step.by[1] + step.by[2] * step.by[2]) / (0.25 * size2);
    if (far2 > 1)
      for (double &by : step.by) by /= std::sqrt(far2);
    return true;
  }

  const TetsOfVertices &tets_;
  double least_;
  const AdaptiveMesh &mesh_;
};

void make_move(const Move &move, AdaptiveMesh &mesh) {
  mesh.points[std::size_t(move.vertex)] = move.point;
  mesh.values[std::size_t(move.vertex)] = move.value;
  for (std::size_t i = 0; i < move.old.size(); i++) {
    const auto t = std::size_t(move.old[i]);
    mesh.first_probe[t] = -1;
    mesh.error[t] = move.error[i];
    mesh.touch(move.old[i]);
  }
  for (std::size_t i = move.homes.size(); i-- > 0;) mesh.put_probe(move.homes[i].probe, move.homes[i].tet);
}

}  // namespace

std::int64_t move_vertices(std::size_t first, Job &job, AdaptiveMesh &mesh) {
  Array<std::int32_t> items(&job.memory);
  for (std::size_t v = first; v < mesh.points.size(); v++)
    if (!mesh.fixed[v] && !mesh.kept[v] && mesh.tet_of[v] >= 0) items.push_back(std::int32_t(v));
  const TetsOfVertices tets(mesh, job);  // which stay: vertices move, nothing else
  const Array<std::size_t> batches = batches_apart(mesh, tets, job, items);
  const MoveFinder finder(tets, quiet * 4 * mesh.total_error() / double(mesh.points.size()), mesh);
  return sweep<Move>(
      items, batches, job, mesh, [&](std::int32_t v, Move &move) { return finder.find(v, move); },
      [&](const Move &move) { make_move(move, mesh); });
}

}  // namespace tetlod
