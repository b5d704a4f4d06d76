#include "fit_values.hpp"

#include <cmath>

#include "cholesky.hpp"

namespace tetlod {

namespace {

constexpr double pull = 1e-2;  // of the mean diagonal: less, and vertices with few probes go too far
constexpr std::size_t block = 256;
constexpr std::size_t many = 1 << 15;  // tets whose evidence is found at a time
/// Partial sums over tets are this many, so that they may be made at the same time.
constexpr std::size_t parts = 8;

/// Products of weights at the corners of a tet, summed over its probes: half of a symmetric matrix. Kept short, as
/// every step reads all of them.
using Products = std::array<float, 10>;

/// What the probes of one tet say.
template <std::size_t m>
struct Evidence {
  Products products{};
  Values<m> r[4]{};  ///< weights times residuals, as they count
  ValueRange<m> range;
};

template <std::size_t m>
Evidence<m> evidence_of(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  Evidence<m> all;
  const TetFrame frame = mesh.frame(t);
  Triangular<4> products{};
  mesh.for_probes(t, [&](std::int32_t p) {
    const Probe<m> &probe = mesh.probes[std::size_t(p)];
    double w[4];
    frame.weights(probe.point, w);
    const Values<m> r = mesh.weighted(mesh.residual(mesh.tets[std::size_t(t)], w, probe));
    const double weight = mesh.weight_of(p);
    for (std::size_t i = 0; i < 4; i++) {
      for (std::size_t j = 0; j <= i; j++) products[entry_of(i, j)] += weight * w[i] * w[j];
      for (std::size_t k = 0; k < m; k++) all.r[i][k] += weight * w[i] * r[k];
    }
    all.range.add(probe.value);
  });
  std::transform(products.begin(), products.end(), all.products.begin(), [](double x) { return float(x); });
  return all;
}

/// Of every field apart: they share the matrix, not the steps.
template <std::size_t m>
class Fit {
 public:
  Fit(AdaptiveMesh<m> &mesh, Job &job)
      : mesh_(mesh),
        job_(job),
        products_(&job.memory),
        residual_(mesh.points.size(), Values<m>{}, &job.memory),
        diagonal_(mesh.points.size(), 0.0, &job.memory),
        seen_(&job.memory),
        partial_(&job.memory) {
    products_.reserve(mesh.tets.size());
    seen_.reserve(mesh.points.size());
    for (const Values<m> &values : mesh.values) seen_.emplace_back(values);
    gather();
    double sum = 0;
    for (std::size_t t = 0; t < products_.size(); t++) {
      job_.poll_at(t, 0.5);
      if (!mesh.alive(std::int32_t(t))) continue;
      for (std::size_t i = 0; i < 4; i++) {
        diagonal_[std::size_t(mesh.tets[t][i])] += double(products_[t][entry_of(i, i)]);
        sum += double(products_[t][entry_of(i, i)]);
      }
    }
    pull_ = pull * sum / double(mesh.points.size()) + 1e-300;
    for (double &entry : diagonal_) entry += pull_;
  }

  void solve(int steps) {
    const std::size_t count = mesh_.points.size();
    Array<Values<m>> x(count, Values<m>{}, &job_.memory), p(&job_.memory), image(count, Values<m>{}, &job_.memory);
    Array<Values<m>> &r = residual_;
    leave_kept(r);
    p.reserve(count);
    for (std::size_t i = 0; i < count; i++) p.push_back(over_diagonal(r, i));
    Values<m> rr = dot(r, p);
    const Values<m> start = rr;
    for (int step = 0; step < steps && any_left(rr, start); step++) {
      apply(p, image);
      const Values<m> alpha = quotient(rr, dot(p, image), rr, start);
      for (std::size_t i = 0; i < count; i++)
        for (std::size_t k = 0; k < m; k++) {
          x[i][k] += alpha[k] * p[i][k];
          r[i][k] -= alpha[k] * image[i][k];
        }
      for (std::size_t i = 0; i < count; i++) image[i] = over_diagonal(r, i);  // of no use as p's any more
      const Values<m> next = dot(r, image);
      const Values<m> beta = quotient(next, rr, rr, start);
      for (std::size_t i = 0; i < count; i++)
        for (std::size_t k = 0; k < m; k++) p[i][k] = image[i][k] + beta[k] * p[i][k];
      rr = next;
    }
    take(x);
  }

 private:
  static bool is_left(double rr, double start) { return rr > 1e-12 * start; }
  static bool any_left(const Values<m> &rr, const Values<m> &start) {
    for (std::size_t k = 0; k < m; k++)
      if (is_left(rr[k], start[k])) return true;
    return false;
  }

  /// Preconditioned by Jacobi: some vertices have many probes around them, and some few.
  Values<m> over_diagonal(const Array<Values<m>> &r, std::size_t v) const {
    Values<m> z = r[v];
    for (double &x : z) x /= diagonal_[v];
    return z;
  }

