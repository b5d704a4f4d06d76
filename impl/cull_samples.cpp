#include "cull_samples.hpp"

#include "geometry.hpp"
#include "surface_distance.hpp"

namespace tetlod {

namespace {

enum class Verdict : std::uint8_t { unknown, keep, outside, too_near };

/// Of the triangle's least height; nearer points make TetGen slow, or replace vertices.
constexpr double least_of_height = 0.02;

double least_height(const Surface &surface, std::int32_t triangle) {
  const Triangle &t = surface.triangles[std::size_t(triangle)];
  const Vec3 &a = surface.points[std::size_t(t[0])], &b = surface.points[std::size_t(t[1])],
             &c = surface.points[std::size_t(t[2])];
  const double longest = std::max({length2(b - a), length2(c - b), length2(a - c)});
  return longest > 0 ? glm::length(area_vector(a, b, c)) / std::sqrt(longest) : 0;
}

Verdict judge(const Vec3 &p, const Surface &surface, const SurfaceDistance &distance, double min_distance) {
  NearestPoint nearest;
  const double inside = distance.signed_distance(p, nearest);
  if (!(inside > 0)) return Verdict::outside;
  const double least = std::max(min_distance, least_of_height * least_height(surface, nearest.triangle));
  return inside < least ? Verdict::too_near : Verdict::keep;
}

}  // namespace

CullReport cull_samples(Span<const Vec3> points, const Surface &surface, const SurfaceTopology &topology,
                        double min_distance, std::int64_t leaf, Job &job, Array<std::int32_t> &samples,
                        Span<const std::uint8_t> may_be_near, Span<std::uint8_t> known) {
  const SurfaceDistance distance(surface, topology, leaf, job);
  Array<Verdict> verdicts(samples.size(), Verdict::unknown, &job.memory);
  CullReport report;
  if (!known.empty())
    for (std::size_t i = 0; i < samples.size(); i++) {
      verdicts[i] = Verdict(known[std::size_t(samples[i])]);
      report.known += verdicts[i] != Verdict::unknown;
    }
  job.parallel.for_blocks(samples.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i++) {
      const auto v = std::size_t(samples[i]);
      if (verdicts[i] == Verdict::unknown) verdicts[i] = judge(points[v], surface, distance, min_distance);
      if (!known.empty()) known[v] = std::uint8_t(verdicts[i]);
      if (verdicts[i] == Verdict::too_near && !may_be_near.empty() && may_be_near[v]) verdicts[i] = Verdict::keep;
    }
    job.poll(double(end) / double(samples.size()));
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); i++) {
    report.outside += verdicts[i] == Verdict::outside;
    report.too_near += verdicts[i] == Verdict::too_near;
    if (verdicts[i] == Verdict::keep) samples[kept++] = samples[i];
  }
  samples.resize(kept);
  return report;
}

}  // namespace tetlod
