#include "renew_quadrics.hpp"

#include <algorithm>
#include <numeric>

namespace tetlod {

namespace {

template <std::size_t m>
class QuadricRenewal {
 public:
  using Place = Vector<3 + m>;

  QuadricRenewal(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                 Span<const std::int32_t> home, Job &job, SolidRemains<m> &remains)
      : original_(original),
        boundary_(boundary),
        fields_(fields),
        home_(home),
        job_(job),
        remains_(remains),
        error_(remains.points.size(), 0.0, &job.memory) {}

  double run() {
    begin();
    const std::size_t vertices = remains_.points.size();
    job_.parallel.for_parts(vertices, [&](std::size_t begin, std::size_t end) {
      add_tets(begin, end);
      add_planes(begin, end);
      for (std::size_t v = begin; v < end; v++)
        if (remains_.points[v] != original_point(v)) fit_values(v);
    });
    return std::accumulate(error_.begin(), error_.end(), 0.0);
  }

 private:
  const Vec3 &original_point(std::size_t v) const { return original_.points[std::size_t(remains_.origin[v])]; }

  Place original_place(std::int32_t v) const {
    const Vec3 &p = original_.points[std::size_t(v)];
    Place place{p.x, p.y, p.z};
    for (std::size_t i = 0; i < m; i++) place[3 + i] = fields_.scales[i] * original_.values<m>()[std::size_t(v)][i];
    return place;
  }
  Place place(std::size_t v) const {
    const Vec3 &p = remains_.points[v];
    Place place{p.x, p.y, p.z};
    for (std::size_t i = 0; i < m; i++) place[3 + i] = remains_.lengths[v][i];
    return place;
  }

  void begin() {
    for (std::size_t v = 0; v < remains_.points.size(); v++) {
      remains_.quadrics[v] = {};
      const Place at = original_place(remains_.origin[v]);
      std::copy(at.begin() + 3, at.end(), remains_.lengths[v].begin());
    }
  }

  /// The squared distance from what goes through an original place, `square` of its normal, so many times.
  void add_square(std::size_t v, const Triangular<3 + m> &square, const Place &normal, const Place &through,
                  double weight) {
    const double off = dot<3 + m>(normal, minus(place(v), through));
    LocalQuadric<3 + m> &quadric = remains_.quadrics[v];
    for (std::size_t i = 0; i < square.size(); i++) quadric.a[i] += weight * square[i];
    quadric.g = along(quadric.g, weight * off, normal);
    error_[v] += weight * off * off;
  }

  /// To the quadrics of the vertices begin to end.
  void add_tets(std::size_t begin, std::size_t end) {
    for (std::size_t t = 0; t < original_.tets.size(); t++) {
      job_.poll_at(t, 0);
      const Tet &tet = original_.tets[t];
      std::size_t homes[4];
      bool any = false;
      for (std::size_t k = 0; k < 4; k++) {
        homes[k] = std::size_t(home_[std::size_t(tet[k])]);
        any |= homes[k] - begin < end - begin;
      }
      if (any) add_tet(tet, homes, begin, end);
    }
  }

  /// Corners with the same home are as far from the tet's functions there.
  void add_tet(const Tet &tet, const std::size_t homes[4], std::size_t begin, std::size_t end) {
    std::array<Place, 4> corner;
    for (std::size_t k = 0; k < 4; k++) corner[k] = original_place(tet[k]);
    for (const Place &normal : upright_normals<m>(corner)) {
      const Triangular<3 + m> square = LocalQuadric<3 + m>::square_of(normal, 1);
      for (std::size_t k = 0; k < 4; k++) {
        if (!(homes[k] - begin < end - begin) || std::find(homes, homes + k, homes[k]) != homes + k) continue;
        add_square(homes[k], square, normal, corner[k], double(std::count(homes + k, homes + 4, homes[k])));
      }
    }
  }

  void add_planes(std::size_t begin, std::size_t end) {
    for (const Triangle &t : boundary_.triangles) {
      const auto p = [&](std::size_t k) { return original_.points[std::size_t(t[k])]; };
      const Vec3 n = area_vector(p(0), p(1), p(2));
      const double length = glm::length(n);
      if (!(length > 0)) continue;
      const Place normal{n.x / length, n.y / length, n.z / length};
      const Triangular<3 + m> square = LocalQuadric<3 + m>::square_of(normal, 1);
      for (std::int32_t v : t) {
        const auto home = std::size_t(home_[std::size_t(v)]);
        if (home - begin < end - begin)
          add_square(home, square, normal, original_place(v), remains_.measures.weight_of_planes);
      }
    }
  }

  /// Each field has squares of its own.
  void fit_values(std::size_t v) {
    LocalQuadric<3 + m> &quadric = remains_.quadrics[v];
    Place step{};
    for (std::size_t i = 0; i < m; i++) {
      const double tets = quadric.a[entry_of(3 + i, 3 + i)], slope = quadric.g[3 + i];
      if (!(tets > 0)) continue;
      step[3 + i] = -slope / tets;
      error_[v] -= slope * slope / tets;
      remains_.lengths[v][i] += step[3 + i];
    }
    quadric = quadric.moved(step);
  }

  const MeshView &original_;
  const Boundary &boundary_;
  const FieldsAsLengths<m> &fields_;
  Span<const std::int32_t> home_;
  Job &job_;
  SolidRemains<m> &remains_;
  Array<double> error_;  // of each vertex
};

}  // namespace

template <std::size_t m>
double renew_quadrics(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                      Span<const std::int32_t> home, Job &job, SolidRemains<m> &remains) {
  return QuadricRenewal<m>(original, boundary, fields, home, job, remains).run();
}

template double renew_quadrics(const MeshView &, const Boundary &, const FieldsAsLengths<1> &, Span<const std::int32_t>,
                               Job &, SolidRemains<1> &);
template double renew_quadrics(const MeshView &, const Boundary &, const FieldsAsLengths<2> &, Span<const std::int32_t>,
                               Job &, SolidRemains<2> &);
template double renew_quadrics(const MeshView &, const Boundary &, const FieldsAsLengths<3> &, Span<const std::int32_t>,
                               Job &, SolidRemains<3> &);
template double renew_quadrics(const MeshView &, const Boundary &, const FieldsAsLengths<4> &, Span<const std::int32_t>,
                               Job &, SolidRemains<4> &);

}  // namespace tetlod
