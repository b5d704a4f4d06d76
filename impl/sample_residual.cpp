#include "sample_residual.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "part_in_order.hpp"

namespace tetlod {

namespace {

/// An axis may be split when it is no shorter than the longest over this.
constexpr double thinnest = 1.5;
/// Leaves of so few points look perfect to a linear fit; they get a part of the mean error a point.
constexpr std::size_t few = 8;
constexpr double doubt = 0.2;
/// Points to look at between two polls.
constexpr std::size_t many = 1 << 15;

/// Sums over points, relative to `centre`, for a linear fit of each field.
template <std::size_t m>
struct Moments {
  double n = 0, x[3] = {}, xx[6] = {};
  struct {
    double f = 0, fx[3] = {}, ff = 0;
  } of[m];

  void add(const Vec3 &p, const Values<m> &values) {
    n++;
    for (std::size_t k = 0; k < m; k++) {
      of[k].f += values[k];
      of[k].ff += values[k] * values[k];
      for (int i = 0; i < 3; i++) of[k].fx[i] += values[k] * p[i];
    }
    for (int i = 0, e = 0; i < 3; i++) {
      x[i] += p[i];
      for (int j = 0; j <= i; j++) xx[e++] += p[i] * p[j];
    }
  }

  /// The squares that the best linear functions leave.
  double residual() const {
    if (n < 2) return 0;
    double a[6];
    for (int i = 0, e = 0; i < 3; i++)
      for (int j = 0; j <= i; j++, e++) a[e] = xx[e] - x[i] * x[j] / n;
    double sum = 0;
    for (std::size_t k = 0; k < m; k++) sum += std::max(left_of(k, a), 0.0);
    return sum;
  }

 private:
  double left_of(std::size_t k, const double a[6]) const {
    const auto [f, fx, ff] = of[k];
    const double b[3] = {fx[0] - f * x[0] / n, fx[1] - f * x[1] / n, fx[2] - f * x[2] / n};
    const double trace = a[0] + a[2] + a[5];
    double left = ff - f * f / n;
    // Cholesky without roots; directions without extent tell nothing.
    const double least = 1e-9 * trace;
    if (!(a[0] > least)) return left;
    const double l10 = a[1] / a[0], l20 = a[3] / a[0];
    left -= b[0] * b[0] / a[0];
    const double d1 = a[2] - l10 * a[1], b1 = b[1] - l10 * b[0];
    if (!(d1 > least)) return left;
    left -= b1 * b1 / d1;
    const double l21 = (a[4] - l20 * a[1]) / d1, d2 = a[5] - l20 * a[3] - l21 * l21 * d1,
                 b2 = b[2] - l20 * b[0] - l21 * b1;
    if (d2 > least) left -= b2 * b2 / d2;
    return left;
  }
};

struct Leaf {
  double error;
  std::size_t begin, end;
  Box box;
};

template <std::size_t m>
class ResidualTree {
 public:
  ResidualTree(const MeshView &mesh, Array<std::int32_t> &vertices, Span<const std::uint8_t> is_interior, Job &job)
      : mesh_(mesh),
        values_(mesh.values<m>()),
        vertices_(vertices),
        is_interior_(is_interior),
        job_(job),
        heap_(&job.memory) {
    const Leaf root = leaf(0, vertices.size());
    mean_ = doubt * root.error / double(std::max<std::size_t>(vertices.size(), 1));
    push(root);
  }

  void grow(std::size_t target) {
    Array<Leaf> done(&job_.memory);
    std::size_t step = 0;
    while (heap_.size() && useful_ < target) {
      work_ += heap_.front().end - heap_.front().begin;
      if (++step % 64 == 0 || work_ > many) {
        job_.poll(double(useful_) / double(target));
        work_ = 0;
      }
      std::pop_heap(heap_.begin(), heap_.end(), less);
      const Leaf worst = heap_.back();
      heap_.pop_back();
      const std::size_t middle = split(worst);
      if (middle == worst.begin || middle == worst.end) {
        done.push_back(worst);
        continue;
      }
      useful_ -= has_interior(worst);
      push(leaf(worst.begin, middle));
      push(leaf(middle, worst.end));
    }
    heap_.insert(heap_.end(), done.begin(), done.end());
    std::sort(heap_.begin(), heap_.end(), [](const Leaf &a, const Leaf &b) { return a.begin < b.begin; });
  }

