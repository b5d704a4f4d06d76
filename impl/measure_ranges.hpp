// The ranges of the fields that steer, and the box of the points.
#pragma once
#include "prepare.hpp"

namespace tetlod {

/// Of what is left: a point whose tets were all dropped is none of the mesh's. Fills box, range, scalar_min,
/// scalar_max, unequal_field and spread_error, and the view's scales.
void measure_ranges(const Input &input, Job &job, Original &original);

}  // namespace tetlod
