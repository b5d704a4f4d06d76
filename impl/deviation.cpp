#include "deviation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "status.hpp"

namespace tetlod {

namespace {

constexpr std::size_t block = 256;

/// visit(point, triangle), the triangle being one of those that have the point.
template <class Visit>
void for_samples(const Surface &surface, Samples samples, Job &job, const Visit &visit) {
  Array<std::uint8_t> seen(surface.points.size(), 0, &job.memory);
  for (std::size_t t = 0; t < surface.triangles.size(); t++) {
    job.poll_at(t, 0);
    const Triangle &triangle = surface.triangles[t];
    Vec3 corner[3];
    for (std::size_t k = 0; k < 3; k++) {
      corner[k] = surface.points[std::size_t(triangle[k])];
      if (!std::exchange(seen[std::size_t(triangle[k])], std::uint8_t(1))) visit(corner[k], t);
    }
    if (samples == Samples::vertices) continue;
    visit((corner[0] + corner[1] + corner[2]) / 3.0, t);
    for (std::size_t k = 0; k < 3; k++)  // of the two triangles at an edge one has it this way
      if (triangle[k] < triangle[(k + 1) % 3]) visit(0.5 * (corner[k] + corner[(k + 1) % 3]), t);
  }
}

/// With those between. Of a closed surface, which has three edges for two triangles.
std::size_t count_samples(const Surface &surface) {
  return surface.points.size() + surface.triangles.size() + surface.triangles.size() / 2 * 3;
}

/// The distance of the farthest of every `step` points, or `known`, if that is more.
double farthest(Span<const Vec3> points, std::size_t step, const TriangleTree &to, double known, Job &job) {
  Array<double> of_blocks(points.size() / (step * block) + 1, known, &job.memory);
  job.parallel.for_blocks((points.size() + step - 1) / step, block, [&](std::size_t begin, std::size_t end) {
    double &most = of_blocks[begin / block];
    std::int32_t near = -1;  // often the same one for several points
    for (std::size_t i = begin; i < end; i++)
      if (const Vec3 &p = points[i * step]; !to.is_within(p, most * most, near))
        most = std::max(most, to.nearest(p).distance);
    job.poll(0);
  });
  return *std::max_element(of_blocks.begin(), of_blocks.end());
}

/// Some of the points tell about how far the farthest is: of most others it is soon seen then that they are nearer.
double farthest(const Surface &from, const TriangleTree &to, Samples samples, double known, Job &job) {
  constexpr std::size_t sparse = 32;
  Array<Vec3> points(&job.memory);
  for_samples(from, samples, job, [&](const Vec3 &p, std::size_t) { points.push_back(p); });
  for (std::size_t step : {sparse, std::size_t(1)}) known = farthest(points, step, to, known, job);
  return known;
}

TriangleInSpace spoke_of(const Star &star, std::size_t i) {
  return {star.centre, star.ring[i], star.ring[star.after(i)]};
}

/// A new triangle near enough to p, `first` before others; the star's size if there is none.
std::size_t near_spoke(const Star &star, std::size_t first, const Vec3 &p, double limit2) {
  for (std::size_t i = 0; i < star.size(); i++) {
    const std::size_t spoke = (first + i) % star.size();
    if (spoke_of(star, spoke).distance2_to(p) <= limit2) return spoke;
  }
  return star.size();
}

}  // namespace

double largest_deviation(const Surface &a, TreeOnDemand &tree_of_a, const Surface &b, TreeOnDemand tree_of_b,
                         Samples samples, Job &job) {
  const double from_a = farthest(a, tree_of_b.get(job), samples, 0, job);
  tree_of_b.drop();
  return farthest(b, tree_of_a.get(job), samples, from_a, job);
}

void SamplesOfStar::begin(const Star &star) {
  homes_.clear();
  places_.clear();
  places_.push_back({star.centre});
  for (const Vec3 &p : star.ring) places_.push_back({0.5 * (star.centre + p)});
  for (std::size_t i = 0; i < star.size(); i++) places_.push_back({spoke_of(star, i).middle()});
}

void SamplesOfStar::add(const Star &star, std::int32_t sample, const Vec3 &p, std::size_t spoke) {
  homes_.push_back({sample, star.spoke_face(spoke)});
  for (std::size_t i : {std::size_t(0), 1 + spoke, 1 + star.after(spoke), 1 + star.size() + spoke}) {
    Place &place = places_[i];
    if (const double d = length2(place.point - p); d < place.distance2) place = {place.point, sample, d};
  }
}

DeviationLimit::DeviationLimit(const Surface &original, const TriangleTree &nearest, double limit, Job &job)
    : limit2_(limit * limit),
      nearest_(nearest),
      samples_(&job.memory),
      triangle_(&job.memory),
      first_(original.triangles.size(), -1, &job.memory),
      next_(&job.memory) {
  const std::size_t most = count_samples(original);
  if (most > std::size_t(std::numeric_limits<std::int32_t>::max()))
    fail(Status::mesh_too_large, "%zu boundary triangles are too many to hold max-deviation",
         original.triangles.size());
  samples_.reserve(most);
  triangle_.reserve(most);
  next_.reserve(most);
  for_samples(original, Samples::between_too, job, [&](const Vec3 &p, std::size_t t) {
    next_.push_back(std::exchange(first_[t], std::int32_t(samples_.size())));
    samples_.push_back(p);
    triangle_.push_back(std::int32_t(t));
  });
}

bool DeviationLimit::is_passed(const Star &star, SamplesOfStar &of_star) const {
  of_star.begin(star);
  for (std::size_t i = 0; i < star.old_faces.size(); i++)
    for (std::int32_t s = first_[std::size_t(star.old_faces[i])]; s >= 0; s = next_[std::size_t(s)]) {
      const Vec3 &p = samples_[std::size_t(s)];
      const std::size_t spoke = near_spoke(star, i < 2 ? 0 : i - 2, p, limit2_);
      if (spoke == star.size()) return true;
      of_star.add(star, s, p, spoke);
    }
  return std::any_of(of_star.places().begin(), of_star.places().end(),
                     [&](const SamplesOfStar::Place &place) { return is_far(place); });
}

/// Mostly the original's triangle with the nearest sample is near enough.
bool DeviationLimit::is_far(const SamplesOfStar::Place &place) const {
  std::int32_t near = place.nearest >= 0 ? triangle_[std::size_t(place.nearest)] : -1;
  return !nearest_.is_within(place.point, limit2_, near);
}

void DeviationLimit::move_on(const Star &star, const SamplesOfStar &of_star) {
  for (std::int32_t t : star.old_faces) first_[std::size_t(t)] = -1;
  for (const auto &[s, t] : of_star.homes()) next_[std::size_t(s)] = std::exchange(first_[std::size_t(t)], s);
}

}  // namespace tetlod
