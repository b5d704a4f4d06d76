// The tets that a solid has, numbered so that neighbours in space are mostly near each other in memory.
#pragma once
#include "extract_boundary.hpp"

namespace tetlod {

struct SolidInOrder {
  explicit SolidInOrder(Memory &memory) : origin(&memory), points(&memory), tets(&memory), triangles(&memory) {}
  Array<std::int32_t> origin;  ///< the original vertex that each one is; those without a tet are left out
  Array<Vec3> points;
  Array<Tet> tets;            ///< positive
  Array<Triangle> triangles;  ///< the boundary, outward
};

/// Vertices along Morton's curve, tets by their first vertex on it.
SolidInOrder put_in_order(const MeshView &original, const Boundary &boundary, Job &job);

}  // namespace tetlod
