// 4  The field error of a result, of the scalars, as the paper estimates it, and histograms of the values.
#pragma once
#include <cstdint>

#include "job.hpp"
#include "mesh.hpp"
#include "pipeline.hpp"
#include "prepared.hpp"

namespace tetlod {

struct FieldError {
  double rms = 0, max = 0;              ///< at the original vertices inside the result, over the range
  double outside = 0;                   ///< share of the original vertices outside the result
  double rms_inner = 0, max_inner = 0;  ///< at samples inside the original tets
  double outside_inner = 0;
};

/// `range` of the values makes the errors relative (0: absolute). Every original vertex that a tet uses, and
/// samples_per_tet random points in each original tet (uniform).
FieldError measure_error(const MeshView &original, double range, const TetMesh &result, int samples_per_tet,
                         std::uint64_t seed, Job &job);

/// The same for the input of the run that made the result. Throws as as_in_its_run() does.
FieldError measure_error(const Input &input, const Options &options, const Result &result, int samples_per_tet,
                         Prepared &prepared, Job &job);

/// counts[b] += the values in the b-th of `bins` equal parts of [low, high]; high itself is in the last, what is
/// outside or not finite in none.
void histogram(Span<const double> values, double low, double high, Span<std::int64_t> counts);

}  // namespace tetlod
