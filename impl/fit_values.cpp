#include "fit_values.hpp"

#include <cmath>

namespace tetlod {

namespace {

constexpr double pull = 1e-3;  // of the mean diagonal
constexpr std::size_t block = 256;
constexpr std::size_t many = 1 << 15;  // tets between two polls of passes that do little with each

/// What the probes of one tet add to the normal equations of its corners.
struct Normal {
  double w[4][4];
  double r[4];  ///< weights times residual
  double low, high;
};

Normal normal_of(const AdaptiveMesh &mesh, std::int32_t t) {
  Normal n{};
  n.low = std::numeric_limits<double>::infinity();
  n.high = -n.low;
  const TetFrame frame = mesh.frame(t);
  mesh.for_probes(t, [&](std::int32_t p) {
    const Probe &probe = mesh.probes[std::size_t(p)];
    double w[4];
    frame.weights(probe.point, w);
    const double r = mesh.residual(mesh.tets[std::size_t(t)], w, probe);
    for (int i = 0; i < 4; i++) {
      for (int j = 0; j < 4; j++) n.w[i][j] += w[i] * w[j];
      n.r[i] += w[i] * r;
    }
    n.low = std::min(n.low, probe.value);
    n.high = std::max(n.high, probe.value);
  });
  return n;
}

class Fit {
 public:
  Fit(AdaptiveMesh &mesh, Job &job) : mesh_(mesh), job_(job), normals_(&job.memory), pull_(pull) {
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
    Array<double> x(count, 0.0, &job_.memory), r(count, 0.0, &job_.memory), p(&job_.memory),
        image(count, 0.0, &job_.memory);
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (mesh_.alive(std::int32_t(t)))
        for (std::size_t k = 0; k < 4; k++) r[std::size_t(mesh_.tets[t][k])] -= normals_[t].r[k];
    }
    leave_kept(r);
    p.assign(r.begin(), r.end());
    double rr = dot(r, r);
    const double start = rr;
    for (int step = 0; step < steps && rr > 1e-12 * start; step++) {
      apply(p, image);
      const double alpha = rr / dot(p, image);
      for (std::size_t i = 0; i < count; i++) {
        x[i] += alpha * p[i];
        r[i] -= alpha * image[i];
      }
      const double next = dot(r, r);
      for (std::size_t i = 0; i < count; i++) p[i] = r[i] + next / rr * p[i];
      rr = next;
    }
    take(x);
  }

 private:
  void poll_at(std::size_t t) const {
    if (t % many == 0) job_.poll(0.5);
  }

  /// Touching so much memory for the first time takes as long as filling it.
  void make_room() {
    normals_.reserve(mesh_.tets.size());
    while (normals_.size() < mesh_.tets.size()) {
      poll_at(0);
      normals_.resize(std::min(normals_.size() + many, mesh_.tets.size()), Normal{});
    }
  }

  static double dot(const Array<double> &a, const Array<double> &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); i++) sum += a[i] * b[i];
    return sum;
  }

  void apply(const Array<double> &x, Array<double> &image) const {
    for (std::size_t i = 0; i < x.size(); i++) image[i] = pull_ * x[i];
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (!mesh_.alive(std::int32_t(t))) continue;
      const Tet &tet = mesh_.tets[t];
      for (std::size_t i = 0; i < 4; i++) {
        double sum = 0;
        for (std::size_t j = 0; j < 4; j++) sum += normals_[t].w[i][j] * x[std::size_t(tet[j])];
        image[std::size_t(tet[i])] += sum;
      }
    }
    leave_kept(image);
  }

  void leave_kept(Array<double> &of_vertices) const {
    for (std::size_t v = 0; v < of_vertices.size(); v++)
      if (mesh_.kept[v]) of_vertices[v] = 0;
  }

  /// Within what was seen around each vertex, itself included.
  void take(const Array<double> &change) {
    Array<double> low(mesh_.values, &job_.memory), high(mesh_.values, &job_.memory);
    for (std::size_t t = 0; t < normals_.size(); t++) {
      poll_at(t);
      if (!mesh_.alive(std::int32_t(t))) continue;
      for (std::int32_t v : mesh_.tets[t]) {
        low[std::size_t(v)] = std::min(low[std::size_t(v)], normals_[t].low);
        high[std::size_t(v)] = std::max(high[std::size_t(v)], normals_[t].high);
      }
    }
    for (std::size_t v = 0; v < change.size(); v++)
      mesh_.values[v] = std::clamp(mesh_.values[v] + change[v], low[v], high[v]);
  }

  AdaptiveMesh &mesh_;
  Job &job_;
  Array<Normal> normals_;
  double pull_;
};

}  // namespace

void fit_values(int steps, Job &job, AdaptiveMesh &mesh) {
  Fit(mesh, job).solve(steps);
  job.parallel.for_blocks(mesh.tets.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      if (mesh.alive(std::int32_t(t))) mesh.measure(std::int32_t(t));
    job.poll(0.5);
  });
}

}  // namespace tetlod