  /// Of the fields that are not solved, and whose squares a double holds; 0 of the others, which stay.
  static Values<m> quotient(const Values<m> &above, const Values<m> &below, const Values<m> &rr,
                            const Values<m> &start) {
    Values<m> quotient{};
    for (std::size_t k = 0; k < m; k++)
      if (is_left(rr[k], start[k]) && std::isfinite(above[k] / below[k])) quotient[k] = above[k] / below[k];
    return quotient;
  }

  /// The evidence of all tets, some at a time.
  void gather() {
    Array<Evidence<m>> some(&job_.memory);
    for (std::size_t first = 0; first < mesh_.tets.size(); first += many) {
      some.assign(std::min(many, mesh_.tets.size() - first), Evidence<m>());
      job_.parallel.for_blocks(some.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; i++)
          if (const auto t = std::int32_t(first + i); mesh_.alive(t)) some[i] = evidence_of(mesh_, t);
        job_.poll(0.5);
      });
      for (std::size_t i = 0; i < some.size(); i++) {
        products_.push_back(some[i].products);
        if (mesh_.alive(std::int32_t(first + i))) take_in(mesh_.tets[first + i], some[i]);
      }
    }
  }

  void take_in(const Tet &tet, const Evidence<m> &evidence) {
    for (std::size_t i = 0; i < 4; i++) {
      const auto v = std::size_t(tet[i]);
      for (std::size_t k = 0; k < m; k++) residual_[v][k] -= evidence.r[i][k];
      seen_[v].add(evidence.range);
    }
  }

  static Values<m> dot(const Array<Values<m>> &a, const Array<Values<m>> &b) {
    Values<m> sum{};
    for (std::size_t i = 0; i < a.size(); i++)
      for (std::size_t k = 0; k < m; k++) sum[k] += a[i][k] * b[i][k];
    return sum;
  }

  void apply(const Array<Values<m>> &x, Array<Values<m>> &image) {
    const std::size_t tets = products_.size(), count = x.size(), part = tets / parts + 1;
    partial_.resize(parts * count);
    job_.parallel.for_blocks(parts, 1, [&](std::size_t begin, std::size_t) {
      Values<m> *const sums = partial_.data() + begin * count;
      std::fill(sums, sums + count, Values<m>{});
      for (std::size_t t = begin * part; t < std::min(tets, (begin + 1) * part); t++) {
        job_.poll_at(t, 0.5);
        if (mesh_.alive(std::int32_t(t))) add_image(products_[t], mesh_.tets[t], x, sums);
      }
    });
    for (std::size_t i = 0; i < count; i++)
      for (std::size_t k = 0; k < m; k++) {
        image[i][k] = pull_ * x[i][k];
        for (std::size_t b = 0; b < parts; b++) image[i][k] += partial_[b * count + i][k];
      }
    leave_kept(image);
  }

  static void add_image(const Products &products, const Tet &tet, const Array<Values<m>> &x, Values<m> *image) {
    double w[4][4];
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = 0; j <= i; j++) w[i][j] = w[j][i] = double(products[entry_of(i, j)]);
    for (std::size_t k = 0; k < m; k++)
      for (std::size_t i = 0; i < 4; i++) {
        double sum = 0;
        for (std::size_t j = 0; j < 4; j++) sum += w[i][j] * x[std::size_t(tet[j])][k];
        image[std::size_t(tet[i])][k] += sum;
      }
  }

  void leave_kept(Array<Values<m>> &of_vertices) const {
    for (std::size_t v = 0; v < of_vertices.size(); v++)
      if (mesh_.kept[v]) of_vertices[v] = {};
  }

  /// Within what was seen.
  void take(const Array<Values<m>> &change) {
    for (std::size_t v = 0; v < change.size(); v++) {
      if (mesh_.kept[v]) continue;
      Values<m> values = mesh_.values[v];
      for (std::size_t k = 0; k < m; k++) values[k] += change[v][k] / mesh_.scales.weighted[k];
      mesh_.values[v] = seen_[v].clamp(values);
    }
  }

  AdaptiveMesh<m> &mesh_;
  Job &job_;
  Array<Products> products_;
  Array<Values<m>> residual_;
  Array<double> diagonal_;
  Array<ValueRange<m>> seen_;  // around each vertex, itself included
  Array<Values<m>> partial_;   // the image's parts, one after another
  double pull_ = 0;
};

}  // namespace

template <std::size_t m>
void fit_values(int steps, Job &job, AdaptiveMesh<m> &mesh) {
  Fit<m>(mesh, job).solve(steps);
  mesh.measure_all(0.5, job);
}

template void fit_values(int, Job &, AdaptiveMesh<1> &);
template void fit_values(int, Job &, AdaptiveMesh<2> &);
template void fit_values(int, Job &, AdaptiveMesh<3> &);
template void fit_values(int, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
