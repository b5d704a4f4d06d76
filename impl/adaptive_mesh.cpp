#include "adaptive_mesh.hpp"

#include <limits>

namespace tetlod {

template <std::size_t m>
void AdaptiveMesh<m>::connect(Job &job) {
  TetComplex::connect(job);
  error.assign(tets.size(), 0.0);
  first_probe.assign(tets.size(), -1);
}

template <std::size_t m>
void AdaptiveMesh<m>::measure(std::int32_t t) {
  const TetFrame f = frame(t);
  double sum = 0, w[4];
  for_probes(t, [&](std::int32_t p) {
    f.weights(probes[std::size_t(p)].point, w);
    sum += weight_of(p) * square(residual(tets[std::size_t(t)], w, probes[std::size_t(p)]));
  });
  // Differences of the largest doubles may be no numbers, which have no order.
  error[std::size_t(t)] = sum >= 0 ? sum : std::numeric_limits<double>::infinity();
}

template <std::size_t m>
double AdaptiveMesh<m>::total_error() const {
  double sum = 0;
  for (double e : error) sum += e;
  return sum;
}

/// What replace() would make of the error, not summed further than `limit`.
template <std::size_t m>
double AdaptiveMesh<m>::error_after(Span<const std::int32_t> old, Span<const Tet> fresh, const TetFrame *frames,
                                    double limit) const {
  double sum = 0, w[4];
  for (std::int32_t t : old)
    for (std::int32_t p = first_probe[std::size_t(t)]; p >= 0; p = next_probe[std::size_t(p)]) {
      const Probe<m> &probe = probes[std::size_t(p)];
      sum += weight_of(p) * square(residual(fresh[home_among(frames, fresh.size(), 0, probe.point, w)], w, probe));
      if (sum > limit) return sum;
    }
  return sum;
}

template <std::size_t m>
bool AdaptiveMesh<m>::is_better(Span<const std::int32_t> old, Span<const Tet> fresh, double price, double old_error,
                                double &best) const {
  TetFrame frames[largest_cavity];
  for (std::size_t i = 0; i < fresh.size(); i++) {
    if (!is_sound(fresh[i], least_shape)) return false;
    frames[i] = frame(fresh[i]);
  }
  const double cost = price * (double(fresh.size()) - double(old.size())) - old_error;
  const double change = error_after(old, fresh, frames, best - cost) + cost;
  if (!(change < best)) return false;
  best = change;
  return true;
}

template <std::size_t m>
void AdaptiveMesh<m>::replace(Span<const std::int32_t> old, Span<const Tet> fresh, Array<std::int32_t> &made) {
  Array<std::int32_t> homeless(&memory());
  for (std::int32_t t : old) {
    for_probes(t, [&](std::int32_t p) { homeless.push_back(p); });
    error[std::size_t(t)] = 0;
    first_probe[std::size_t(t)] = -1;
  }
  replace_tets(old, fresh, made);
  error.resize(tets.size(), 0);
  first_probe.resize(tets.size(), -1);
  Array<TetFrame> frames(&memory());
  for (const Tet &t : fresh) frames.push_back(frame(t));
  double w[4];
  for (std::size_t i = homeless.size(); i-- > 0;) {
    const Vec3 &p = probes[std::size_t(homeless[i])].point;
    put_probe(homeless[i], made[home_among(frames.data(), frames.size(), 0, p, w)]);
  }
  for (std::int32_t t : made) {
    touch(t);
    measure(t);
  }
}

template <std::size_t m>
void AdaptiveMesh<m>::measure_all(double fraction, Job &job) {
  job.parallel.for_blocks(tets.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++)
      if (alive(std::int32_t(t))) measure(std::int32_t(t));
    job.poll(fraction);
  });
}

template class AdaptiveMesh<1>;
template class AdaptiveMesh<2>;
template class AdaptiveMesh<3>;
template class AdaptiveMesh<4>;

}  // namespace tetlod
