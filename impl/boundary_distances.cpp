#include "boundary_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tetlod {

namespace {

constexpr std::size_t block = 256;

}  // namespace

double distance_of_rounding(const Surface &original) {
  constexpr double part_of_diagonal = 1e-12;
  return part_of_diagonal * box_of(original.points).diagonal();
}

void find_homes(Span<const Vec3> points, const TetMesh &mesh, Job &job, Array<std::int32_t> &home,
                Array<double> &distance) {
  const TriangleTree to_mesh(mesh.points, mesh.boundary, job);
  home.assign(points.size(), -1);
  distance.assign(points.size(), 0);
  job.parallel.for_blocks(points.size(), block, [&](std::size_t begin, std::size_t end) {
    double usual2 = 0;
    for (std::size_t i = begin; i < end; i++) {
      const NearestPoint nearest = to_mesh.nearest(points[i], usual2);
      usual2 = std::max(usual2, nearest.distance * nearest.distance);
      distance[i] = nearest.distance;
      home[i] = nearest.triangle;
    }
    job.poll(1);
  });
}

BoundaryDistances::BoundaryDistances(const Surface &original, const TriangleTree &to_original, const TetMesh &mesh,
                                     Span<const std::int32_t> origin, Job &job)
    : original_(original),
      mesh_(mesh),
      job_(job),
      of_rounding_(distance_of_rounding(original)),
      to_original_(to_original),
      of_sample_(&job.memory),
      of_vertex_(mesh.points.size(), 0.0, &job.memory),
      of_middle_(mesh.boundary.size(), 0.0, &job.memory),
      first_(mesh.boundary.size(), -1, &job.memory),
      next_(original.points.size(), -1, &job.memory),
      home_(&job.memory),
      fresh_homes_(&job.memory),
      fresh_middles_(&job.memory) {
  measure_samples();
  measure_vertices(origin);
  measure_middles();
}

void BoundaryDistances::measure_samples() {
  find_homes(original_.points, mesh_, job_, home_, of_sample_);
  for (std::size_t i = 0; i < home_.size(); i++)
    if (home_[i] >= 0) next_[i] = std::exchange(first_[std::size_t(home_[i])], std::int32_t(i));
}

/// Those that are original vertices are not off.
void BoundaryDistances::measure_vertices(Span<const std::int32_t> origin) {
  Array<std::uint8_t> moved(mesh_.points.size(), 0, &job_.memory);
  for (const Triangle &t : mesh_.boundary)
    for (std::int32_t v : t) moved[std::size_t(v)] = origin[std::size_t(v)] < 0;
  job_.parallel.for_blocks(moved.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; v++)
      if (moved[v]) of_vertex_[v] = to_original_.nearest(mesh_.points[v]).distance;
    job_.poll(1);
  });
}

void BoundaryDistances::measure_middles() {
  job_.parallel.for_blocks(of_middle_.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++) of_middle_[t] = distance_of_middle(mesh_.boundary[t]);
    job_.poll(1);
  });
}

double BoundaryDistances::distance_of_middle(const Triangle &t) const {
  return to_original_.nearest(TriangleInSpace(mesh_.points, t).middle()).distance;
}

const Array<double> &BoundaryDistances::distances(Apart::Where where) const {
  return where == Apart::at_sample ? of_sample_ : where == Apart::at_vertex ? of_vertex_ : of_middle_;
}

bool BoundaryDistances::is_still(const Apart &apart) const {
  return distances(apart.where)[apart.at] == apart.distance;
}

Array<Apart> BoundaryDistances::worst(double least, std::size_t most) const {
  least = std::max(least, of_rounding_);
  Array<Apart> worst(&job_.memory);
  for (Apart::Where where : {Apart::at_sample, Apart::at_vertex, Apart::at_middle}) {
    const Array<double> &of = distances(where);
    for (std::size_t i = 0; i < of.size(); i++)
      if (of[i] > least) worst.push_back({of[i], i, where});
  }
  const std::size_t count = std::min(worst.size(), most);
  std::partial_sort(worst.begin(), worst.begin() + std::ptrdiff_t(count), worst.end());
  worst.resize(count);
  return worst;
}

/// Original vertices that stayed where they were may be nearer to what has changed: the largest are looked at again.
double BoundaryDistances::largest() const {
  const auto is_less = [](const Apart &a, const Apart &b) { return b < a; };
  const TriangleTree to_mesh(mesh_.points, mesh_.boundary, job_);
  Array<Apart> largest(&job_.memory);
  for (std::size_t i = 0; i < of_sample_.size(); i++) largest.push_back({of_sample_[i], i, Apart::at_sample});
  std::make_heap(largest.begin(), largest.end(), is_less);
  for (std::size_t turn = 1;; turn++) {
    if (turn % 256 == 0) job_.poll(1);
    std::pop_heap(largest.begin(), largest.end(), is_less);
    Apart &last = largest.back();
    const double distance = to_mesh.nearest(original_.points[last.at]).distance;
    if (!(distance < last.distance)) break;
    last.distance = distance;
    std::push_heap(largest.begin(), largest.end(), is_less);
  }
  return std::max(largest.back().distance, *std::max_element(of_vertex_.begin(), of_vertex_.end()));
}

