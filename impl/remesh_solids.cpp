#include "remesh_solids.hpp"

#include <algorithm>

#include "geometry.hpp"
#include "ray.hpp"

namespace tetlod {

namespace {

constexpr std::int32_t nowhere = -1, undecided = -2;

}  // namespace

Solids::Solids(const Surface &surface, const SurfaceFacts &facts, Job &job)
    : surface_(surface),
      frame_(uniform_frame(facts.box)),
      points_(surface.points.size(), &job.memory),
      shell_of_point_(surface.points.size(), &job.memory),
      shells_(&job.memory),
      boxes_(job.memory),
      triangles_(job.memory) {
  find_shells(job);
  if (shells_.size() < 2) return;
  for (std::size_t i = 0; i < points_.size(); i++) points_[i] = frame_.unit(surface.points[i]);
  DisjointSets solids(shells_.size(), job.memory);
  if (!measure_shells(job)) return;
  find_crowded(job);
  if (!nest_shells(job, solids)) return;
  count_ = 0;
  for (std::size_t s = 0; s < shells_.size(); s++) {
    const std::int32_t first = solids.lowest(std::int32_t(s));
    shells_[s].solid = std::size_t(first) == s ? count_++ : shells_[std::size_t(first)].solid;
  }
}

/// Numbered by their first points.
void Solids::find_shells(Job &job) {
  DisjointSets joined(surface_.points.size(), job.memory);
  for (const Triangle &t : surface_.triangles) {
    joined.join(t[0], t[1]);
    joined.join(t[0], t[2]);
  }
  for (std::size_t i = 0; i < shell_of_point_.size(); i++) {
    const std::int32_t first = joined.lowest(std::int32_t(i));
    const bool is_first = std::size_t(first) == i;
    shell_of_point_[i] = is_first ? std::int32_t(shells_.size()) : shell_of_point_[std::size_t(first)];
    if (is_first) shells_.push_back({});
  }
}

/// False when one is too flat to tell its inner side.
bool Solids::measure_shells(Job &job) {
  Array<std::size_t> end(shells_.size() + 1, 0, &job.memory);
  for (const Triangle &t : surface_.triangles) end[std::size_t(shell_of(t)) + 1]++;
  for (std::size_t s = 0; s < shells_.size(); s++) end[s + 1] += end[s];
  Array<Triangle> sorted(surface_.triangles.size(), &job.memory);
  for (const Triangle &t : surface_.triangles) sorted[end[std::size_t(shell_of(t))]++] = t;
  job.poll(0);
  for (std::size_t s = 0; s < shells_.size(); s++) {
    const std::size_t begin = s ? end[s - 1] : 0;
    const Volume volume = enclosed_volume(points_, {sorted.data() + begin, end[s] - begin});
    if (std::abs(volume.value) <= volume.uncertainty) return false;
    shells_[s].volume = volume.value;
  }
  for (std::size_t i = 0; i < points_.size(); i++) {
    Shell &shell = shells_[std::size_t(shell_of_point_[i])];
    shell.box.add(points_[i]);
    if (shell.lowest < 0 || is_before(points_[i], points_[std::size_t(shell.lowest)])) shell.lowest = std::int32_t(i);
  }
  return true;
}

/// Most solids are alone in their boxes: they are in nothing, and nothing is in them.
void Solids::find_crowded(Job &job) {
  boxes_.build(boxes_of(shells_.size(), job, [&](std::size_t s) { return shells_[s].box; }), 4, job);
  for (std::size_t s = 0; s < shells_.size(); s++) {
    if (s % 4096 == 0) job.poll(0);
    shells_[s].crowded =
        boxes_.any_overlap(shells_[s].box, [&](std::int32_t other) { return std::size_t(other) != s; });
  }
  const auto crowded_box = [&](std::size_t t) {
    const Triangle &triangle = surface_.triangles[t];
    return shells_[std::size_t(shell_of(triangle))].crowded ? box_of<3>(points_, triangle) : Box();
  };
  Array<Box> boxes = boxes_of(surface_.triangles.size(), job, crowded_box);
  axis_of_rays_ = axis_of_rays(boxes, job);
  triangles_.build(std::move(boxes), 8, job);
}

/// A cavity belongs to the shell around it. False when a cavity is in none, or a solid in the material of another.
bool Solids::nest_shells(Job &job, DisjointSets &solids) {
  Array<std::int32_t> around(shells_.size(), nowhere, &job.memory);
  job.parallel.for_blocks(shells_.size(), 16, [&](std::size_t begin, std::size_t end) {
    Crossings room(&job.memory);
    for (std::size_t s = begin; s < end; s++)
      if (shells_[s].crowded) around[s] = shell_around(points_[std::size_t(shells_[s].lowest)], std::int32_t(s), room);
    job.poll(0);
  });
  for (std::size_t s = 0; s < shells_.size(); s++) {
    const bool is_cavity = shells_[s].volume < 0;
    if (around[s] == undecided || is_cavity != (around[s] >= 0)) return false;
    if (is_cavity) solids.join(std::int32_t(s), around[s]);
  }
  return true;
}

/// False when p lies on one. `own` is not asked.
bool Solids::meet_shells(const Vec3 &p, std::int32_t own, Crossings &room) const {
  room.clear();
  return !triangles_.any_overlap(ray_to(p, triangles_.box(), axis_of_rays_), [&](std::int32_t triangle) {
    const Triangle &t = surface_.triangles[std::size_t(triangle)];
    if (shell_of(t) == own) return false;
    const TriangleInSpace met(points_, t);
    const RayEnd end = end_of_ray(met.a, met.b, met.c, p, axis_of_rays_);
    if (end == RayEnd::entered) room.push_back({shell_of(t), 1});
    if (end == RayEnd::left) room.push_back({shell_of(t), -1});
    return end == RayEnd::at;
  });
}

/// The innermost shell with p in its material; nowhere: p is in no material; undecided: on a shell, or in material
/// twice. Of nested shells the innermost is the least.
std::int32_t Solids::shell_around(const Vec3 &p, std::int32_t own, Crossings &room) const {
  if (!meet_shells(p, own, room)) return undecided;
  std::sort(room.begin(), room.end());
  std::int32_t least = nowhere, total = 0;
  for (std::size_t i = 0; i < room.size();) {
    const std::int32_t shell = room[i].first;
    std::int32_t times = 0;
    for (; i < room.size() && room[i].first == shell; i++) times += room[i].second;
    total += times;
    const double volume = shells_[std::size_t(shell)].volume;
    if (times == 1 && volume > 0 && (least < 0 || volume < shells_[std::size_t(least)].volume)) least = shell;
  }
  if (total == 0) return nowhere;
  return total == 1 && least >= 0 ? least : undecided;
}

std::int32_t Solids::of_point(std::size_t point) const {
  return count_ == 1 ? 0 : shells_[std::size_t(shell_of_point_[point])].solid;
}

std::int32_t Solids::holding(const Vec3 &p, Crossings &room) const {
  const Vec3 q = frame_.unit(p);
  Box place;
  place.add(q);
  std::int32_t only = -1;
  const bool several = boxes_.any_overlap(place, [&](std::int32_t s) {
    const Shell &shell = shells_[std::size_t(s)];
    if (shell.volume < 0) return false;
    const bool another = only >= 0 && shell.solid != only;
    only = shell.solid;
    return another;
  });
  if (!several) return only;
  const std::int32_t shell = shell_around(q, nowhere, room);
  return shell < 0 ? -1 : shells_[std::size_t(shell)].solid;
}

}  // namespace tetlod
