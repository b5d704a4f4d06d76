#include "solid_mesh.hpp"

#include "tet_frame.hpp"

namespace tetlod {

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
void SolidMesh<m>::collapse(const SolidEdge &edge, const Place &place, CollapseRoom &room) {
  Vertex &stays = vertices_[std::size_t(edge.stays)];
  const Vertex &gone = vertex(edge.gone);
  LocalQuadric<3 + m> sum = stays.quadric.moved(minus(place, stays.place));
  sum.add(gone.quadric.moved(minus(place, gone.place)));
  stays = {place, sum};
  SolidComplex::collapse(edge, point_of(place), room);
}

template class SolidMesh<1>;
template class SolidMesh<2>;
template class SolidMesh<3>;
template class SolidMesh<4>;

}  // namespace tetlod
