#include "fit_values.hpp"

namespace tetlod {

namespace {

constexpr double pull = 1e-3;  // of the mean diagonal
constexpr std::size_t block = 256;
constexpr std::size_t many = 1 << 15;  // tets between two polls of passes that do little with each

/// What the probes of one tet add to the normal equations of its corners.
template <std::size_t m>
struct Normal {
  double w[4][4]{};
  double r[m][4]{};  ///< of each field, weights times residual, as it counts
  ValueRange<m> range;
};

template <std::size_t m>
Normal<m> normal_of(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  Normal<m> n;
  const TetFrame frame = mesh.frame(t);
  mesh.for_probes(t, [&](std::int32_t p) {
    const Probe<m> &probe = mesh.probes[std::size_t(p)];
    double w[4];
    frame.weights(probe.point, w);
    const Values<m> r = mesh.weighted(mesh.residual(mesh.tets[std::size_t(t)], w, probe));
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++) n.w[i][j] += w[i] * w[j];
    for (std::size_t k = 0; k < m; k++)
      for (int i = 0; i < 4; i++) n.r[k][i] += w[i] * r[k];
    n.range.add(probe.value);
  });
  return n;
}

/// Of every field apart: they share the matrix, not the steps.
template <std::size_t m>
class Fit {
 public:
  Fit(AdaptiveMesh<m> &mesh, Job &job) : mesh_(mesh), job_(job), normals_(&job.memory), pull_(pull) {
    make_room();
    job.parallel.for_blocks(normals_.size(), block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; t++)
        if (mesh_.alive(std::int32_t(t))) normals_[t] = normal_of(mesh_, std::int32_t(t));
      job.poll(0.5);
    });
    double sum = 0;
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      for (int i = 0; i < 4; i++) sum += normals_[t].w[i][i];
    }
    pull_ = pull * sum / double(mesh.points.size()) + 1e-300;
  }

  void solve(int steps) {
    const std::size_t count = mesh_.points.size();
    Array<Values<m>> x(count, Values<m>{}, &job_.memory), r(count, Values<m>{}, &job_.memory), p(&job_.memory),
        image(count, Values<m>{}, &job_.memory);
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (mesh_.alive(std::int32_t(t)))
        for (std::size_t k = 0; k < m; k++)
          for (std::size_t i = 0; i < 4; i++) r[std::size_t(mesh_.tets[t][i])][k] -= normals_[t].r[k][i];
    }
    leave_kept(r);
    p.assign(r.begin(), r.end());
    Values<m> rr = dot(r, r);
    const Values<m> start = rr;
    for (int step = 0; step < steps && any_left(rr, start); step++) {
      apply(p, image);
      const Values<m> alpha = quotient(rr, dot(p, image), rr, start);
      for (std::size_t i = 0; i < count; i++)
        for (std::size_t k = 0; k < m; k++) {
          x[i][k] += alpha[k] * p[i][k];
          r[i][k] -= alpha[k] * image[i][k];
        }
      const Values<m> next = dot(r, r);
      const Values<m> beta = quotient(next, rr, rr, start);
      for (std::size_t i = 0; i < count; i++)
        for (std::size_t k = 0; k < m; k++) p[i][k] = r[i][k] + beta[k] * p[i][k];
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

  /// Of the fields that are not solved; 0 of the others, which stay.
  static Values<m> quotient(const Values<m> &above, const Values<m> &below, const Values<m> &rr,
                            const Values<m> &start) {
    Values<m> quotient{};
    for (std::size_t k = 0; k < m; k++)
      if (is_left(rr[k], start[k])) quotient[k] = above[k] / below[k];
    return quotient;
  }

  void poll_at(std::size_t t) const {
    if (t % many == 0) job_.poll(0.5);
  }

  /// Touching so much memory for the first time takes as long as filling it.
  void make_room() {
    normals_.reserve(mesh_.tets.size());
    while (normals_.size() < mesh_.tets.size()) {
      poll_at(0);
      normals_.resize(std::min(normals_.size() + many, mesh_.tets.size()), Normal<m>());
    }
  }

  static Values<m> dot(const Array<Values<m>> &a, const Array<Values<m>> &b) {
    Values<m> sum{};
    for (std::size_t i = 0; i < a.size(); i++)
      for (std::size_t k = 0; k < m; k++) sum[k] += a[i][k] * b[i][k];
    return sum;
  }

  void apply(const Array<Values<m>> &x, Array<Values<m>> &image) const {
    for (std::size_t i = 0; i < x.size(); i++)
      for (std::size_t k = 0; k < m; k++) image[i][k] = pull_ * x[i][k];
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (!mesh_.alive(std::int32_t(t))) continue;
      const Tet &tet = mesh_.tets[t];
      for (std::size_t k = 0; k < m; k++)
        for (std::size_t i = 0; i < 4; i++) {
          double sum = 0;
          for (std::size_t j = 0; j < 4; j++) sum += normals_[t].w[i][j] * x[std::size_t(tet[j])][k];
          image[std::size_t(tet[i])][k] += sum;
        }
    }
    leave_kept(image);
  }

  void leave_kept(Array<Values<m>> &of_vertices) const {
    for (std::size_t v = 0; v < of_vertices.size(); v++)
      if (mesh_.kept[v]) of_vertices[v] = {};
  }

  /// Within what was seen around each vertex, itself included.
  void take(const Array<Values<m>> &change) {
    Array<ValueRange<m>> seen(&job_.memory);
    seen.reserve(change.size());
    for (const Values<m> &values : mesh_.values) seen.emplace_back(values);
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (!mesh_.alive(std::int32_t(t))) continue;
      for (std::int32_t v : mesh_.tets[t]) seen[std::size_t(v)].add(normals_[t].range);
    }
    for (std::size_t v = 0; v < change.size(); v++) {
      Values<m> values = mesh_.values[v];
      for (std::size_t k = 0; k < m; k++) values[k] += change[v][k] / mesh_.scales.weighted[k];
      mesh_.values[v] = seen[v].clamp(values);
    }
  }

  AdaptiveMesh<m> &mesh_;
  Job &job_;
  Array<Normal<m>> normals_;
  double pull_;
};

}  // namespace

template <std::size_t m>
void fit_values(int steps, Job &job, AdaptiveMesh<m> &mesh) {
  Fit<m>(mesh, job).solve(steps);
  job.parallel.for_blocks(mesh.tets.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      if (mesh.alive(std::int32_t(t))) mesh.measure(std::int32_t(t));
    job.poll(0.5);
  });
}

template void fit_values(int, Job &, AdaptiveMesh<1> &);
template void fit_values(int, Job &, AdaptiveMesh<2> &);
template void fit_values(int, Job &, AdaptiveMesh<3> &);
template void fit_values(int, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
