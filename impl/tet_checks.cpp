#include "tet_checks.hpp"

#include <cmath>
#include <numeric>

#include "geometry.hpp"
#include "predicates.hpp"
#include "remesh_checks.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

constexpr std::size_t block = std::size_t(1) << 14;  // tets between two polls of the job

/// By blocks, so the same for any number of threads.
template <class Value>
double sum_of(Span<const Tet> tets, const Value &value, double fraction, Job &job) {
  Array<double> sums((tets.size() + block - 1) / block, 0, &job.memory);
  job.parallel.for_blocks(tets.size(), block, [&](std::size_t begin, std::size_t end) {
    job.poll(fraction);
    for (std::size_t i = begin; i < end; i++) sums[begin / block] += value(tets[i]);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Positive in doubles, whichever of the three ways somebody multiplies the determinant out.
bool looks_positive(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  return glm::dot(glm::cross(u, v), w) > 0 && glm::dot(glm::cross(v, w), u) > 0 && glm::dot(glm::cross(w, u), v) > 0;
}

/// TetGen decides by exact signs, so that a tet in a thin plate may be flatter than doubles resolve. The order of its
/// corners then decides how the determinant rounds: finds one that keeps the winding and looks positive.
bool make_positive(Span<const Vec3> points, Tet &tet) {
  constexpr std::size_t even[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2},
                                       {1, 3, 2, 0}, {1, 2, 0, 3}, {2, 0, 1, 3}, {2, 1, 3, 0},
                                       {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 2, 1, 0}, {3, 1, 0, 2}};
  const Tet old = tet;
  const auto at = [&](std::int32_t corner) { return points[std::size_t(corner)]; };
  for (const auto &order : even) {
    for (std::size_t k = 0; k < 4; k++) tet[k] = old[order[k]];
    if (looks_positive(at(tet[0]), at(tet[1]), at(tet[2]), at(tet[3]))) return orientation(points, tet) > 0;
  }
  return false;
}

}  // namespace

double six_volumes(Span<const Vec3> points, Span<const Tet> tets, double fraction, Job &job) {
  return sum_of(
      tets, [&](const Tet &tet) { return six_volume(points, tet); }, fraction, job);
}

std::string make_all_positive(Span<const Vec3> points, Span<Tet> tets, double fraction, Job &job) {
  Array<std::size_t> bad((tets.size() + block - 1) / block, 0, &job.memory);
  job.parallel.for_blocks(tets.size(), block, [&](std::size_t begin, std::size_t end) {
    job.poll(fraction);
    for (std::size_t i = begin; i < end; i++) bad[begin / block] += !make_positive(points, tets[i]);
  });
  const std::size_t count = std::accumulate(bad.begin(), bad.end(), std::size_t(0));
  return count ? text("%zu of %zu tets have no volume", count, tets.size()) : std::string();
}

std::string check_volume(Span<const Vec3> points, Span<const Tet> tets, Span<const Triangle> boundary, double fraction,
                         Job &job) {
  constexpr double tolerance = 1e-9;
  const auto size = [&](const Tet &tet) { return std::abs(six_volume(points, tet)); };
  const double volume = sum_of(tets, size, fraction, job) / 6;
  const Volume expected = enclosed_volume(points, boundary);
  if (std::abs(volume - expected.value) <= tolerance * expected.value + expected.uncertainty) return {};
  return "tets overlap or are missing: the volume is " + number(volume / expected.value) + " of the boundary's";
}

}  // namespace tetlod
