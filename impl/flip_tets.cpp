#include "flip_tets.hpp"

#include <limits>

#include "sweep.hpp"

namespace tetlod {

namespace {

constexpr std::size_t longest_ring = 5, most_fresh = 2 * (longest_ring - 2);
/// Tets with less than this part of the mean error are left alone, but for what saves tets.
constexpr double quiet = 0.02;

struct Flip {
  Few<std::int32_t, longest_ring> old;
  Few<Tet, most_fresh> fresh;
};

/// Looks for the flips that pay; of the mesh as it is.
template <std::size_t m>
class FlipFinder {
 public:
  FlipFinder(double price, const AdaptiveMesh<m> &mesh) : price_(price), mesh_(mesh) {}

  /// Of the faces of t the one whose removal changes the sum of squares by less than `best`, and by the least.
  void find_face(std::int32_t t, double &best, Flip &flip) const {
    Flip other;
    for (int k = 0; k < 4; k++) {
      if (!face_removal(t, k, other)) continue;
      if (!mesh_.is_better(other.old, other.fresh, 0, mesh_.error_of(other.old), best)) continue;
      flip = other;
    }
  }

  /// The first kind of flip around t that pays, in its best form.
  bool find(std::int32_t t, Flip &flip) const {
    if (!mesh_.alive(t)) return false;
    const Tet &tet = mesh_.tets[std::size_t(t)];
    for (int k = 0; k < 4; k++)
      if (remove_face(t, k, flip)) return true;
    for (std::size_t i = 0; i < 4; i++)
      for (std::size_t j = i + 1; j < 4; j++)
        if (remove_edge(t, tet[i], tet[j], flip)) return true;
    return false;
  }

 private:
  /// What two tets share is the turn of the one with the larger error.
  bool is_before(std::int32_t t, std::int32_t other) const {
    const double a = mesh_.error[std::size_t(t)], b = mesh_.error[std::size_t(other)];
    return a != b ? a > b : t < other;
  }

  /// Not for a gain of rounding: flips would go round in circles.
  double least_gain(double old_error) const { return -1e-6 * (old_error + price_) - 1e-300; }

  bool remove_face(std::int32_t t, int k, Flip &flip) const {
    if (2 * mesh_.error[std::size_t(t)] <= price_) return false;  // the other tet has no larger error
    if (!face_removal(t, k, flip)) return false;
    const double old_error = mesh_.error_of(flip.old);
    double best = least_gain(old_error);
    return old_error > price_ && mesh_.is_better(flip.old, flip.fresh, price_, old_error, best);
  }

  /// The face opposite corner k, between two tets, becomes the edge between their far corners. False: there is no such,
  /// or it is the other tet's turn.
  bool face_removal(std::int32_t t, int k, Flip &flip) const {
    const std::int32_t n = mesh_.neighbours[std::size_t(t)][std::size_t(k)];
    if (n < 0 || is_before(n, t)) return false;
    const Tet &tet = mesh_.tets[std::size_t(t)];
    std::int32_t far = -1;
    for (std::size_t i = 0; i < 4; i++)
      if (mesh_.neighbours[std::size_t(n)][i] == t) far = mesh_.tets[std::size_t(n)][i];
    flip.old.clear();
    flip.old.push(t);
    flip.old.push(n);
    flip.fresh.clear();
    const std::int32_t near = tet[std::size_t(k)];
    // Seen from `far`, outside of t, the face is counter-clockwise.
    for (int i = 0; i < 3; i++) {
      const std::int32_t a = tet[std::size_t(tet_face[k][i])], b = tet[std::size_t(tet_face[k][(i + 1) % 3])];
      flip.fresh.push({near, a, b, far});
    }
    return true;
  }

  /// An inner edge (a, b) gives way to triangles of its ring.
  bool remove_edge(std::int32_t t, std::int32_t a, std::int32_t b, Flip &flip) const {
    Few<std::int32_t, longest_ring> ring;
    if (!mesh_.ring(t, a, b, flip.old, ring, [&](std::int32_t other) { return !is_before(other, t); })) return false;
    if (ring.size() < 3) return false;
    const double old_error = mesh_.error_of(flip.old);
    double best = least_gain(old_error);
    bool found = false;
    const std::size_t n = ring.size(), ways = n == 3 ? 1 : n == 4 ? 2 : n;
    for (std::size_t apex = 0; apex < ways; apex++) {
      const auto fresh = fan(ring, a, b, apex);
      if (!mesh_.is_better(flip.old, fresh, price_, old_error, best)) continue;
      flip.fresh = fresh;
      found = true;
    }
    return found;
  }

  double price_;
  const AdaptiveMesh<m> &mesh_;
};

}  // namespace

template <std::size_t m>
void flip_tets(double price, Job &job, AdaptiveMesh<m> &mesh) {
  const double least = quiet * mesh.total_error() / double(mesh.count());
  Array<std::int32_t> items(&job.memory), made(&job.memory);
  for (std::size_t t = 0; t < mesh.tets.size(); t++)
    if (mesh.alive(std::int32_t(t)) && mesh.error[t] >= least) items.push_back(std::int32_t(t));
  const FlipFinder finder(price, mesh);
  sweep<Flip>(
      items, batches_of(items.size(), 512, job.memory), job, mesh,
      [&](std::int32_t t, Flip &flip) { return finder.find(t, flip); },
      [&](const Flip &flip) { mesh.replace(flip.old, flip.fresh, made); });
}

template <std::size_t m>
void remove_faces(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh) {
  const FlipFinder finder(0, mesh);
  Array<std::int32_t> made(&job.memory);
  while (std::int64_t(mesh.count()) < tets) {
    job.poll(0.9);
    double best = std::numeric_limits<double>::infinity();
    Flip flip;
    for (std::size_t t = 0; t < mesh.tets.size(); t++)
      if (mesh.alive(std::int32_t(t))) finder.find_face(std::int32_t(t), best, flip);
    if (flip.old.size() == 0) return;
    mesh.replace(flip.old, flip.fresh, made);
  }
}

template void flip_tets(double, Job &, AdaptiveMesh<1> &);
template void flip_tets(double, Job &, AdaptiveMesh<2> &);
template void flip_tets(double, Job &, AdaptiveMesh<3> &);
template void flip_tets(double, Job &, AdaptiveMesh<4> &);
template void remove_faces(std::int64_t, Job &, AdaptiveMesh<1> &);
template void remove_faces(std::int64_t, Job &, AdaptiveMesh<2> &);
template void remove_faces(std::int64_t, Job &, AdaptiveMesh<3> &);
template void remove_faces(std::int64_t, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
