// 3.1  Which original vertices the simplified mesh keeps inside.
#pragma once
#include "extract_boundary.hpp"
#include "pipeline.hpp"
#include "prepare.hpp"

namespace tetlod {

/// Interior vertices, ascending: the paper's by options.rho, or, with a target, `samples` of them where a linear field
/// would be wrong; and those with flags.
void select_samples(const Original &original, const Boundary &boundary, const Options &options, std::size_t samples,
                    Job &job, Array<std::int32_t> &selected);

}  // namespace tetlod
