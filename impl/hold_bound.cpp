#include "hold_bound.hpp"

#include <algorithm>

#include "flip_tets.hpp"
#include "give_way.hpp"
#include "most_needed.hpp"

namespace tetlod {

namespace {

/// Kept clear of, so that another's rounding does not find the bound passed.
constexpr double margin = 1e-3;
/// A vertex as near as this to a face or an edge goes onto it, or the value across it would be another; less near,
/// where that is not enough.
constexpr double snaps[] = {1e-4, 1e-6, 1e-9};
/// So near to a corner a vertex is that corner; less near, the corner gets its values, if it has none of another: a
/// vertex beside a corner that is wrong would make the field steep.
constexpr double at_corner = 1e-6, near_corner = 1e-3;
/// Sweeps that also flip, and in which values give way; the sweeps after them insert alone, which ends.
constexpr int flipping_sweeps = 3, yielding_sweeps = 12;

template <std::size_t m>
double error_at(const AdaptiveMesh<m> &mesh, const TetFrame &frame, std::int32_t t, std::int32_t p) {
  double w[4];
  frame.weights(mesh.probes[std::size_t(p)].point, w);
  return mesh.largest_part(mesh.residual(mesh.tets[std::size_t(t)], w, mesh.probes[std::size_t(p)]));
}

template <std::size_t m>
LargestError largest_in(const AdaptiveMesh<m> &mesh, std::int32_t t) {
  LargestError largest;
  const TetFrame frame = mesh.frame(t);
  mesh.for_probes(t, [&](std::int32_t p) {
    if (std::size_t(p) >= mesh.vertex_probes) return;
    const double error = error_at(mesh, frame, t, p);
    if (error > largest.value) largest = {error, p};
  });
  return largest;
}

/// The corner of t that p is, but for `tolerance` in weight; -1 when it is none.
std::int32_t corner_at(const TetComplex &mesh, std::int32_t t, const Vec3 &p, double tolerance) {
  double w[4];
  mesh.frame(t).weights(p, w);
  const auto most = std::size_t(std::max_element(w, w + 4) - w);
  return w[most] > 1 - tolerance ? mesh.tets[std::size_t(t)][most] : -1;
}

template <std::size_t m>
class LargestErrors {
 public:
  LargestErrors(Job &job, AdaptiveMesh<m> &mesh) : job_(job), mesh_(mesh), around_(&job.memory), left_(&job.memory) {}

  Array<std::int32_t> hold(double bound) {
    for (std::size_t p = 0; p < mesh_.vertex_probes; p++) range_.add(mesh_.probes[p].value);
    for (int sweep = 0;; sweep++) {
      const std::int64_t served = serve_beyond((1 - margin) * bound, sweep < yielding_sweeps);
      if (served == 0) return std::move(left_);
      if (sweep < flipping_sweeps) flip_tets(mesh_.total_error() / double(mesh_.count()), job_, mesh_);
    }
  }

  void lower(std::int64_t tets) {
    const auto worst_in = [&](std::int32_t t) {
      const LargestError worst = largest_in(mesh_, t);
      return Need{worst.value, t, std::int32_t(worst.probe)};
    };
    serve_most_needed(tets, job_, mesh_, worst_in, [&](const Need &worst) -> const Array<std::int32_t> & {
      if (!serve(worst.tet, worst.probe)) around_.clear();
      return around_;
    });
  }

 private:
  /// How many probes; left_ are the vertices of those that could not be.
  std::int64_t serve_beyond(double bound, bool values_yield) {
    std::int64_t done = 0;
    left_.clear();
    const std::size_t count = mesh_.tets.size();
    for (std::size_t t = 0; t < count; t++) {
      if (t % 256 == 0) job_.poll(0.9);
      if (!mesh_.alive(std::int32_t(t))) continue;
      const LargestError worst = largest_in(mesh_, std::int32_t(t));
      if (worst.value <= bound) continue;
      const auto probe = std::int32_t(worst.probe);
      if ((values_yield && give_way(std::int32_t(t), probe, bound, range_, mesh_)) || serve(std::int32_t(t), probe))
        done++;
      else
        left_.push_back(mesh_.vertex_of_probe[std::size_t(worst.probe)]);
    }
    return done;
  }

  /// Makes it a vertex, whose tets are around_ then.
  bool serve(std::int32_t t, std::int32_t p) {
    const Probe<m> probe = mesh_.probes[std::size_t(p)];
    const std::int32_t corner = corner_at(mesh_, t, probe.point, near_corner);
    if (corner >= 0 && give_values(corner, probe.value)) return true;
    if (corner >= 0 && corner_at(mesh_, t, probe.point, at_corner) >= 0) return false;
    for (double snap : snaps) {
      // Flatter tets than elsewhere are taken, for the bound's sake.
      if (!insert_vertex(t, probe.point, probe.value, snap, flattest, mesh_)) continue;
      mesh_.kept.back() = held;
      mesh_.star(std::int32_t(mesh_.points.size()) - 1, around_);
      return true;
    }
    return false;
  }

  /// The original's there. Once a vertex has been given its values it is not given others.
  bool give_values(std::int32_t v, const Values<m> &values) {
    if (mesh_.kept[std::size_t(v)]) return false;
    mesh_.kept[std::size_t(v)] = held;
    mesh_.values[std::size_t(v)] = values;
    mesh_.star(v, around_);
    for (std::int32_t t : around_) mesh_.measure(t);
    return true;
  }

  Job &job_;
  AdaptiveMesh<m> &mesh_;
  Array<std::int32_t> around_;
  Array<std::int32_t> left_;
  ValueRange<m> range_;  // of all probes
};

}  // namespace

template <std::size_t m>
LargestError largest_error(const AdaptiveMesh<m> &mesh, Job &job) {
  const auto add = [](LargestError &largest, const LargestError &other) {
    if (other.value > largest.value) largest = other;
  };
  LargestError largest;
  for (const LargestError &of_part : parts_of(mesh.tets.size(), largest, job, [&](LargestError &part, std::size_t t) {
         if (mesh.alive(std::int32_t(t))) add(part, largest_in(mesh, std::int32_t(t)));
       }))
    add(largest, of_part);
  return largest;
}

template <std::size_t m>
Array<std::int32_t> hold_bound(double bound, Job &job, AdaptiveMesh<m> &mesh) {
  return LargestErrors<m>(job, mesh).hold(bound);
}

template <std::size_t m>
void lower_largest(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh) {
  LargestErrors<m>(job, mesh).lower(tets);
}

template LargestError largest_error(const AdaptiveMesh<1> &, Job &);
template LargestError largest_error(const AdaptiveMesh<2> &, Job &);
template LargestError largest_error(const AdaptiveMesh<3> &, Job &);
template LargestError largest_error(const AdaptiveMesh<4> &, Job &);
template Array<std::int32_t> hold_bound(double, Job &, AdaptiveMesh<1> &);
template void lower_largest(std::int64_t, Job &, AdaptiveMesh<1> &);
template Array<std::int32_t> hold_bound(double, Job &, AdaptiveMesh<2> &);
template void lower_largest(std::int64_t, Job &, AdaptiveMesh<2> &);
template Array<std::int32_t> hold_bound(double, Job &, AdaptiveMesh<3> &);
template void lower_largest(std::int64_t, Job &, AdaptiveMesh<3> &);
template Array<std::int32_t> hold_bound(double, Job &, AdaptiveMesh<4> &);
template void lower_largest(std::int64_t, Job &, AdaptiveMesh<4> &);

}  // namespace tetlod
