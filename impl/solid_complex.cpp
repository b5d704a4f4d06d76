#include "solid_complex.hpp"

#include <numeric>

#include "usual_shape.hpp"

namespace tetlod {

namespace {

/// A tet with this part of the usual shape is flat.
constexpr double flat_beside_usual = 0.01;

}  // namespace

SolidComplex::SolidComplex(SolidInOrder &&solid, Job &job)
    : SolidComplex(std::move(solid.points), Array<Rank>(solid.points.size(), Rank::inner, &job.memory),
                   std::move(solid.tets), std::move(solid.triangles), {}, job) {
  for (const Triangle &t : triangles)
    for (std::int32_t v : t) ranks[std::size_t(v)] = Rank::boundary;
  const double flat = flat_beside_usual * flat_beside_usual * usual_shape2(points, tets, job.memory);
  measures = {std::min(least_shape * least_shape, flat), volume(job), points.size(), tets.size(), 0};
}

SolidComplex::SolidComplex(Array<Vec3> &&points_of, Array<Rank> &&ranks_of, Array<Tet> &&tets_of_it,
                           Array<Triangle> &&triangles_of_it, const SolidMeasures &of_original, Job &job)
    : points(std::move(points_of)),
      ranks(std::move(ranks_of)),
      tets(std::move(tets_of_it)),
      triangles(std::move(triangles_of_it)),
      tets_of(Span<const Tet>(tets), points.size(), job),
      triangles_of(Span<const Triangle>(triangles), points.size(), job),
      measures(of_original) {}

Vec3 SolidComplex::normal(std::int32_t triangle) const { return area_vector(points, triangles[std::size_t(triangle)]); }

double SolidComplex::volume(Job &job) const {
  const Array<double> parts =
      parts_of(tets.size(), 0.0, job, [&](double &sum, std::size_t t) { sum += six_volume(points, tets[t]); });
  return std::accumulate(parts.begin(), parts.end(), 0.0) / 6;
}

void SolidComplex::collapse(const SolidEdge &edge, const Vec3 &point, CollapseRoom &room) {
  points[std::size_t(edge.stays)] = point;
  if (edge.is_widened())
    fill_cavity(edge, room);
  else
    merge_tets(edge, room);
  if (on_boundary(edge.gone)) merge_triangles(edge, room);
}

/// Without branches, from there on; where they end.
std::int32_t *SolidComplex::list_left(Span<const std::int32_t> star, std::int32_t *place) const {
  for (std::int32_t t : star) {
    *place = t;
    place += has_tet(t);
  }
  return place;
}

void SolidComplex::merge_tets(const SolidEdge &edge, CollapseRoom &room) {
  for (std::int32_t t : edge.edge_tets) tets[std::size_t(t)][0] = -1;
  for (std::int32_t t : edge.gone_tets)
    for (std::int32_t &v : tets[std::size_t(t)]) v = v == edge.gone ? edge.stays : v;
  const Span<const std::int32_t> of_stays = tets_of.of(edge.stays);
  std::int32_t *const list = room.of_size(edge.gone_tets.size() + of_stays.size());
  const std::int32_t *const end = list_left(of_stays, std::copy(edge.gone_tets.begin(), edge.gone_tets.end(), list));
  tets_of.set(edge.stays, {list, std::size_t(end - list)}, room.tets);
  tets_of.clear(edge.gone);
}

void SolidComplex::fill_cavity(const SolidEdge &edge, CollapseRoom &room) {
  room.around.find(edge.gone, edge.cavity, tets);
  for (std::int32_t t : edge.cavity) tets[std::size_t(t)][0] = -1;
  for (std::int32_t v : room.around) {
    const Span<const std::int32_t> before = tets_of.of(v);
    std::int32_t *const list = room.of_size(before.size() + edge.fresh.size());
    std::int32_t *end = list_left(before, list);
    for (std::size_t i = 0; i < edge.fresh.size(); i++) {
      *end = edge.cavity[i];
      end += has(edge.fresh[i], v);
    }
    tets_of.set(v, {list, std::size_t(end - list)}, room.tets);
  }
  tets_of.clear(edge.gone);
  for (std::size_t i = 0; i < edge.fresh.size(); i++) tets[std::size_t(edge.cavity[i])] = edge.fresh[i];
}

void SolidComplex::merge_triangles(const SolidEdge &edge, CollapseRoom &room) {
  room.list.clear();
  for (std::int32_t t : triangles_of.of(edge.gone)) {
    if (!has_triangle(t)) continue;
    Triangle &triangle = triangles[std::size_t(t)];
    if (std::find(triangle.begin(), triangle.end(), edge.stays) != triangle.end()) {
      triangle[0] = -1;
    } else {
      *std::find(triangle.begin(), triangle.end(), edge.gone) = edge.stays;
      room.list.push_back(t);
    }
  }
  for (std::int32_t t : triangles_of.of(edge.stays))
    if (has_triangle(t)) room.list.push_back(t);
  triangles_of.set(edge.stays, room.list, room.triangles);
  triangles_of.clear(edge.gone);
}

void SolidComplex::tidy(Span<CollapseRoom> rooms, Job &job) {
  const auto tidy_up = [&](StarLists &lists, ListRoom CollapseRoom::*room) {
    std::size_t taken = 0;
    for (const CollapseRoom &some : rooms) taken += (some.*room).taken();
    if (taken * much < lists.room()) return;
    lists.compact(job);
    for (CollapseRoom &some : rooms) (some.*room).clear();
  };
  tidy_up(tets_of, &CollapseRoom::tets);
  tidy_up(triangles_of, &CollapseRoom::triangles);
}

}  // namespace tetlod
