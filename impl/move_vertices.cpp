#include "move_vertices.hpp"

#include <cmath>

#include "cholesky.hpp"
#include "sweep.hpp"

namespace tetlod {

namespace {

/// Stars with less than this part of the mean error a star are left alone.
constexpr double quiet = 0.05;
constexpr double damping = 1e-3;
constexpr double lengths[] = {1, 0.4, 0.15};
/// A star must not keep more of its error, and what is expected to gain less than this is not tried.
constexpr double least_part = 0.999, least_gain = 0.005;

template <std::size_t m>
struct VertexMove {
  /// Where a probe will be.
  struct Home {
    std::int32_t probe, tet;
  };
  using allocator_type = std::pmr::polymorphic_allocator<Home>;
  explicit VertexMove(allocator_type memory) : homes(memory) {}

  std::int32_t vertex = -1;
  Vec3 point{0};
  Values<m> values{};
  Cavity old;                    ///< its star
  double error[largest_cavity];  ///< of its tets afterwards
  Array<Home> homes;
};

/// The tets around a vertex as they would be with it at another point, with other values.
template <std::size_t m>
class MovedStar {
 public:
  MovedStar(const AdaptiveMesh<m> &mesh, const VertexMove<m> &move) : mesh_(mesh), star_(move.old) {
    for (std::size_t i = 0; i < star_.size() && positive_; i++) {
      const Tet &tet = mesh.tets[std::size_t(star_[i])];
      const auto corner = std::size_t(std::find(tet.begin(), tet.end(), move.vertex) - tet.begin());
      Vec3 p[4];
      for (std::size_t k = 0; k < 4; k++) {
        p[k] = k == corner ? move.point : mesh.points[std::size_t(tet[k])];
        values_[i][k] = k == corner ? move.values : mesh.values[std::size_t(tet[k])];
      }
      positive_ = is_sound(p[0], p[1], p[2], p[3], least_shape);
      frames_[i] = TetFrame(p[0], p[1], p[2], p[3]);
    }
  }

  bool is_positive() const { return positive_; }

  /// Whether the sum of squares is less than `limit`; the errors and homes are written to `move` then. Most probes stay
  /// in their tets.
  bool is_less(double limit, VertexMove<m> &move) const {
    move.homes.clear();
    std::fill(move.error, move.error + star_.size(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < star_.size(); i++)
      for (std::int32_t p = mesh_.first_probe[std::size_t(star_[i])]; p >= 0; p = mesh_.next_probe[std::size_t(p)]) {
        double w[4];
        const std::size_t home = home_among(frames_, star_.size(), i, mesh_.probes[std::size_t(p)].point, w);
        const double square = mesh_.weight_of(p) * mesh_.square(residual(w, home, mesh_.probes[std::size_t(p)].value));
        sum += square;
        if (!(sum < limit)) return false;
        move.error[home] += square;
        move.homes.push_back({p, star_[home]});
      }
    return true;
  }

 private:
  Values<m> residual(const double w[4], std::size_t home, const Values<m> &original) const {
    Values<m> r;
    for (std::size_t i = 0; i < m; i++) {
      r[i] = -original[i];
      for (int k = 0; k < 4; k++) r[i] += w[k] * values_[home][k][i];
    }
    return r;
  }

  const AdaptiveMesh<m> &mesh_;
  const Cavity &star_;
  bool positive_ = true;
  TetFrame frames_[largest_cavity];
  Values<m> values_[largest_cavity][4];
};

/// Looks for the moves that pay; of the mesh as it is.
template <std::size_t m>
class MoveFinder {
 public:
  MoveFinder(const StarLists &tets, double least, const AdaptiveMesh<m> &mesh)
      : tets_(tets), least_(least), mesh_(mesh) {}

  bool find(std::int32_t v, VertexMove<m> &move) const {
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
      move.values = mesh_.values[std::size_t(v)];
      for (std::size_t k = 0; k < m; k++) move.values[k] += length * step.by[3 + k] / mesh_.scales.weighted[k];
      move.values = step.range.clamp(move.values);
      const MovedStar<m> moved(mesh_, move);
      if (moved.is_positive() && moved.is_less(least_part * old_error, move)) return true;
    }
    return false;
  }

 private:
  struct Step {
    Vector<3 + m> by{};
    double gain = 0;      ///< to expect
    ValueRange<m> range;  ///< of the values around
  };

