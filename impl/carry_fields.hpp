// 3.5  The fields that ride along, on the simplified mesh.
#pragma once
#include "job.hpp"
#include "pipeline.hpp"
#include "prepared.hpp"

namespace tetlod {

/// Writes result.fields, and result.stencil when there is a field of points. A tet of the result takes the value of
/// the original tet that holds its centroid, or whose face is the boundary's nearest to it: values of cells are often
/// numbers of regions and materials, of which a mean means nothing. Without fields nothing is done. solids: of the
/// original's vertices, where the result's are known; else empty.
void carry_fields(const Input &input, const Options &options, const Original &original, Span<const std::int32_t> solids,
                  const Boundary &boundary, Job &job, Result &result);

/// result.mesh.scalars, of all fields that steer, becomes those of the first; result.fields gets the others.
void split_fields(const Input &input, Job &job, Result &result);

/// Writes result.stencil, where it is not there yet, from the input of the run. Throws as as_in_its_run() does.
void find_stencil(const Input &input, const Options &options, Prepared &prepared, Job &job, Result &result);

}  // namespace tetlod
