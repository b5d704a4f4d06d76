// A solid whose edges collapse, with the quadrics of its vertices.
#pragma once
#include "local_quadric.hpp"
#include "solid_complex.hpp"

namespace tetlod {

/// Of m fields that steer.
template <std::size_t m>
class SolidMesh : public SolidComplex {
 public:
  using Place = Vector<3 + m>;  ///< x, y, z, and the values as lengths

  struct Vertex {
    Place place{};
    LocalQuadric<3 + m> quadric;
  };

  /// values: of the original vertices; scales: the length that a unit of each field counts as.
  SolidMesh(SolidInOrder solid, Span<const Values<m>> values, const Values<m> &scales, Job &job);

  Array<std::int32_t> origin;  ///< the original vertex of each one

  const Vertex &vertex(std::int32_t v) const { return vertices_[std::size_t(v)]; }

  /// The end that goes becomes the one that stays, which comes to be at `place`, with the quadrics of both.
  void collapse(const SolidEdge &edge, const Place &place, CollapseRoom &room);

 private:
  using Gradients = std::array<Vec3, m>;
  Gradients gradients(const Tet &t) const;
  double weight_of_planes() const;
  void find_quadrics(Job &job);
  LocalQuadric<3 + m> quadric_of(std::int32_t v, Span<const Gradients> gradients, double weight_of_planes) const;

  Array<Vertex> vertices_;
};

}  // namespace tetlod
