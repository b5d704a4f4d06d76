#include "remesh_parts.hpp"

#include <algorithm>
#include <numeric>

#include "remesh_solids.hpp"

namespace tetlod {

namespace {

/// Of each sample; -1: in none, where no tet would use it.
Array<std::int32_t> solids_of_samples(const Solids &solids, Span<const Vec3> samples, Job &job) {
  Array<std::int32_t> solid(samples.size(), &job.memory);
  job.parallel.for_blocks(samples.size(), 256, [&](std::size_t begin, std::size_t end) {
    Solids::Crossings room(&job.memory);
    for (std::size_t i = begin; i < end; i++) solid[i] = solids.holding(samples[i], room);
    job.poll(0);
  });
  return solid;
}

/// The part of each solid: a large one's own; small ones fill one after the other.
Array<std::int32_t> parts_of_solids(Span<const std::size_t> sizes, std::size_t points_at_once, Memory &memory) {
  Array<std::int32_t> part(sizes.size(), &memory);
  std::int32_t count = 0, open = -1;
  std::size_t room = 0;
  for (std::size_t s = 0; s < sizes.size(); s++) {
    if (sizes[s] >= points_at_once) {
      part[s] = count++;
      continue;
    }
    if (open < 0 || sizes[s] > room) {
      open = count++;
      room = points_at_once;
    }
    part[s] = open;
    room -= sizes[s];
  }
  return part;
}

/// The part of each point and sample; all one, to begin with.
struct Assignment {
  Assignment(std::size_t points, std::size_t samples, Memory &memory)
      : of_point(points, 0, &memory), of_sample(samples, 0, &memory) {}
  Array<std::int32_t> of_point, of_sample;
  std::size_t count = 1;
};

void assign(const Solids &solids, Span<const Vec3> samples, std::size_t points_at_once, Job &job, Assignment &parts) {
  if (solids.count() == 1) return;
  const Array<std::int32_t> solid_of_sample = solids_of_samples(solids, samples, job);
  Array<std::size_t> sizes(std::size_t(solids.count()), 0, &job.memory);
  for (std::size_t i = 0; i < parts.of_point.size(); i++) sizes[std::size_t(solids.of_point(i))]++;
  for (const std::int32_t solid : solid_of_sample)
    if (solid >= 0) sizes[std::size_t(solid)]++;
  const Array<std::int32_t> part = parts_of_solids(sizes, points_at_once, job.memory);
  for (std::size_t i = 0; i < parts.of_point.size(); i++) parts.of_point[i] = part[std::size_t(solids.of_point(i))];
  for (std::size_t i = 0; i < samples.size(); i++)
    parts.of_sample[i] = solid_of_sample[i] < 0 ? -1 : part[std::size_t(solid_of_sample[i])];
  parts.count = std::size_t(*std::max_element(part.begin(), part.end())) + 1;
}

}  // namespace

void RemeshParts::Drawers::fill(Span<const std::int32_t> part_of, std::size_t parts) {
  end_.assign(parts + 1, 0);
  for (const std::int32_t part : part_of)
    if (part >= 0) end_[std::size_t(part) + 1]++;
  for (std::size_t p = 0; p < parts; p++) end_[p + 1] += end_[p];
  items_.resize(end_[parts]);
  for (std::size_t i = 0; i < part_of.size(); i++)
    if (part_of[i] >= 0) items_[end_[std::size_t(part_of[i])]++] = std::int32_t(i);
  end_.pop_back();
}

RemeshParts::RemeshParts(const Surface &surface, const SurfaceFacts &facts, Span<const Vec3> samples,
                         std::size_t points_at_once, Job &job)
    : surface_(surface),
      facts_(facts),
      given_samples_(samples),
      job_(job),
      points_(job.memory),
      triangles_(job.memory),
      samples_(job.memory),
      number_in_part_(surface.points.size(), &job.memory) {
  Assignment parts(surface.points.size(), samples.size(), job.memory);
  if (facts.components > 1 && surface.points.size() + samples.size() > points_at_once)
    assign(Solids(surface, facts, job), samples, points_at_once, job, parts);
  Array<std::int32_t> part_of_triangle(surface.triangles.size(), &job.memory);
  for (std::size_t t = 0; t < part_of_triangle.size(); t++)
    part_of_triangle[t] = parts.of_point[std::size_t(surface.triangles[t][0])];
  points_.fill(parts.of_point, parts.count);
  triangles_.fill(part_of_triangle, parts.count);
  samples_.fill(parts.of_sample, parts.count);
  for (std::size_t p = 0; p < parts.count; p++) {
    std::int32_t next = 0;
    for (const std::int32_t point : points_.of(p)) number_in_part_[std::size_t(point)] = next++;
  }
}

RemeshPart RemeshParts::part(std::size_t part) const {
  RemeshPart made(job_.memory);
  made.surface.points.reserve(points_.of(part).size());
  for (const std::int32_t point : points_.of(part)) made.surface.points.push_back(surface_.points[std::size_t(point)]);
  made.samples.reserve(samples_.of(part).size());
  for (const std::int32_t sample : samples_.of(part)) made.samples.push_back(given_samples_[std::size_t(sample)]);
  made.surface.triangles.reserve(triangles_.of(part).size());
  for (const std::int32_t triangle : triangles_.of(part)) {
    Triangle t = surface_.triangles[std::size_t(triangle)];
    for (std::int32_t &corner : t) corner = number_in_part_[std::size_t(corner)];
    made.surface.triangles.push_back(t);
    made.components += facts_.component[std::size_t(triangle)] == triangle;
  }
  return made;
}

/// The number of each sample in the whole, which has those that a tet uses; -1: none does.
Array<std::int32_t> RemeshParts::number_samples(Span<const RemeshResult> results) const {
  Array<std::int32_t> number(given_samples_.size(), -1, &job_.memory);
  for (std::size_t p = 0; p < results.size(); p++)
    for (const std::int32_t origin : results[p].origin)
      if (const auto known = std::size_t(origin), boundary = points_.of(p).size(); origin >= 0 && known >= boundary)
        number[std::size_t(samples_.of(p)[known - boundary])] = 0;
  auto next = std::int32_t(surface_.points.size());
  for (std::int32_t &of_sample : number)
    if (of_sample >= 0) of_sample = next++;
  return number;
}

void RemeshParts::join(Span<RemeshResult> results, RemeshResult &whole) const {
  const Array<std::int32_t> number = number_samples({results.data(), results.size()});
  whole.points.assign(surface_.points.begin(), surface_.points.end());
  for (std::size_t i = 0; i < number.size(); i++)
    if (number[i] >= 0) whole.points.push_back(given_samples_[i]);
  whole.origin.resize(surface_.points.size());
  std::iota(whole.origin.begin(), whole.origin.end(), 0);
  for (std::size_t i = 0; i < number.size(); i++)
    if (number[i] >= 0) whole.origin.push_back(std::int32_t(surface_.points.size() + i));
  const std::size_t known = whole.points.size();
  std::size_t tets = 0;
  for (const RemeshResult &of_part : results) tets += of_part.tets.size();
  whole.tets.reserve(tets);
  for (std::size_t p = 0; p < results.size(); p++) {
    append(p, number, results[p], whole);
    results[p] = RemeshResult(job_.memory);
    job_.poll(1);
  }
  whole.report.steiner_points = std::int64_t(whole.points.size() - known);
  whole.report.dropped_samples = std::int64_t(given_samples_.size() + surface_.points.size() - known);
}

void RemeshParts::append(std::size_t part, Span<const std::int32_t> number_of_sample, const RemeshResult &result,
                         RemeshResult &whole) const {
  Array<std::int32_t> number(result.points.size(), &job_.memory);
  const Span<const std::int32_t> points = points_.of(part), samples = samples_.of(part);
  for (std::size_t i = 0; i < number.size(); i++) {
    const auto origin = std::size_t(result.origin[i]);
    if (result.origin[i] < 0) {
      number[i] = std::int32_t(whole.points.size());
      whole.points.push_back(result.points[i]);
      whole.origin.push_back(-1);
    } else {
      number[i] =
          origin < points.size() ? points[origin] : number_of_sample[std::size_t(samples[origin - points.size()])];
    }
  }
  for (Tet tet : result.tets) {
    for (std::int32_t &corner : tet) corner = number[std::size_t(corner)];
    whole.tets.push_back(tet);
  }
}

}  // namespace tetlod
