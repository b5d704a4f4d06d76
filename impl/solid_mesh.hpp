// A solid whose edges collapse, with the quadrics of its vertices.
#pragma once
#include "local_quadric.hpp"
#include "solid_complex.hpp"
#include "tet_frame.hpp"

namespace tetlod {

/// The values of fields in units of length: a field's range counts as the diagonal, where its weight is 1. Of m fields
/// that steer, as all here.
template <std::size_t m>
struct FieldsAsLengths {
  FieldsAsLengths(const MeshView &original, double diagonal, Job &job);
  ValueRange<m> range;  ///< of the values that tets have: other points' mean nothing
  Values<m> scales;     ///< length that a unit of each field counts as
};

/// Of a tet's linear functions, one of each field, in space and the values as lengths: how far a place is from the i-th
/// one, upright, is its product with the way from a corner. Level where the tet is flat.
template <std::size_t m>
std::array<Vector<3 + m>, m> upright_normals(const std::array<Vector<3 + m>, 4> &corner) {
  const TetFrame frame(point_of(corner[0]), point_of(corner[1]), point_of(corner[2]), point_of(corner[3]));
  std::array<Vector<3 + m>, m> normals{};
  for (std::size_t i = 0; i < m; i++) {
    const Vec3 g = frame.gradient(corner[0][3 + i], corner[1][3 + i], corner[2][3 + i], corner[3][3 + i]);
    if (std::isfinite(g.x + g.y + g.z)) normals[i] = {-g.x, -g.y, -g.z};
    normals[i][3 + i] = 1;
  }
  return normals;
}

/// A mesh without what can be found from the rest, and without gaps.
template <std::size_t m>
struct SolidRemains {
  explicit SolidRemains(Memory &memory)
      : origin(&memory),
        points(&memory),
        ranks(&memory),
        lengths(&memory),
        quadrics(&memory),
        tets(&memory),
        triangles(&memory) {}
  SolidRemains(const SolidRemains &of, Memory &memory)
      : origin(of.origin, &memory),
        points(of.points, &memory),
        ranks(of.ranks, &memory),
        lengths(of.lengths, &memory),
        quadrics(of.quadrics, &memory),
        tets(of.tets, &memory),
        triangles(of.triangles, &memory),
        measures(of.measures) {}
  std::size_t bytes() const {
    std::size_t sum = 0;
    for_arrays(*this, [&](const auto &array) { sum += array.size() * sizeof(array[0]); });
    return sum;
  }
  /// Room without use, which vertices and tets that are gone have left.
  std::size_t spare_bytes() const {
    std::size_t sum = 0;
    for_arrays(*this, [&](const auto &array) { sum += (array.capacity() - array.size()) * sizeof(array[0]); });
    return sum;
  }
  void give_spare_back() {
    for_arrays(*this, [](auto &array) { tetlod::give_spare_back(array); });
  }
  Array<std::int32_t> origin;
  Array<Vec3> points;
  Array<Rank> ranks;
  Array<Vector<m>> lengths;  ///< the values of each vertex
  Array<LocalQuadric<3 + m>> quadrics;
  Array<Tet> tets;
  Array<Triangle> triangles;
  SolidMeasures measures;

 private:
  template <class Remains, class Visit>
  static void for_arrays(Remains &of, const Visit &visit) {
    visit(of.origin);
    visit(of.points);
    visit(of.ranks);
    visit(of.lengths);
    visit(of.quadrics);
    visit(of.tets);
    visit(of.triangles);
  }
};

template <std::size_t m>
class SolidMesh : public SolidComplex {
 public:
  using Place = Vector<3 + m>;
  using Quadric = LocalQuadric<3 + m>;

  /// values: of the original vertices; scales: the length that a unit of each field counts as; planes: of the boundary,
  /// what they weigh, of weigh_planes().
  SolidMesh(SolidInOrder solid, Span<const Values<m>> values, const Values<m> &scales, double planes, Job &job);
  SolidMesh(SolidRemains<m> &&remains, Job &job);

  /// What is left, taken out of the mesh, which is of no use after that. number: numbers_of(left).
  SolidRemains<m> take_remains(Span<const std::int32_t> number, Job &job);

  Array<std::int32_t> origin;  ///< the original vertex of each one

  /// Of collapsing the edge; infinite where neither end may go.
  BestOfEdge cost(std::int32_t v, std::int32_t u) const;
  /// visit(u, cost) of moving v, which is inside, into each neighbour u in turn, which keeps place and values; infinite
  /// where that may not be. Two at a time, with the bytes of one at a time.
  template <class Visit>
  void for_removals(std::int32_t v, const Neighbours &neighbours, const Visit &visit) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool goes = may_go(v);
    const Quadric &q = quadric(v);
    const Place from = place(v);
    const std::int32_t *u = neighbours.begin();
    for (std::size_t left = neighbours.size(); left > 0; left -= std::min<std::size_t>(left, 2), u += 2) {
      const std::int32_t pair[2] = {u[0], u[left > 1]};
      const Place a = place(pair[0]), b = place(pair[1]);
      std::array<Pair, 3 + m> d;
      for (std::size_t i = 0; i < d.size(); i++) d[i] = Pair{a[i], b[i]} - both(from[i]);
      const Pair length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], of_length = both(shape_share * q.a[tets_of_vertex]);
      const Pair cost = q.rise(d) + of_length * length2;
      for (std::size_t k = 0; k < std::min<std::size_t>(left, 2); k++)
        visit(pair[k], !goes || rank(pair[k]) == Rank::touching ? infinity : cost[k]);
    }
  }

  const Quadric &quadric(std::int32_t v) const { return quadrics_[std::size_t(v)]; }
  const Vector<m> &lengths(std::int32_t v) const { return lengths_[std::size_t(v)]; }
  /// What v has in the cost of an edge comes nearer, all at once.
  void prefetch_quadric(std::int32_t v) const {
    constexpr std::size_t line = 64;
    for (std::size_t at = 0; at < sizeof(Quadric); at += line)
      __builtin_prefetch(reinterpret_cast<const char *>(&quadric(v)) + at);
    __builtin_prefetch(&point(v));
  }
  /// x, y, z, and the values as lengths.
  Place place(std::int32_t v) const {
    const Vec3 &p = point(v);
    Place place{p.x, p.y, p.z};
    for (std::size_t i = 0; i < m; i++) place[3 + i] = lengths(v)[i];
    return place;
  }

  /// The end that goes becomes the one that stays, which comes to be at `to`, with the quadrics of both.
  void collapse(const SolidEdge &edge, const Place &to, CollapseRoom &room);

 private:
  /// Where nothing is lost, short edges first: what the square of a length counts as.
  static constexpr double shape_share = 1e-8;
  /// The entry of a quadric that counts the tets a vertex stands for.
  static constexpr std::size_t tets_of_vertex = entry_of(3, 3);

  void find_quadrics(double planes, Job &job);
  void add_tets(std::size_t begin, std::size_t end, Job &job);

  Array<Vector<m>> lengths_;
  Array<Quadric> quadrics_;
};

}  // namespace tetlod