Aim BoundaryDistances::aim_at(std::size_t sample) const {
  const Vec3 &p = original_.points[sample];
  Aim aim{p, p, {}, original_.origin[sample]};
  for (std::size_t field = 0; field < original_.fields; field++)
    aim.values.push(original_.scalars[sample * original_.fields + field]);
  return aim;
}

Aim BoundaryDistances::aim_near(const Vec3 &p) const {
  const NearestPoint nearest = to_original_.nearest(p);
  if (nearest.triangle < 0) return {p, Vec3(std::numeric_limits<double>::infinity()), {}, -1};
  const Triangle &t = original_.triangles[std::size_t(nearest.triangle)];
  Aim aim{p, TriangleInSpace(original_.points, t).at(nearest.weights), {}, -1};
  for (std::size_t field = 0; field < original_.fields; field++) aim.values.push(value_at(t, nearest.weights, field));
  return aim;
}

/// Not beyond those at the corners by rounding.
double BoundaryDistances::value_at(const Triangle &t, const Vec3 &weights, std::size_t field) const {
  const auto of = [&](std::size_t k) { return original_.scalars[std::size_t(t[k]) * original_.fields + field]; };
  const auto [low, high] = std::minmax({of(0), of(1), of(2)});
  return std::min(high, std::max(low, weights[0] * of(0) + weights[1] * of(1) + weights[2] * of(2)));
}

bool BoundaryDistances::suit(Span<const std::int32_t> old, Span<const Triangle> fresh, const Goal &goal) {
  return find_new_homes(old, fresh, goal) && find_middles(old, fresh, goal.limit);
}

bool BoundaryDistances::find_new_homes(Span<const std::int32_t> old, Span<const Triangle> fresh, const Goal &goal) {
  fresh_homes_.clear();
  for (std::int32_t t : old)
    for (std::int32_t s = first_[std::size_t(t)]; s >= 0; s = next_[std::size_t(s)]) {
      const Home home = home_among(fresh, s);
      const double most = s == goal.served ? goal.limit : std::max(goal.limit, of_sample_[std::size_t(s)]);
      if (!(home.distance <= most)) return false;
      fresh_homes_.push_back(home);
    }
  return true;
}

BoundaryDistances::Home BoundaryDistances::home_among(Span<const Triangle> fresh, std::int32_t sample) const {
  const Vec3 &p = original_.points[std::size_t(sample)];
  Home home{sample, 0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < fresh.size(); i++) {
    const double distance = std::sqrt(TriangleInSpace(mesh_.points, fresh[i]).distance2_to(p));
    if (distance < home.distance) home = {sample, i, distance};
  }
  return home;
}

bool BoundaryDistances::find_middles(Span<const std::int32_t> old, Span<const Triangle> fresh, double limit) {
  for (std::int32_t t : old) limit = std::max(limit, of_middle_[std::size_t(t)]);
  fresh_middles_.clear();
  for (const Triangle &t : fresh) {
    fresh_middles_.push_back(distance_of_middle(t));
    if (!(fresh_middles_.back() <= limit)) return false;
  }
  return true;
}

void BoundaryDistances::take(Span<const std::int32_t> old) {
  const std::size_t end = of_middle_.size(), olds = old.size();
  const auto place_of = [&](std::size_t i) { return i < olds ? std::size_t(old[i]) : end + i - olds; };
  for (std::int32_t t : old) first_[std::size_t(t)] = -1;
  first_.resize(end + fresh_middles_.size() - olds, -1);
  of_middle_.resize(first_.size(), 0);
  for (std::size_t i = 0; i < fresh_middles_.size(); i++) of_middle_[place_of(i)] = fresh_middles_[i];
  for (const Home &home : fresh_homes_) {
    const std::size_t at = place_of(home.triangle), s = std::size_t(home.sample);
    of_sample_[s] = home.distance;
    home_[s] = std::int32_t(at);
    next_[s] = std::exchange(first_[at], home.sample);
  }
}

void BoundaryDistances::take(std::int32_t v, const Aim &aim) {
  if (std::size_t(v) == of_vertex_.size()) of_vertex_.push_back(0);
  of_vertex_[std::size_t(v)] = aim.distance();
}

}  // namespace tetlod
