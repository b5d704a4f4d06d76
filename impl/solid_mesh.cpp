#include "solid_mesh.hpp"

#include "tet_frame.hpp"

namespace tetlod {

namespace {

/// Where nothing is lost, short edges first: what the square of a length counts as.
constexpr double shape_share = 1e-6;

template <class Vertices>
Array<Vec3> points_of(const Vertices &vertices, Memory &memory) {
  Array<Vec3> points(&memory);
  points.reserve(vertices.size());
  for (const auto &vertex : vertices) points.push_back(point_of(vertex.place));
  return points;
}

}  // namespace

template <std::size_t m>
FieldsAsLengths<m>::FieldsAsLengths(const MeshView &original, double diagonal) {
  const Span<const Values<m>> values = original.values<m>();
  for (const Tet &t : original.tets)
    for (std::int32_t v : t) range.add(values[std::size_t(v)]);
  double half = 0;  // the whole may be more than a double holds; the first may be constant
  for (std::size_t i = 0; i < m && !(half > 0); i++)
    half = original.scales.relative[i] * (0.5 * range.high[i] - 0.5 * range.low[i]);
  const double scale = half > 0 ? 0.5 * diagonal / half : 1;
  for (std::size_t i = 0; i < m; i++) scales[i] = scale * original.scales.weighted[i];
}

template <std::size_t m>
SolidMesh<m>::SolidMesh(SolidInOrder solid, Span<const Values<m>> values, const Values<m> &scales, Job &job)
    : SolidComplex(std::move(solid), job),
      origin(std::move(solid.origin)),
      vertices_(points.size(), Vertex(), &job.memory) {
  for (std::size_t v = 0; v < vertices_.size(); v++)
    for (std::size_t i = 0; i < 3 + m; i++)
      vertices_[v].place[i] = i < 3 ? points[v][int(i)] : scales[i - 3] * values[std::size_t(origin[v])][i - 3];
  find_quadrics(job);
}

template <std::size_t m>
SolidMesh<m>::SolidMesh(SolidRemains<m> &&remains, Job &job)
    : SolidComplex(points_of(remains.vertices, job.memory), std::move(remains.ranks), std::move(remains.tets),
                   std::move(remains.triangles), remains.measures, job),
      origin(std::move(remains.origin)),
      vertices_(std::move(remains.vertices)) {}

template <std::size_t m>
SolidRemains<m> SolidMesh<m>::take_remains(Span<const std::int32_t> left, Span<const std::int32_t> number, Job &job) {
  for (StarLists *lists : {&tets_of, &triangles_of, &neighbours}) *lists = StarLists(0, job);  // first, to make room
  points = Array<Vec3>(&job.memory);
  keep_alone(left, origin);
  keep_alone(left, ranks);
  keep_alone(left, vertices_);
  SolidRemains<m> remains(job.memory);
  remains.measures = measures;
  remains.origin = std::move(origin);
  remains.ranks = std::move(ranks);
  remains.vertices = std::move(vertices_);
  append_left(tets, number, remains.tets);
  tets = Array<Tet>(&job.memory);
  append_left(triangles, number, remains.triangles);
  return remains;
}

/// Of the tet's linear functions; none for a flat one.
template <std::size_t m>
typename SolidMesh<m>::Gradients SolidMesh<m>::gradients(const Tet &t) const {
  const TetFrame frame(point(t[0]), point(t[1]), point(t[2]), point(t[3]));
  Gradients all;
  for (std::size_t i = 0; i < m; i++) {
    const Vec3 g = frame.gradient(vertex(t[0]).place[3 + i], vertex(t[1]).place[3 + i], vertex(t[2]).place[3 + i],
                                  vertex(t[3]).place[3 + i]);
    all[i] = std::isfinite(g.x + g.y + g.z) ? g : Vec3(0);
  }
  return all;
}

/// What the distance from a plane of the boundary counts as beside the same difference of values. The fewer of the
/// vertices are on the boundary, the less is gained by moving it; by experience.
template <std::size_t m>
double SolidMesh<m>::weight_of_planes() const {
  constexpr double least = 20, by_share = 3.5, most = 2e4;
  double boundary = 0;
  for (std::size_t v = 0; v < vertices_.size(); v++) boundary += on_boundary(std::int32_t(v));
  return std::min(least + by_share * std::pow(double(vertices_.size()) / boundary, 7), most);
}

template <std::size_t m>
void SolidMesh<m>::find_quadrics(Job &job) {
  Array<Gradients> of_tets(tets.size(), &job.memory);
  job.parallel.for_blocks(tets.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t++) of_tets[t] = gradients(tets[t]);
    job.poll(0);
  });
  const double weight = weight_of_planes();
  job.parallel.for_blocks(vertices_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; v++) vertices_[v].quadric = quadric_of(std::int32_t(v), of_tets, weight);
    job.poll(0);
  });
}

template <std::size_t m>
LocalQuadric<3 + m> SolidMesh<m>::quadric_of(std::int32_t v, Span<const Gradients> gradients,
                                             double weight_of_planes) const {
  LocalQuadric<3 + m> quadric;
  for (std::int32_t t : tets_of.of(v))
    for (std::size_t i = 0; i < m; i++) {
      const Vec3 &g = gradients[std::size_t(t)][i];
      Place upright{-g.x, -g.y, -g.z};
      upright[3 + i] = 1;
      quadric.add_square(upright, 1);
    }
  for (std::int32_t t : triangles_of.of(v)) {
    const Vec3 n = normal(t);
    const double length = glm::length(n);
    if (length > 0) quadric.add_square({n.x / length, n.y / length, n.z / length}, weight_of_planes);
  }
  return quadric;
}

template <std::size_t m>
BestOfEdge SolidMesh<m>::cost(std::int32_t v, std::int32_t u) const {
  const auto [stays, gone] = ends_of(v, u);
  if (!may_go(gone) || rank(stays) == Rank::touching) return {0, std::numeric_limits<double>::infinity()};
  const Vertex &a = vertex(stays), &b = vertex(gone);
  const Place d = minus(b.place, a.place);
  BestOfEdge best = best_of_edge(a.quadric, b.quadric, d, keeps_place(stays, gone));
  constexpr std::size_t tets_of_vertex = entry_of(3, 3);
  best.cost += shape_share * length2(point_of(d)) * (a.quadric.a[tets_of_vertex] + b.quadric.a[tets_of_vertex]);
  return best;
}

template <std::size_t m>
void SolidMesh<m>::collapse(const SolidEdge &edge, const Place &place, CollapseRoom &room) {
  Vertex &stays = vertices_[std::size_t(edge.stays)];
  const Vertex &gone = vertex(edge.gone);
  LocalQuadric<3 + m> sum = stays.quadric.moved(minus(place, stays.place));
  sum.add(gone.quadric.moved(minus(place, gone.place)));
  stays = {place, sum};
  SolidComplex::collapse(edge, point_of(place), room);
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
