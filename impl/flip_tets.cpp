#include "flip_tets.hpp"

#include <cmath>

namespace tetlod {

namespace {

constexpr std::size_t longest_ring = 5;
/// Tets with less than this part of the mean error are left alone, but for what saves tets.
constexpr double quiet = 0.02;

class Flipper {
 public:
  Flipper(double price, Job &job, AdaptiveMesh &mesh)
      : price_(price),
        job_(job),
        mesh_(mesh),
        around_(&job.memory),
        ring_(&job.memory),
        fresh_(&job.memory),
        best_(&job.memory),
        made_(&job.memory) {}

  std::int64_t sweep() {
    const double least = quiet * mesh_.total_error() / double(mesh_.count());
    std::int64_t taken = 0;
    const std::size_t count = mesh_.tets.size();
    for (std::size_t t = 0; t < count; t++) {
      if (t % 256 == 0) job_.poll(double(t) / double(count));
      if (mesh_.alive(std::int32_t(t)) && mesh_.error[t] >= least) taken += improve(std::int32_t(t));
    }
    return taken;
  }

 private:
  bool improve(std::int32_t t) {
    const Tet tet = mesh_.tets[std::size_t(t)];
    for (int k = 0; k < 4; k++)
      if (remove_face(t, k)) return true;
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = i + 1; j < 4; j++)
        if (remove_edge(t, tet[i], tet[j])) return true;
    return false;
  }

  double error_of(Span<const std::int32_t> old) const {
    double sum = 0;
    for (std::int32_t t : old) sum += mesh_.error[std::size_t(t)];
    return sum;
  }

  /// Considers fresh_ in place of around_.
  void weigh(double old_error) {
    for (const Tet &t : fresh_)
      if (!is_sound(mesh_, t, least_shape)) return;
    const double added = double(fresh_.size()) - double(around_.size());
    const double change = mesh_.error_after(around_, fresh_) - old_error + price_ * added;
    if (change < change_) {
      change_ = change;
      best_.assign(fresh_.begin(), fresh_.end());
    }
  }

  void begin(double old_error) {
    // Not for a gain of rounding: flips would go round in circles.
    change_ = -1e-6 * (old_error + price_) - 1e-300;
    best_.clear();
  }

  bool take() {
    if (best_.empty()) return false;
    mesh_.replace(around_, best_, made_);
    return true;
  }

  /// The face opposite corner k, between two tets, becomes the edge between their far corners.
  bool remove_face(std::int32_t t, int k) {
    const std::int32_t n = mesh_.neighbours[std::size_t(t)][std::size_t(k)];
    if (n < 0) return false;
    const Tet &tet = mesh_.tets[std::size_t(t)];
    const double old_error = mesh_.error[std::size_t(t)] + mesh_.error[std::size_t(n)];
    if (old_error <= price_) return false;
    std::int32_t far = -1;
    for (std::size_t i = 0; i < 4; i++)
      if (mesh_.neighbours[std::size_t(n)][i] == t) far = mesh_.tets[std::size_t(n)][i];
    around_.clear();
    around_.push_back(t);
    around_.push_back(n);
    fresh_.clear();
    const std::int32_t near = tet[std::size_t(k)];
    // Seen from `far`, outside of t, the face is counter-clockwise.
    for (int i = 0; i < 3; i++) {
      const std::int32_t a = tet[std::size_t(tet_face[k][i])], b = tet[std::size_t(tet_face[k][(i + 1) % 3])];
      fresh_.push_back({near, a, b, far});
    }
    begin(old_error);
    weigh(old_error);
    return take();
  }

  /// An inner edge (a, b) gives way to triangles of its ring.
  bool remove_edge(std::int32_t t, std::int32_t a, std::int32_t b) {
    if (!mesh_.ring(t, a, b, longest_ring, around_, ring_) || around_.size() < 3) return false;
    for (std::int32_t other : around_)
      if (other < t && mesh_.error[std::size_t(other)] >= mesh_.error[std::size_t(t)]) return false;  // its turn
    const double old_error = error_of(around_);
    begin(old_error);
    const std::size_t n = ring_.size();
    if (n == 3) {
      fan(a, b, 0);
      weigh(old_error);
    } else {
      for (std::size_t apex = 0; apex < (n == 4 ? 2 : n); apex++) {
        fan(a, b, apex);
        weigh(old_error);
      }
    }
    return take();
  }

  /// The ring's triangles from one of its vertices, each with a tet to either side.
  void fan(std::int32_t a, std::int32_t b, std::size_t apex) {
    fresh_.clear();
    const std::size_t n = ring_.size();
    for (std::size_t i = 1; i + 1 < n; i++) {
      const std::int32_t p = ring_[apex], q = ring_[(apex + i) % n], r = ring_[(apex + i + 1) % n];
      fresh_.push_back({p, q, r, b});
      fresh_.push_back({p, r, q, a});
    }
  }

  double price_;
  double change_ = 0;
  Job &job_;
  AdaptiveMesh &mesh_;
  Array<std::int32_t> around_, ring_;
  Array<Tet> fresh_, best_;
  Array<std::int32_t> made_;
};

}  // namespace

bool is_sound(const AdaptiveMesh &mesh, const Tet &t, double limit) {
  const Vec3 &a = mesh.points[std::size_t(t[0])], &b = mesh.points[std::size_t(t[1])],
             &c = mesh.points[std::size_t(t[2])], &d = mesh.points[std::size_t(t[3])];
  const double volume = det(a, b, c, d);
  if (!(volume > 0)) return false;
  const double longest =
      std::max({length2(b - a), length2(c - a), length2(d - a), length2(c - b), length2(d - b), length2(d - c)});
  return volume > limit * longest * std::sqrt(longest);
}

std::int64_t flip_tets(double price, Job &job, AdaptiveMesh &mesh) { return Flipper(price, job, mesh).sweep(); }

}  // namespace tetlod
