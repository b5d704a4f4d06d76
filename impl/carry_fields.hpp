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

/// Throws Status::state where points or tets are not those that the result was made from.
void refuse_changed(const Fingerprint &mesh, const Result &result);

/// The same where a field jumps between others of its parts, or across other cracks.
void refuse_other_jumps(const Original &original, const Result &result);

/// Writes result.stencil, where it is not there yet, from the input of the run, which is read again, or from
/// what is prepared of it. Throws as the two above.
void find_stencil(const Input &input, const Options &options, Prepared &prepared, Job &job, Result &result);

}  // namespace tetlod
