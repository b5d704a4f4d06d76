// The memory that a run will take, from what is known before its dear stages.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "pipeline.hpp"

namespace tetlod {

/// What is to be expected of a run.
struct Outlook {
  double boundary_triangles = 0;            ///< of the original
  double points = 0, tets = 0;              ///< of the result
  double probes = 0;                        ///< of a run with a target; 0: none
  double solid_tets = 0, solid_points = 0;  ///< of the original, where its edges collapse; else 0
  double fields = 1;                        ///< that steer
};

/// Bytes of the largest stage that is still to come, beside what is in use after sampling. By experience: the
/// constants come from real sets with 2 K to 54 K boundary triangles and results of 0.4 K to 750 K tets.
double expected_bytes(const Outlook &outlook, const Input &input);

/// Share of the samples, out of some of them, that the original's boundary is not nearer to than `least`.
double share_away(Span<const Vec3> points, Span<const Triangle> boundary, Span<const std::int32_t> samples,
                  double least, Job &job);

/// How many tets a bound of the error takes, more or less: by the number of parts into which the vertices are to be
/// divided until in none the values are off by more than `bound` from a linear function. 0: there is no bound.
double tets_for_bound(const MeshView &mesh, double bound, Job &job);

}  // namespace tetlod
