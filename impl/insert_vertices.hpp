// New vertices where the probes say that the mesh is worst.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

/// That a vertex inside a tet brings.
constexpr std::int64_t tets_a_vertex = 3;

/// Splits the tets of largest error, each at the centre of its squared residuals, until `tets` more are there or none
/// with an error is left. A centre near a face of the boundary goes onto it: the shape of the mesh stays.
template <std::size_t m>
void insert_vertices(std::int64_t tets, Job &job, AdaptiveMesh<m> &mesh);

/// Makes p, which lies in tet t, a vertex with these values. Corners of t with a weight below `snap` do not count: p
/// goes onto the face or edge of the others, and all tets there are divided. False where it would coincide with a
/// vertex, or a tet would have a worse shape than `least`.
template <std::size_t m>
bool insert_vertex(std::int32_t t, const Vec3 &p, const Values<m> &values, double snap, double least,
                   AdaptiveMesh<m> &mesh);

}  // namespace tetlod
