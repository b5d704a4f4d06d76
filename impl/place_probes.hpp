// Where the field of a simplified mesh is compared with the original's, and in which tet each such point lies.
#pragma once
#include "adaptive_mesh.hpp"
#include "job.hpp"

namespace tetlod {

struct ProbeOptions {
  /// How many probes there are at most; what is left out is spread evenly.
  double most_vertices = std::numeric_limits<double>::infinity(), most_inner = most_vertices;
  double vertex_weight = 1;      ///< what those at vertices count as, of those inside
  bool project_outside = false;  ///< compare vertices outside of the mesh at the nearest point of its boundary
};

/// As many as say enough of a result of so many tets, refined in so many rounds: more cost time and memory alone.
/// follows_field: vertices move and faces flip, too.
ProbeOptions enough_probes(double tets, int rounds, bool follows_field);

/// How many there will be, not many less.
std::size_t expected_probes(const MeshView &original, const ProbeOptions &options);

/// Gives `mesh`, which is connected and has values, its probes in place of those that it has: every original vertex
/// that a tet uses, and random points in original tets, more of them where the field changes more: with vertices alone
/// the mesh would be fitted to them and go its own way in between. Vertices outside of the mesh are left out, or
/// projected.
template <std::size_t m>
void place_probes(const MeshView &original, const ProbeOptions &options, Job &job, AdaptiveMesh<m> &mesh);

}  // namespace tetlod
