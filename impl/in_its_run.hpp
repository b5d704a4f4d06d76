// What a result is compared with, or takes more values from: the original, as the run that made it saw it.
#pragma once
#include "job.hpp"
#include "pipeline.hpp"
#include "prepared.hpp"

namespace tetlod {

/// `kept`, where that is of the input, which now has the input's values; else `fresh`, where the input is prepared as
/// that run did. Throws Status::state where points, tets or which values are finite are not those that the result was
/// made from, or a field jumps in other places.
Prepared &as_in_its_run(const Input &input, const Options &options, const Result &result, Prepared &kept,
                        Prepared &fresh, Job &job);

}  // namespace tetlod
