#include "solid_complex.hpp"

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// A tet with this part of the usual shape is flat.
constexpr double flat_beside_usual = 0.01;
/// Neighbours of a vertex, about.
constexpr std::size_t usual_neighbours = 15;

/// Lists that merge leave room behind.
std::size_t room_to_merge(std::size_t entries) { return entries * 5 / 4; }

double volume6(const SolidComplex &mesh, const Tet &t) {
  return det(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]), mesh.point(t[3]));
}

Array<Tet> without_excluded(const MeshView &original, const Boundary &boundary, Memory &memory) {
  Array<Tet> tets(&memory);
  tets.reserve(original.tets.size());
  for (std::size_t t = 0; t < original.tets.size(); t++)
    if (boundary.excluded.empty() || !boundary.excluded[t]) tets.push_back(original.tets[t]);
  return tets;
}

}  // namespace

SolidComplex::SolidComplex(const MeshView &original, const Boundary &boundary, Job &job)
    : points(original.points.begin(), original.points.end(), &job.memory),
      ranks(original.points.size(), Rank::inner, &job.memory),
      tets(without_excluded(original, boundary, job.memory)),
      triangles(boundary.triangles.begin(), boundary.triangles.end(), &job.memory),
      tets_of(Span<const Tet>(tets), original.points.size(), room_to_merge(4 * tets.size()), job),
      triangles_of(Span<const Triangle>(triangles), original.points.size(), room_to_merge(3 * triangles.size()), job),
      neighbours(original.points.size(), usual_neighbours * original.points.size(), job),
      count(std::int64_t(tets.size())),
      touched_(tets.size(), 0, &job.memory),
      list_(&job.memory) {
  for (Tet &t : tets)
    if (volume6(*this, t) < 0) std::swap(t[2], t[3]);
  for (const Triangle &t : triangles)
    for (std::int32_t v : t) ranks[std::size_t(v)] = Rank::boundary;
  find_neighbours(job);
  const double flat = flat_beside_usual * flat_beside_usual * usual_shape2(job.memory);
  least_shape2 = std::min(least_shape * least_shape, flat);
}

/// The median of some thousand tets'. Of a squeezed mesh all are flat.
double SolidComplex::usual_shape2(Memory &memory) const {
  constexpr std::size_t enough = 4096;
  Array<double> shapes(&memory);
  for (std::size_t i = 0; i < tets.size(); i += tets.size() / enough + 1) {
    const Tet &t = tets[i];
    shapes.push_back(shape2(point(t[0]), point(t[1]), point(t[2]), point(t[3])));
  }
  const auto middle = shapes.begin() + std::ptrdiff_t(shapes.size() / 2);
  std::nth_element(shapes.begin(), middle, shapes.end());
  return *middle;
}

Vec3 SolidComplex::normal(std::int32_t triangle) const {
  const Triangle &t = triangles[std::size_t(triangle)];
  return area_vector(point(t[0]), point(t[1]), point(t[2]));
}

double SolidComplex::volume() const {
  double sum = 0;
  for (const Tet &t : tets) sum += volume6(*this, t);
  return sum / 6;
}

void SolidComplex::find_neighbours(Job &job) {
  Array<std::int32_t> seen_by(points.size(), -1, &job.memory);
  for (std::size_t v = 0; v < points.size(); v++) {
    if (v % 4096 == 0) job.poll(0);
    list_.clear();
    seen_by[v] = std::int32_t(v);
    for (std::int32_t t : tets_of.of(std::int32_t(v)))
      for (std::int32_t u : tets[std::size_t(t)]) {
        if (seen_by[std::size_t(u)] == std::int32_t(v)) continue;
        seen_by[std::size_t(u)] = std::int32_t(v);
        list_.push_back(u);
      }
    neighbours.set(std::int32_t(v), list_);
  }
}

bool SolidComplex::touched(const SolidEdge &edge) const {
  const auto any = [&](const auto &some) {
    return std::any_of(some.begin(), some.end(), [&](std::int32_t t) { return touched_[std::size_t(t)] == batch_; });
  };
  return any(edge.edge_tets) || any(edge.stays_tets) || any(edge.gone_tets);
}

void SolidComplex::collapse(const SolidEdge &edge, const Vec3 &point) {
  points[std::size_t(edge.stays)] = point;
  const auto touch = [&](const auto &some) {
    for (std::int32_t t : some) touched_[std::size_t(t)] = batch_;
  };
  touch(edge.edge_tets);
  touch(edge.stays_tets);
  touch(edge.gone_tets);
  count -= std::int64_t(edge.edge_tets.size());
  merge_stars(edge, tets, tets_of);
  if (on_boundary(edge.gone)) merge_stars(edge, triangles, triangles_of);
  merge_neighbours(edge);
}

template <class Simplices>
void SolidComplex::merge_stars(const SolidEdge &edge, Simplices &simplices, StarLists &stars) {
  list_.clear();
  for (std::int32_t s : stars.of(edge.gone)) {
    auto &simplex = simplices[std::size_t(s)];
    if (simplex[0] < 0) continue;
    if (std::find(simplex.begin(), simplex.end(), edge.stays) != simplex.end()) {
      simplex[0] = -1;
      continue;
    }
    *std::find(simplex.begin(), simplex.end(), edge.gone) = edge.stays;
    list_.push_back(s);
  }
  for (std::int32_t s : stars.of(edge.stays))
    if (simplices[std::size_t(s)][0] >= 0) list_.push_back(s);
  stars.set(edge.stays, list_);
  stars.set(edge.gone, {});
}

void SolidComplex::merge_neighbours(const SolidEdge &edge) {
  const Span<const std::int32_t> of_stays = neighbours.of(edge.stays);
  list_.assign(of_stays.begin(), of_stays.end());
  list_.erase(std::find(list_.begin(), list_.end(), edge.gone));
  for (std::int32_t u : neighbours.of(edge.gone)) {
    if (u == edge.stays) continue;
    if (std::find(of_stays.begin(), of_stays.end(), u) != of_stays.end()) {
      neighbours.remove(u, edge.gone);
    } else {
      neighbours.replace(u, edge.gone, edge.stays);
      list_.push_back(u);
    }
  }
  neighbours.set(edge.stays, list_);
  neighbours.set(edge.gone, {});
}

}  // namespace tetlod
