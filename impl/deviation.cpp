#include "deviation.hpp"

namespace tetlod {

namespace {

constexpr std::int64_t leaf = 4;
constexpr std::size_t block = 256;

double largest_distance(const Surface &from, const Surface &to, Job &job) {
  const NearestTriangle nearest(to.points, to.triangles, leaf, job);
  Array<double> largest((from.points.size() + block - 1) / block, 0.0, &job.memory);
  job.parallel.for_blocks(from.points.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; v++)
      largest[begin / block] = std::max(largest[begin / block], nearest.nearest(from.points[v]).distance);
    job.poll(1);
  });
  return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
}

double distance2_to_spoke(const Star &star, std::size_t i, const Vec3 &p) {
  const Vec3 &a = star.ring[i], &b = star.ring[star.after(i)];
  const Vec3 w = nearest_in_triangle(p, star.centre, a, b);
  return length2(w.x * star.centre + w.y * a + w.z * b - p);
}

/// A new triangle near enough to p, `first` before others; the star's size if there is none.
std::size_t near_spoke(const Star &star, std::size_t first, const Vec3 &p, double limit2) {
  for (std::size_t i = 0; i < star.size(); i++) {
    const std::size_t spoke = (first + i) % star.size();
    if (distance2_to_spoke(star, spoke, p) <= limit2) return spoke;
  }
  return star.size();
}

}  // namespace

double largest_deviation(const Surface &a, const Surface &b, Job &job) {
  return std::max(largest_distance(a, b, job), largest_distance(b, a, job));
}

DeviationLimit::DeviationLimit(const Surface &original, double limit, Job &job)
    : limit2_(limit * limit),
      original_(original),
      nearest_(original.points, original.triangles, leaf, job),
      first_(original.triangles.size(), -1, &job.memory),
      next_(original.points.size(), -1, &job.memory),
      homes_(&job.memory) {
  Array<std::uint8_t> listed(original.points.size(), 0, &job.memory);
  for (std::size_t t = 0; t < first_.size(); t++)
    for (std::int32_t v : original.triangles[t]) {
      if (listed[std::size_t(v)]) continue;
      listed[std::size_t(v)] = 1;
      next_[std::size_t(v)] = first_[t];
      first_[t] = v;
    }
}

bool DeviationLimit::is_passed(const Star &star) {
  homes_.clear();
  for (std::size_t i = 0; i < star.old_faces.size(); i++)
    for (std::int32_t v = first_[std::size_t(star.old_faces[i])]; v >= 0; v = next_[std::size_t(v)]) {
      const std::size_t spoke = near_spoke(star, i < 2 ? 0 : i - 2, original_.points[std::size_t(v)], limit2_);
      if (spoke == star.size()) return true;
      homes_.push_back({v, star.spoke_face(spoke)});
    }
  const double distance = nearest_.nearest(star.centre).distance;
  return !(distance * distance <= limit2_);
}

void DeviationLimit::move_on(const Star &star) {
  for (std::int32_t t : star.old_faces) first_[std::size_t(t)] = -1;
  for (const auto &[v, t] : homes_) {
    next_[std::size_t(v)] = first_[std::size_t(t)];
    first_[std::size_t(t)] = v;
  }
}

}  // namespace tetlod
