// What is left of a solid, with other values: the quadrics of its vertices are those that collapses of the original to
// it would have summed.
#pragma once
#include "extract_boundary.hpp"
#include "solid_mesh.hpp"

namespace tetlod {

/// home: of each original vertex, the vertex of `remains` that it has become; -1: no tet has it. A vertex at its
/// original place gets the original's values, another those that its quadric is least for. Returns what the quadrics
/// are there, summed: the squared error that the remains have, as collapses count it.
template <std::size_t m>
double renew_quadrics(const MeshView &original, const Boundary &boundary, const FieldsAsLengths<m> &fields,
                      Span<const std::int32_t> home, Job &job, SolidRemains<m> &remains);

}  // namespace tetlod
