#include "solid_mesh.hpp"

#include "weigh_planes.hpp"

namespace tetlod {

template <std::size_t m>
FieldsAsLengths<m>::FieldsAsLengths(const MeshView &original, double diagonal, Job &job) {
  const Span<const Values<m>> values = original.values<m>();
  const auto add = [&](ValueRange<m> &of_part, std::size_t t) {
    for (std::int32_t v : original.tets[t]) of_part.add(values[std::size_t(v)]);
  };
  for (const ValueRange<m> &of_part : parts_of(original.tets.size(), range, job, add)) range.add(of_part);
  double half = 0;  // the whole may be more than a double holds; the first may be constant
  for (std::size_t i = 0; i < m && !(half > 0); i++)
    half = original.scales.relative[i] * (0.5 * range.high[i] - 0.5 * range.low[i]);
  const double longest = 0.5 * diagonal / half;
  const double scale = std::isfinite(longest) ? longest : 1;  // a range that small counts as none
  for (std::size_t i = 0; i < m; i++) scales[i] = scale * original.scales.weighted[i];
}

template <std::size_t m>
SolidMesh<m>::SolidMesh(SolidInOrder solid, Span<const Values<m>> values, const Values<m> &scales, double planes,
                        Job &job)
    : SolidComplex(std::move(solid), job),
      origin(std::move(solid.origin)),
      lengths_(array_of(points.size(), Vector<m>(), job)),
      quadrics_(array_of(points.size(), Quadric(), job)) {
  for_each(points.size(), job, [&](std::size_t v) {
    for (std::size_t i = 0; i < m; i++) lengths_[v][i] = scales[i] * values[std::size_t(origin[v])][i];
  });
  find_quadrics(planes, job);
}

template <std::size_t m>
SolidMesh<m>::SolidMesh(SolidRemains<m> &&remains, Job &job)
    : SolidComplex(std::move(remains.points), std::move(remains.ranks), std::move(remains.tets),
                   std::move(remains.triangles), remains.measures, job),
      origin(std::move(remains.origin)),
      lengths_(std::move(remains.lengths)),
      quadrics_(std::move(remains.quadrics)) {}

template <std::size_t m>
SolidRemains<m> SolidMesh<m>::take_remains(Span<const std::int32_t> number, Job &job) {
  for (StarLists *lists : {&tets_of, &triangles_of}) *lists = StarLists(0, job);  // first, to make room
  const auto is_left = [&](std::size_t v) { return number[v] >= 0; };
  job.parallel.at_once([&] { keep_where(quadrics_, job, is_left); },  // the longest ones first
                       [&] { keep_left(tets, number, job); }, [&] { keep_where(points, job, is_left); },
                       [&] { keep_where(lengths_, job, is_left); }, [&] { keep_where(origin, job, is_left); },
                       [&] { keep_where(ranks, job, is_left); }, [&] { keep_left(triangles, number, job); });
  SolidRemains<m> remains(job.memory);
  remains.measures = measures;
  remains.origin = std::move(origin);
  remains.points = std::move(points);
  remains.ranks = std::move(ranks);
  remains.lengths = std::move(lengths_);
  remains.quadrics = std::move(quadrics_);
  remains.tets = std::move(tets);
  remains.triangles = std::move(triangles);
  return remains;
}

template <std::size_t m>
void SolidMesh<m>::find_quadrics(double planes, Job &job) {
  job.parallel.for_parts(points.size(), [&](std::size_t begin, std::size_t end) { add_tets(begin, end, job); });
  measures.weight_of_planes = planes * weigh_planes(*this, job);
  for_each(points.size(), job, [&](std::size_t v) {
    for (std::int32_t t : triangles_of.of(std::int32_t(v)))
      quadrics_[v].add_plane(normal(t), measures.weight_of_planes);
  });
}

/// To the quadrics of the vertices begin to end.
template <std::size_t m>
void SolidMesh<m>::add_tets(std::size_t begin, std::size_t end, Job &job) {
  const auto is_among = [&](std::int32_t v) { return std::size_t(v) - begin < end - begin; };
  for (std::size_t t = 0; t < tets.size(); t++) {
    job.poll_at(t, 0);
    const Tet &tet = tets[t];
    if (!(is_among(tet[0]) | is_among(tet[1]) | is_among(tet[2]) | is_among(tet[3]))) continue;
    const auto normals = upright_normals<m>({place(tet[0]), place(tet[1]), place(tet[2]), place(tet[3])});
    for (const Place &normal : normals) {
      const auto square = Quadric::square_of(normal, 1);
      for (std::int32_t v : tet)
        if (is_among(v)) quadrics_[std::size_t(v)].add(square);
    }
  }
}

template <std::size_t m>
BestOfEdge SolidMesh<m>::cost(std::int32_t v, std::int32_t u) const {
  const auto [stays, gone] = ends_of(v, u);
  if (!may_go(gone) || rank(stays) == Rank::touching) return {0, std::numeric_limits<double>::infinity()};
  const Quadric &a = quadric(stays), &b = quadric(gone);
  const Place d = minus(place(gone), place(stays));
  BestOfEdge best = best_of_edge(a, b, d, keeps_place(stays, gone));
  best.cost += shape_share * length2(point_of(d)) * (a.a[tets_of_vertex] + b.a[tets_of_vertex]);
  return best;
}

template <std::size_t m>
void SolidMesh<m>::collapse(const SolidEdge &edge, const Place &to, CollapseRoom &room) {
  Quadric &stays = quadrics_[std::size_t(edge.stays)];
  stays = stays.moved(minus(to, place(edge.stays)));
  stays.add(quadric(edge.gone).moved(minus(to, place(edge.gone))));
  std::copy(to.begin() + 3, to.end(), lengths_[std::size_t(edge.stays)].begin());
  SolidComplex::collapse(edge, point_of(to), room);
}

template struct FieldsAsLengths<1>;
template struct FieldsAsLengths<2>;
template struct FieldsAsLengths<3>;
template struct FieldsAsLengths<4>;
template class SolidMesh<1>;
template class SolidMesh<2>;
template class SolidMesh<3>;
template class SolidMesh<4>;

}  // namespace tetlod