  /// A corner that moves by d takes its linear function along: the residual at p changes by w (value - gradient . d).
  bool gauss_newton(std::int32_t v, const Cavity &star, Step &step) const {
    double size2 = 0;
    Triangular<3 + m> a{};
    Vector<3 + m> down{};
    step.range = ValueRange<m>(mesh_.values[std::size_t(v)]);
    for (std::int32_t t : star) {
      const Tet &tet = mesh_.tets[std::size_t(t)];
      const TetFrame frame = mesh_.frame(t);
      const auto corner = std::size_t(std::find(tet.begin(), tet.end(), v) - tet.begin());
      for (std::int32_t u : tet) size2 += length2(mesh_.points[std::size_t(u)] - mesh_.points[std::size_t(v)]);
      double ww = 0;
      Values<m> wr{};
      mesh_.for_probes(t, [&](std::int32_t p) {
        const Probe<m> &probe = mesh_.probes[std::size_t(p)];
        double w[4];
        frame.weights(probe.point, w);
        const double weight = mesh_.weight_of(p) * w[corner];
        ww += weight * w[corner];
        const Values<m> r = mesh_.residual(tet, w, probe);
        for (std::size_t k = 0; k < m; k++) wr[k] += weight * r[k];
        step.range.add(probe.value);
      });
      wr = mesh_.weighted(wr);
      for (std::size_t k = 0; k < m; k++) {
        const Vector<3 + m> j = jacobian(t, frame, k);
        for (std::size_t row = 0; row < 3 + m; row++) {
          for (std::size_t column = 0; column <= row; column++) a[entry_of(row, column)] += ww * j[row] * j[column];
          down[row] -= wr[k] * j[row];
        }
      }
    }
    size2 /= 3 * double(star.size());
    // A step of the star's size costs as much as a residual of the field's change over the star.
    const double of_value = a[entry_of(3, 3)];
    const double change2 = (a[0] + a[2] + a[5]) * size2 / std::max(of_value, 1e-300);
    if (!(of_value > 0)) return false;
    for (std::size_t k = 0; k < 3; k++) a[entry_of(k, k)] += damping * of_value * std::max(change2, 1e-300) / size2;
    for (std::size_t k = 3; k < 3 + m; k++) a[entry_of(k, k)] *= 1 + damping;
    const Cholesky<3 + m> solver(a, 0);
    if (!solver.regular()) return false;
    step.by = solver.solve(down);
    step.gain = dot<3 + m>(down, step.by);
    if (!std::isfinite(step.gain)) return false;
    const double far2 = (step.by[0] * step.by[0] + step.by[1] * step.by[1] + step.by[2] * step.by[2]) / (0.25 * size2);
    if (far2 > 1)
      for (double &by : step.by) by /= std::sqrt(far2);
    return true;
  }

  /// Of what field k's residual counts, over the vertex's weight; its value by what it counts.
  Vector<3 + m> jacobian(std::int32_t t, const TetFrame &frame, std::size_t k) const {
    const Vec3 g =
        frame.gradient(mesh_.value(t, 0)[k], mesh_.value(t, 1)[k], mesh_.value(t, 2)[k], mesh_.value(t, 3)[k]);
    const double scale = mesh_.scales.weighted[k];
    Vector<3 + m> j{-scale * g.x, -scale * g.y, -scale * g.z};
    j[3 + k] = 1;
    return j;
  }

  const StarLists &tets_;
  double least_;
  const AdaptiveMesh<m> &mesh_;
};

template <std::size_t m>
void make_move(const VertexMove<m> &move, AdaptiveMesh<m> &mesh) {
  mesh.points[std::size_t(move.vertex)] = move.point;
  mesh.values[std::size_t(move.vertex)] = move.values;
  for (std::size_t i = 0; i < move.old.size(); i++) {
    const auto t = std::size_t(move.old[i]);
    mesh.first_probe[t] = -1;
    mesh.error[t] = move.error[i];
    mesh.touch(move.old[i]);
  }
  for (std::size_t i = move.homes.size(); i-- > 0;) mesh.put_probe(move.homes[i].probe, move.homes[i].tet);
}

}  // namespace

template <std::size_t m>
void move_vertices(std::size_t first, Job &job, AdaptiveMesh<m> &mesh) {
  Array<std::int32_t> items(&job.memory);
  for (std::size_t v = first; v < mesh.points.size(); v++)
    if (!mesh.fixed[v] && !mesh.kept[v] && mesh.tet_of[v] >= 0) items.push_back(std::int32_t(v));
  // They stay: vertices move, nothing else.
  const StarLists tets(Span<const Tet>(mesh.tets), mesh.points.size(), job);
  const Array<std::size_t> batches = batches_apart(mesh, tets, job, items);
  const MoveFinder<m> finder(tets, quiet * 4 * mesh.total_error() / double(mesh.points.size()), mesh);
  sweep<VertexMove<m>>(
      items, batches, job, mesh, [&](std::int32_t v, VertexMove<m> &move) { return finder.find(v, move); },
      [&](const VertexMove<m> &move) { make_move(move, mesh); });
}

template void move_vertices(std::size_t, Job &, AdaptiveMesh<1> &);
template void move_vertices(std::size_t, Job &, AdaptiveMesh<2> &);
template void move_vertices(std::size_t, Job &, AdaptiveMesh<3> &);
template void move_vertices(std::size_t, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