  void pick(Array<std::int32_t> &samples) const {
    for (const Leaf &l : heap_) {
      Vec3 sum(0);
      for (std::size_t i = l.begin; i < l.end; i++) sum += point(vertices_[i]);
      const Vec3 centroid = sum / double(l.end - l.begin);
      std::int32_t best = -1;
      double best2 = std::numeric_limits<double>::infinity();
      for (std::size_t i = l.begin; i < l.end; i++) {
        const std::int32_t v = vertices_[i];
        if (!is_interior_[std::size_t(v)]) continue;
        const double d2 = length2(point(v) - centroid);
        if (d2 < best2 || (d2 == best2 && v < best)) {
          best = v;
          best2 = d2;
        }
      }
      if (best >= 0) samples.push_back(best);
    }
  }

 private:
  static bool less(const Leaf &a, const Leaf &b) { return a.error != b.error ? a.error < b.error : a.begin > b.begin; }
  const Vec3 &point(std::int32_t v) const { return mesh_.points[std::size_t(v)]; }
  /// Beside another's, as they count.
  Values<m> values(std::int32_t v, const Values<m> &offset) const {
    Values<m> values = values_[std::size_t(v)];
    for (std::size_t k = 0; k < m; k++) values[k] = mesh_.scales.weighted[k] * (values[k] - offset[k]);
    return values;
  }

  bool has_interior(const Leaf &l) const {
    for (std::size_t i = l.begin; i < l.end; i++)
      if (is_interior_[std::size_t(vertices_[i])]) return true;
    return false;
  }

  void push(const Leaf &l) {
    useful_ += has_interior(l);
    heap_.push_back(l);
    std::push_heap(heap_.begin(), heap_.end(), less);
  }

  Leaf leaf(std::size_t begin, std::size_t end) const {
    Leaf l{0, begin, end, {}};
    for (std::size_t i = begin; i < end; i++) l.box.add(point(vertices_[i]));
    const Vec3 centre = 0.5 * (l.box.low + l.box.high);
    const Values<m> offset = begin < end ? values_[std::size_t(vertices_[begin])] : Values<m>{};
    Moments<m> sums;
    for (std::size_t i = begin; i < end; i++) sums.add(point(vertices_[i]) - centre, values(vertices_[i], offset));
    l.error = sums.residual() + (end - begin <= few ? mean_ * double(end - begin) : 0);
    return l;
  }

  /// Divides the run of l, and says where.
  std::size_t split(const Leaf &l) {
    if (l.end - l.begin < 2) return l.begin;
    const Vec3 centre = 0.5 * (l.box.low + l.box.high), extent = l.box.high - l.box.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const Values<m> offset = values_[std::size_t(vertices_[l.begin])];
    Moments<m> sides[3][2];
    for (std::size_t i = l.begin; i < l.end; i++) {
      const Vec3 p = point(vertices_[i]) - centre;
      for (int k = 0; k < 3; k++)
        if (thinnest * extent[k] >= longest) sides[k][p[k] >= 0].add(p, values(vertices_[i], offset));
    }
    int axis = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; k++) {
      if (thinnest * extent[k] < longest || !(extent[k] > 0)) continue;
      const double error = sides[k][0].residual() + sides[k][1].residual();
      if (error < least) {
        least = error;
        axis = k;
      }
    }
    if (axis < 0) return l.begin;
    return l.begin + part_in_order({vertices_.data() + l.begin, l.end - l.begin}, others_,
                                   [&](std::int32_t v) { return point(v)[axis] - centre[axis] < 0; });
  }

  const MeshView &mesh_;
  Span<const Values<m>> values_;
  Array<std::int32_t> &vertices_;
  Span<const std::uint8_t> is_interior_;
  Job &job_;
  Array<Leaf> heap_;
  Array<std::int32_t> others_{&job_.memory};
  double mean_ = 0;
  std::size_t useful_ = 0;
  std::size_t work_ = 0;  // points of the leaves that were split since the last poll
};

}  // namespace

void sample_residual(const MeshView &mesh, Array<std::int32_t> &vertices, Span<const std::uint8_t> is_interior,
                     std::size_t target, Job &job, Array<std::int32_t> &samples) {
  if (vertices.empty() || target == 0) return;
  with_fields(mesh.fields, [&](auto m) {
    ResidualTree<m> tree(mesh, vertices, is_interior, job);
    tree.grow(target);
    tree.pick(samples);
  });
}

}  // namespace tetlod
